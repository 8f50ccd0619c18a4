#include "clackers/report/latex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "clackers/report/digest.hpp"
#include "clackers/report/tex.hpp"

namespace clackers::report {
namespace {

// Letters, digits and hyphens are safe in every label.
std::string label_of(std::string text) {
  const auto unsafe = [](char c) {
    return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'));
  };
  std::ranges::replace_if(text, unsafe, '-');
  return "tab:clackers-" + text;
}

// a, b, ..., z, aa, ab, ...
std::string letters(std::size_t index) {
  std::string out;
  for (auto n = index + 1; n > 0; n = (n - 1) / 26)
    out.insert(out.begin(), char('a' + int((n - 1) % 26)));
  return out;
}

std::string mark_of(const std::string& letter) { return "\\textsuperscript{" + letter + "}"; }

// Names break nowhere in a table, so they may be broken behind "+", ":" and ",".
std::string name_of(const study::MethodResult& method) {
  std::string out;
  for (const char c : typed_name(method)) {
    out += tex_text(std::string_view(&c, 1));
    if (c == '+' || c == ':' || c == ',') out += "\\allowbreak{}";
  }
  return "\\texttt{" + out + "}";
}

std::string order_of(const study::MethodResult& method) {
  const auto& fit = method.assessment.displacement;
  if (!fit.has_line) return "--";
  return fmt::format("${:.2f} \\pm {:.2f}$", fit.order, fit.spread);
}

std::string row(const study::MethodResult& method, const std::string& note) {
  const auto d = digest(method);
  const bool judged = method.refusal.empty() && d.runs > 0;
  return fmt::format(
      "    {} & {} & {} & {} & {} & {} & {} & {} & {}{} \\\\\n", name_of(method),
      tex_scientific(d.u_error), order_of(method),
      d.impacts ? fmt::format("${}/{}$", d.impacts->found, d.impacts->expected) : "--",
      d.impacts && d.impacts->matched > 0 ? tex_scientific(d.impacts->worst_time_error) : "--",
      tex_scientific(d.energy_error), d.runs > 0 ? fmt::format("${}$", d.force_evaluations) : "--",
      judged ? std::string(to_string(method.assessment.displacement.behaviour)) : "--",
      verdict_word(method), note.empty() ? "" : mark_of(note));
}

std::string caption(const study::Record& record) {
  const auto& problem = record.problem;
  return fmt::format(
      "{}: {}. Of each method the worst run of the finest level; errors relative to the initial "
      "envelope and energy, order with its 95\\,\\% interval, collisions found/exact.{}",
      tex_text(case_text(problem)), tex_text(ladder_text(record)),
      record.interrupted ? " Interrupted: only what was finished is shown." : "");
}

}  // namespace

void write_latex(const study::Record& record, std::ostream& out) {
  const auto& from = record.provenance;
  out << fmt::format("% Written by clackers {} on {}: {}\n", tex_comment(from.version),
                     tex_comment(from.date), tex_comment(from.command))
      << "% Needs \\usepackage{booktabs} and UTF-8, which is LaTeX's default.\n"
      << "\\begin{table}\n  \\centering\n  \\footnotesize\n  \\setlength{\\tabcolsep}{4pt}\n"
      << fmt::format("  \\caption{{{}}}\n  \\label{{{}}}\n", caption(record),
                     label_of(record.problem.name))
      << "  \\begin{tabular}{@{}p{0.22\\linewidth}rrrrrrll@{}}\n    \\toprule\n"
      << "    & Error & & & Time & Energy & Force & & \\\\\n"
      << "    Method & in $u$ & Order & Coll. & error [s] & error & eval. & Behaviour & Verdict "
         "\\\\\n"
      << "    \\midrule\n";
  std::string notes;
  std::size_t count = 0;
  for (const auto& method : record.methods) {
    const auto said = remark(method);
    const auto letter = said ? letters(count++) : "";
    out << row(method, letter);
    if (said)
      notes += fmt::format("  \\par {}~{} [{}]\n", mark_of(letter), tex_text(said->sentence),
                           tex_text(said->code));
  }
  out << "    \\bottomrule\n  \\end{tabular}\n";
  if (!notes.empty()) out << "  \\par\\smallskip\\raggedright\n" << notes;
  out << "\\end{table}\n";
}

}  // namespace clackers::report
