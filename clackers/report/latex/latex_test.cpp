#include "clackers/report/latex.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "clackers/report/sample_record.hpp"
#include "clackers/report/tex.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

std::string latex(const study::Record& record) {
  std::ostringstream out;
  write(record, Format::latex, out);
  return out.str();
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

// Columns of a line of the table: "&" that is no "\&".
long columns(const std::string& line) {
  static const std::regex separator("(^|[^\\\\])&");
  return 1 + std::distance(std::sregex_iterator(line.begin(), line.end(), separator), {});
}

// What TeX would stumble over; empty where it would not.
std::string trouble(const std::string& text) {
  std::vector<std::string> open;
  std::string braces;
  bool formula = false;
  for (const auto& line : lines(text)) {
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

TEST(Latex, HasARowOfNineColumnsAMethod) {
  const auto record = sample_record();
  std::size_t rows = 0;
  for (const auto& line : lines(latex(record)))
    if (line.ends_with("\\\\")) {
      EXPECT_EQ(columns(line), 9) << line;
      ++rows;
    }
  EXPECT_EQ(rows, 2 + record.methods.size());
}

TEST(Latex, ShowsErrorOrderCollisionsCostBehaviourAndVerdict) {
  const auto text = latex(sample_record());
  EXPECT_NE(
      text.find("    \\texttt{newmark} & $1.2\\cdot 10^{-7}$ & $2.01 \\pm 0.01$ & $6/6$ & "
                "$4.1\\cdot 10^{-8}$ & $3.7\\cdot 10^{-7}$ & $93901$ & proper & agrees \\\\\n"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("\\caption{three-parameter (N = 2, xi1 = 0.05, a\\_t = 1 m): 8 levels of 8"),
            std::string::npos);
  EXPECT_NE(text.find("\\label{tab:clackers-three-parameter}"), std::string::npos);
  EXPECT_NE(text.find("Interrupted: only what was finished is shown."), std::string::npos);
}

TEST(Latex, PutsWhatIsSaidOfAMethodIntoANoteWithItsLetter) {
  const auto text = latex(sample_record());
  EXPECT_NE(text.find("& reduced & disagrees\\textsuperscript{a} \\\\"), std::string::npos) << text;
  EXPECT_NE(
      text.find("\\par \\textsuperscript{a}~reduced: the line is straight with slope 1.6, the "
                "method claims order 2 [reduced]"),
      std::string::npos);
  EXPECT_NE(text.find("\\texttt{newmark+\\allowbreak{}penalty:\\allowbreak{}stiffness=1e6} & -- & "
                      "-- & -- & -- & -- & -- & -- & refused\\textsuperscript{e}"),
            std::string::npos)
      << text;
}

TEST(Latex, GoesOnWithTwoLettersBehindTheTwentySixthNote) {
  auto record = sample_record();
  const auto refused = record.methods.back();
  record.methods.assign(53, refused);
  const auto text = latex(record);
  for (const auto letter : {"{a}", "{z}", "{aa}", "{az}", "{ba}"})
    EXPECT_NE(text.find(std::string("\\par \\textsuperscript") + letter + "~"), std::string::npos)
        << letter;
}

TEST(Latex, LetsNothingOfTheRecordStopTex) {
  auto record = sample_record();
  EXPECT_EQ(trouble(latex(record)), "");
  const std::string evil = "}\n\\end{tabular} & $ _ ^ # % ~ \\\\ {";
  record.provenance = {evil, evil, evil, evil, evil, evil};
  record.problem.name = evil;
  for (auto& parameter : record.problem.parameters) parameter = {evil, 1.0, evil, evil};
  for (auto& method : record.methods) {
    method.name = method.assessment.sentence = evil;
    method.assessment.displacement.reason = method.claim.reason = evil;
    for (auto& level : method.ladder)
      for (auto& run : level.runs) run.u_error = INFINITY;
  }
  record.methods.back().refusal = record.methods.back().refusal_code = evil;
  EXPECT_EQ(trouble(latex(record)), "");
  for (const auto& line : lines(latex(record)))
    if (line.ends_with("\\\\")) {
      EXPECT_EQ(columns(line), 9) << line;
    }
}

}  // namespace
}  // namespace clackers::report
