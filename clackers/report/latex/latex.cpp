#include "clackers/report/writers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "clackers/report/columns.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/latex/tex.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

// a, b, ..., z, aa, ab, ...
std::string letters(std::size_t index) {
  std::string out;
  for (auto n = index + 1; n > 0; n = (n - 1) / 26)
    out.insert(out.begin(), char('a' + int((n - 1) % 26)));
  return out;
}

std::string mark_of(const std::string& letter) { return "\\textsuperscript{" + letter + "}"; }

// Letters, digits and hyphens are safe in every label.
std::string label_of(std::string text) {
  const auto unsafe = [](char c) {
    return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'));
  };
  std::ranges::replace_if(text, unsafe, '-');
  return "tab:clackers-" + text;
}

// Names may break behind the marks that join their parts.
std::string name_text(std::string_view name) {
  std::string out;
  for (std::size_t from = 0; from < name.size();) {
    const auto to = std::min(name.find_first_of("+:,/", from), name.size() - 1) + 1;
    const auto part = name.substr(from, to - from);
    out += tex_text(part);
    if (part.find_first_of("+:,/") != std::string_view::npos) out += "\\allowbreak{}";
    from = to;
  }
  return "\\texttt{" + out + "}";
}

std::string heading_of(const Column& shown) {
  auto text = tex_text(shown.brief_heading());
  if (!shown.unit.empty()) text += fmt::format(" [{}]", tex_text(shown.unit));
  if (const auto space = text.find(' '); space != std::string::npos)
    text = fmt::format("\\shortstack{{{}\\\\{}}}", text.substr(0, space), text.substr(space + 1));
  return text;
}

std::string tex_cell_of(const Column& shown, const Row& row) {
  const auto cell = shown.get(row);
  if (const auto* real = std::get_if<double>(&cell))
    return shown.kind == Kind::error ? tex_scientific(*real) : tex_number(*real);
  if (const auto* whole = std::get_if<long long>(&cell)) return fmt::format("${}$", *whole);
  if (const auto* text = std::get_if<std::string>(&cell))
    return shown.kind == Kind::name ? name_text(*text) : tex_text(*text);
  return "--";
}

struct Frame {
  std::string caption, label, notes;
};

void write_table(const Table& table, const std::vector<std::string>& marks, const Frame& frame,
                 std::ostream& out) {
  std::string alignment, heading;
  for (const auto* shown : table.columns) {
    const bool is_name = shown->kind == Kind::name;
    alignment += is_name ? "p{0.2\\linewidth}" : is_number(shown->kind) ? "r" : "l";
    heading += (heading.empty() ? "    " : " & ") + heading_of(*shown);
  }
  out << "\\begin{table}\n  \\centering\n  \\scriptsize\n  \\setlength{\\tabcolsep}{3pt}\n"
      << fmt::format("  \\caption{{{}}}\n  \\label{{{}}}\n", frame.caption, label_of(frame.label))
      << fmt::format("  \\begin{{tabular}}{{@{{}}{}@{{}}}}\n    \\toprule\n", alignment) << heading
      << " \\\\\n    \\midrule\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const char* between = "    ";
    for (const auto* shown : table.columns) {
      out << between << tex_cell_of(*shown, table.rows[i]);
      between = " & ";
    }
    out << (i < marks.size() ? marks[i] : "") << " \\\\\n";
  }
  out << "    \\bottomrule\n  \\end{tabular}\n";
  if (!frame.notes.empty()) out << "  \\par\\smallskip\\raggedright\n" << frame.notes;
  out << "\\end{table}\n";
}

void write_methods(const record::CaseRecord& problem, bool interrupted, std::ostream& out) {
  const auto table = summary_table(problem, record::SubjectKind::method);
  if (table.rows.empty()) return;
  const auto plan = plan_text(problem);
  Frame frame{fmt::format("{}{}. Of each method the worst run of the finest level; errors {}, "
                          "order with its 95\\,\\% interval, impacts matched/exact.{}",
                          tex_text(case_text(problem.problem)),
                          plan.empty() ? "" : ": " + tex_text(plan), error_scale_text,
                          interrupted ? " Interrupted: only what was finished is shown." : ""),
              problem.problem.name,
              {}};
  std::vector<std::string> marks;
  std::size_t count = 0;
  for (const auto& row : table.rows) {
    const auto found = finding(*row.subject);
    marks.push_back(found ? mark_of(letters(count++)) : "");
    if (found)
      frame.notes += fmt::format("  \\par {}~{}\n", marks.back(), tex_text(text_of(*found)));
    for (const auto& cause : diagnosis_texts(*row.subject))
      frame.notes +=
          fmt::format("  \\par {}: {}\n", tex_text(row.subject->name), tex_text(text_of(cause)));
  }
  write_table(table, marks, frame, out);
}

void write_histories(const record::CaseRecord& problem, std::ostream& out) {
  const auto table = summary_table(problem, record::SubjectKind::histories);
  if (table.rows.empty()) return;
  Frame frame{fmt::format("{}: time histories against the exact motion. Errors relative to the "
                          "largest envelope, of velocities in the mean over time; impacts "
                          "matched/exact.",
                          tex_text(case_text(problem.problem))),
              "check-" + problem.problem.name,
              {}};
  for (const auto& subject : problem.subjects) {
    if (subject.kind != record::SubjectKind::histories) continue;
    const auto who = problem.subjects.size() > 1 ? tex_text(subject.name) + ": " : std::string();
    // Of several, verdicts and causes stand below the table of all.
    if (who.empty()) {
      for (const auto& cause : diagnosis_texts(subject))
        frame.notes += fmt::format("  \\par {}\n", tex_text(text_of(cause)));
      frame.notes += fmt::format("  \\par Verdict: {}. {}\n", record::verdict_word(subject),
                                 tex_text(text_of(finding(subject).value_or(Finding{}))));
    }
    for (const auto& note : note_texts(subject))
      frame.notes += fmt::format("  \\par {}{}\n", who, tex_text(note));
  }
  write_table(table, {}, frame, out);
}

}  // namespace

void write_latex(const record::Record& record, std::ostream& out, const Style&,
                 const study::BaselineComparison*) {
  const auto& from = record.provenance;
  out << fmt::format("% Written by clackers {} on {}: {}\n", tex_comment(from.version),
                     tex_comment(from.date), tex_comment(from.command))
      << "% Needs \\usepackage{booktabs} and UTF-8, which is LaTeX's default.\n";
  for (const auto& problem : record.cases) {
    write_methods(problem, record.interrupted, out);
    write_histories(problem, out);
  }
}

}  // namespace clackers::report
