#include "clackers/report/check_latex.hpp"

#include <fmt/format.h>

#include <ostream>

#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/latex_frame.hpp"
#include "clackers/report/tex.hpp"

namespace clackers::report {
namespace {

std::string row(const study::CheckedFile& file) {
  const auto& found = file.score.impacts;
  return fmt::format("    {} & ${}$ & {} & {} & {} & {} & {} \\\\\n", latex_name(file.file),
                     file.rows, tex_scientific(file.score.step), tex_scientific(file.score.u_error),
                     tex_scientific(file.score.v_error),
                     found ? fmt::format("${}/{}$", found->matched, found->expected) : "--",
                     found && found->matched > 0 ? tex_scientific(found->worst_time_error) : "--");
}

std::string notes(const study::CheckRecord& record) {
  std::string out;
  if (record.files.size() > 1)
    out += fmt::format("  \\par Together: {}, order {}.\n",
                       to_string(record.assessment.displacement.behaviour),
                       latex_order(record.assessment.displacement));
  out += fmt::format("  \\par Verdict: {}. {}{}\n", to_string(record.verdict),
                     tex_text(record.sentence),
                     record.reason.empty() ? "" : fmt::format(" [{}]", tex_text(record.reason)));
  for (const auto& note : record.files.back().notes)
    out += fmt::format("  \\par {}\n", tex_text(note));
  return out;
}

}  // namespace

void write_check_latex(const study::CheckRecord& record, std::ostream& out) {
  LatexFrame frame{
      .caption = fmt::format("{}: time histories against the exact motion. Errors relative to the "
                             "initial envelope, of velocities in the mean over time; collisions "
                             "matched/exact.",
                             tex_text(case_text(record.problem))),
      .label = "check-" + record.problem.name,
      .columns = "@{}p{0.34\\linewidth}rrrrrr@{}",
      .heading =
          "    & & Step & Error & Error & & Time \\\\\n"
          "    History & Rows & [s] & in $u$ & in $v$ & Coll. & error [s] \\\\\n",
      .rows = {},
      .notes = notes(record)};
  for (const auto& file : record.files) frame.rows += row(file);
  out << latex_table(frame, record.provenance);
}

}  // namespace clackers::report
