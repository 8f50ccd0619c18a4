#include "clackers/report/latex.hpp"

#include <fmt/format.h>

#include <ostream>
#include <string>

#include "clackers/report/digest.hpp"
#include "clackers/report/latex_frame.hpp"
#include "clackers/report/tex.hpp"

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

std::string row(const study::MethodResult& method, const std::string& note) {
  const auto d = digest(method);
  const bool judged = method.refusal.empty() && d.runs > 0;
  return fmt::format(
      "    {} & {} & {} & {} & {} & {} & {} & {} & {}{} \\\\\n", latex_name(typed_name(method)),
      tex_scientific(d.u_error), latex_order(method.assessment.displacement),
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
  LatexFrame frame{
      .caption = caption(record),
      .label = record.problem.name,
      .columns = "@{}p{0.17\\linewidth}rrrrrrll@{}",
      .heading =
          "    & Error & & & Time & Energy & Force & & \\\\\n"
          "    Method & in $u$ & Order & Coll. & error [s] & error & eval. & Behaviour & "
          "Verdict \\\\\n",
      .rows = {},
      .notes = {}};
  std::size_t count = 0;
  for (const auto& method : record.methods) {
    const auto said = remark(method);
    const auto letter = said ? letters(count++) : "";
    frame.rows += row(method, letter);
    if (said)
      frame.notes += fmt::format("  \\par {}~{} [{}]\n", mark_of(letter), tex_text(said->sentence),
                                 tex_text(said->code));
  }
  out << latex_table(frame, record.provenance);
}

}  // namespace clackers::report
