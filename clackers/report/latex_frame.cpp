#include "clackers/report/latex_frame.hpp"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

std::string latex_table(const LatexFrame& frame, const study::Provenance& from) {
  auto out = fmt::format("% Written by clackers {} on {}: {}\n", tex_comment(from.version),
                         tex_comment(from.date), tex_comment(from.command));
  out += "% Needs \\usepackage{booktabs} and UTF-8, which is LaTeX's default.\n";
  out += "\\begin{table}\n  \\centering\n  \\scriptsize\n  \\setlength{\\tabcolsep}{3pt}\n";
  out += fmt::format("  \\caption{{{}}}\n  \\label{{{}}}\n", frame.caption, label_of(frame.label));
  out += fmt::format("  \\begin{{tabular}}{{{}}}\n    \\toprule\n", frame.columns);
  out += frame.heading + "    \\midrule\n" + frame.rows;
  out += "    \\bottomrule\n  \\end{tabular}\n";
  if (!frame.notes.empty()) out += "  \\par\\smallskip\\raggedright\n" + frame.notes;
  return out + "\\end{table}\n";
}

// Names break nowhere in a table unless they are told where they may.
std::string latex_name(std::string_view name) {
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

std::string latex_order(const assess::LadderFit& fit) {
  if (!fit.has_line) return "--";
  return fmt::format("${:.2f} \\pm {:.2f}$", fit.order, fit.spread);
}

}  // namespace clackers::report
