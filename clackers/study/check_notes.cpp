#include "clackers/study/check_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/assess/convergence/fit/error_ladder.hpp"

namespace clackers::study {
namespace {

void digits(CheckedFile& file) {
  if (!(file.printed_floor > 0.0)) return;
  // Fifteen digits err less than the arithmetic of a run of any length.
  const double rounding = 1e-15 * double(file.rows);
  if (file.printed_floor <= std::min(rounding, 1e-12)) return;
  const auto column = std::ranges::find(file.columns, file.printed_by, &PrintedColumn::name);
  const auto what = column->single
                        ? fmt::format("{} holds numbers of single precision", column->name)
                        : fmt::format("{} is printed with {} digits", column->name, column->digits);
  const double share = file.score.u_error / file.printed_floor;
  std::string compared = "the error found is within it";
  if (share > assess::rounding_slack)
    compared = fmt::format("the error found is {:.3g} times that", share);
  else if (share > 1.0)
    compared = "the error found is hardly larger, so it is not measured";
  file.notes.push_back(
      fmt::format("Printed digits: {}; printing alone may make an error of {:.2g} in u, and {}.",
                  what, file.printed_floor, compared));
}

void sampling(CheckedFile& file, const CaseSummary& problem) {
  // From 20 rows a period the bend is below 1.3 %.
  const double rows = problem.fast_period / file.spacing;
  if (rows >= 20.0) return;
  file.notes.push_back(
      fmt::format("Sampling: {:.3g} rows a fast period; between rows the fast mass leaves the "
                  "straight line by up to {:.2g} of its amplitude, unseen.",
                  rows, file.unseen_bend));
}

void collisions(CheckedFile& file) {
  if (!file.score.impacts) return;
  const auto& found = *file.score.impacts;
  if (found.expected == 0 && found.found == 0) {
    file.notes.push_back(
        "No collision happens before the history ends: nothing is said of impacts.");
    return;
  }
  if (file.collisions == CollisionSource::events) {
    if (found.found == 0)
      file.notes.push_back(
          fmt::format("The events file reports no collision, while {} happen.", found.expected));
    return;
  }
  auto text = std::string(
      "No events file: collisions are not reported, they were found in the history itself");
  if (!file.rows_resolve_collisions)
    text += fmt::format(", whose rows, {:.3g} s apart, are too far apart for that", file.spacing);
  else if (found.found == 0)
    text += fmt::format(": there is none, while {} happen", found.expected);
  if (file.contact_time > 0.0)
    text += fmt::format(", contacts of {:.3g} s: compliant, not rigid", file.contact_time);
  file.notes.push_back(text + ".");
}

void ends(CheckedFile& file, const CaseSummary& problem) {
  if (file.first > 0.0)
    file.notes.push_back(
        fmt::format("The first row is at {:.6g} s, not at the start.", file.first));
  if (file.rows_beyond > 0)
    file.notes.push_back(
        fmt::format("{} rows lie after the case's end, {:g} s, and are not judged; a larger t_end "
                    "or a_t judges them.",
                    file.rows_beyond, problem.end));
  else if (file.last < problem.end - 1.5 * file.spacing)
    file.notes.push_back(fmt::format(
        "The history ends at {:.6g} s, the case at {:g} s: what happens between is not judged.",
        file.last, problem.end));
}

void start(CheckedFile& file) {
  const double visible = std::max(10.0 * file.printed_floor, 1e-14);
  if (file.first == 0.0 && file.start_error > visible)
    file.notes.push_back(
        fmt::format("The initial state is off by {:.2g} of the envelope, beyond what printing "
                    "makes: no error below that is the method's.",
                    file.start_error));
}

}  // namespace

void add_notes(CheckedFile& file, const CaseSummary& problem) {
  digits(file);
  sampling(file, problem);
  collisions(file);
  ends(file, problem);
  start(file);
}

}  // namespace clackers::study
