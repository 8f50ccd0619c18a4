#include "clackers/report/writers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "clackers/report/latex/tex.hpp"
#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"

namespace clackers::report {
namespace {

std::string latex(const record::Record& record) { return written(record, Format::latex); }

// Columns of a line of the table: "&" that is no "\&".
long columns(const std::string& line) {
  static const std::regex separator("(^|[^\\\\])&");
  return 1 + std::distance(std::sregex_iterator(line.begin(), line.end(), separator), {});
}

// What TeX cannot read; empty where it can read all.
std::string first_mistake(const std::string& text) {
  std::vector<std::string> open;
  std::string braces;
  bool formula = false;
  for (const auto& line : lines_of(text)) {
    if (line.starts_with('%')) continue;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      if (c == '\\') {
        ++i;  // a command, or an escaped character
      } else if (c == '{') {
        braces += c;
      } else if (c == '}') {
        if (braces.empty()) return "too many }: " + line;
        braces.pop_back();
      } else if (c == '$') {
        formula = !formula;
      } else if ((c == '^' || c == '_') && !formula) {
        return "a raised text outside a formula: " + line;
      } else if (c == '#' || c == '%' || c == '~') {
        if (c != '~' || i == 0) return "a bare character: " + line;
      }
    }
    if (formula) return "a formula without an end: " + line;
    static const std::regex ends("\\\\(begin|end)\\{(\\w+)\\}");
    for (std::sregex_iterator at(line.begin(), line.end(), ends), end; at != end; ++at)
      if ((*at)[1] == "begin") {
        open.push_back((*at)[2]);
      } else {
        if (open.empty() || open.back() != (*at)[2]) return "a wrong end: " + line;
        open.pop_back();
      }
  }
  return braces + (open.empty() ? "" : open.back());
}

TEST(Tex, EscapesWhatTexTakesForItsOwn) {
  EXPECT_EQ(tex_text("a_t = 50 % & #1 {x} $y$"), "a\\_t = 50 \\% \\& \\#1 \\{x\\} \\$y\\$");
  EXPECT_EQ(tex_text("\\~^"), "\\textbackslash{}\\textasciitilde{}\\textasciicircum{}");
  EXPECT_EQ(tex_text("<a|b>`"), "\\textless{}a\\textbar{}b\\textgreater{}\\textasciigrave{}");
  EXPECT_EQ(tex_text("\"one\" and \"two\""), "``one'' and ``two''");
  EXPECT_EQ(tex_text("--report ''"), "-{}-report '{}'");
  EXPECT_EQ(tex_text("---"), "-{}-{}-");
  EXPECT_EQ(tex_text("a\nb\tc\x7f"), "a b c ");
  EXPECT_EQ(tex_text("x ≤ −1 ≥ y"), "x $\\le$ $-$1 $\\ge$ y");
  EXPECT_EQ(tex_text("2.01 ±0.01"), "2.01 $\\pm$0.01");
  EXPECT_EQ(tex_text("\xff"), "\xEF\xBF\xBD");
}

TEST(Tex, WritesPowersOfTen) {
  EXPECT_EQ(tex_scientific(5.2e-5), "$5.2\\cdot 10^{-5}$");
  EXPECT_EQ(tex_scientific(-1.25e12, 2), "$-1.25\\cdot 10^{12}$");
  EXPECT_EQ(tex_scientific(0.0), "$0$");
  EXPECT_EQ(tex_scientific(std::nan("")), "--");
  EXPECT_EQ(tex_scientific(INFINITY), "$\\infty$");
  EXPECT_EQ(tex_scientific(-INFINITY), "$-\\infty$");
}

TEST(Tex, KeepsACommentOnItsLine) {
  EXPECT_EQ(tex_comment("a\n\\end{table} 50%"), "a \\end{table} 50%");
}

TEST(Tex, SmallNumbersHaveThreeDigits) {
  EXPECT_EQ(tex_number(0.05), "$0.05$");
  EXPECT_EQ(tex_number(1.234e-12), "$1.2\\cdot 10^{-12}$");
}

// Lines of the tables' rows, without headings.
std::vector<std::string> rows_of(const std::string& text) {
  std::vector<std::string> rows;
  for (const auto& line : lines_of(text))
    if (line.ends_with("\\\\") && !has(line, "\\shortstack")) rows.push_back(line);
  return rows;
}

TEST(Latex, EveryRowHasTheColumnsOfItsHeading) {
  const auto record = sample_record();
  const auto rows = rows_of(latex(record));
  EXPECT_EQ(rows.size(), record.cases[0].subjects.size());
  for (const auto& row : rows) EXPECT_EQ(columns(row), 9) << row;
}

TEST(Latex, ARowHasErrorOrderImpactsCostBehaviourAndVerdict) {
  const auto text = latex(sample_record());
  EXPECT_TRUE(has(text,
                  "    \\texttt{newmark} & $1.2\\cdot 10^{-7}$ & 2.01$\\pm$0.01 & 6/6 & "
                  "$4.1\\cdot 10^{-8}$ & $3.7\\cdot 10^{-7}$ & $93901$ & proper & agrees \\\\\n"))
      << text;
  EXPECT_TRUE(has(text, "\\label{tab:clackers-three-parameter}"));
  EXPECT_TRUE(has(text, "Interrupted: only what was finished is shown."));
}

TEST(Latex, AFindingIsANoteWithItsLetter) {
  const auto text = latex(sample_record());
  EXPECT_TRUE(has(text, "& reduced & disagrees\\textsuperscript{a} \\\\")) << text;
  EXPECT_TRUE(has(text, "\\par \\textsuperscript{a}~Converges with the reduced order"));
  EXPECT_TRUE(has(text, "& refused\\textsuperscript{e}"));
}

TEST(Latex, LettersGoOnBehindTheTwentySixthNote) {
  auto record = sample_record();
  record.cases[0].subjects.assign(53, sample_refusal());
  const auto text = latex(record);
  for (const auto letter : {"{a}", "{z}", "{aa}", "{az}", "{ba}"})
    EXPECT_TRUE(has(text, std::string("\\par \\textsuperscript") + letter + "~")) << letter;
}

TEST(Latex, HistoriesHaveARowAFileAndTheVerdictBelow) {
  const auto text = latex(sample_check());
  EXPECT_TRUE(has(text, "\\label{tab:clackers-check-three-parameter}"));
  EXPECT_TRUE(
      has(text, "\\texttt{fine.csv} & $2001$ & $0.01$ & 6 & $1.0\\cdot 10^{-3}$ & -- & 4/6"))
      << text;
  EXPECT_TRUE(has(text, "\\par Verdict: disagrees. "));
  EXPECT_EQ(occurrences(latex(sample_of_all()), "\\begin{table}"), 2u);
}

TEST(Latex, NothingOfTheRecordStopsTex) {
  auto record = sample_of_all();
  EXPECT_EQ(first_mistake(latex(record)), "");
  const std::string evil = "}\n\\end{tabular} & $ _ ^ # % ~ \\\\ {";
  record.provenance = {evil, evil, evil, evil, evil, evil};
  for (auto& problem : record.cases) {
    problem.problem.name = evil;
    for (auto& parameter : problem.problem.parameters) parameter = {evil, 1.0, evil, evil};
    for (auto& subject : problem.subjects) {
      subject.name = subject.assessment.reason = subject.claim.reason = evil;
      if (!subject.refusal.empty()) subject.refusal = subject.refusal_code = evil;
      for (auto& level : subject.levels)
        for (auto& run : level.runs) {
          run.score.u_error = INFINITY;
          if (run.file) run.file->file = evil;
        }
    }
  }
  EXPECT_EQ(first_mistake(latex(record)), "");
  for (const auto& row : rows_of(latex(record))) EXPECT_EQ(columns(row), 9) << row;
}

}  // namespace
}  // namespace clackers::report
