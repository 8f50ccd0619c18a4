#include "clackers/tables/listing/list_diagnoses.hpp"

#include <array>

#include "clackers/diagnose/diagnosis.hpp"

namespace clackers::tables {
namespace {

// What the value of a diagnosis is; both empty for a cause without a number.
struct ValueRow {
  Code code;
  std::string_view unit, value;
};

// clang-format off
constexpr auto value_rows = std::to_array<ValueRow>({
    {"unit-scaled", "1", "numbers of the file over those in m and m/s"},
    {"columns-exchanged", "1", "factor of the numbers, where they are in another unit or sign as well"},
    {"masses-exchanged", "1", "factor of the numbers, where they are in another unit or sign as well"},
    {"sign-reversed", "", ""},
    {"starts-at-rest", "m/s", "velocity at the start"},
    {"velocity-at-half-steps", "steps", "0.5: half a step later than the row; -0.5: earlier"},
    {"velocity-order-lower", "1", "order of the velocities"},
    {"printed-digits", "1", "significant digits"},
    {"single-precision", "bits", "of the mantissas"},
    {"output-resampled", "s", "time between rows"},
    {"ends-early", "s", "last time of the history"},
    {"time-shifted", "steps or s", "time of the file minus the true one"},
    {"time-unit", "1", "times of the file over those in seconds"},
    {"time-drifts", "s", "distance of the last time from the grid of equal steps"},
    {"restitution-differs", "1", "coefficient of restitution of the history"},
    {"mass-ratio-differs", "%", "relative change of the mass"},
    {"frequency-differs", "%", "relative change of the natural frequency"},
    {"damping-differs", "% or 1", "relative change of the damping ratio; the ratio where the case has none"},
    {"damping-changes-at-impact", "1", "damping after the first impact over that before"},
    {"gap-differs", "m", "gap of the case at which contacts close"},
    {"impact-missed", "1", "number of the impact"},
    {"impact-doubled", "1", "number of the impact"},
    {"impact-impulse-wrong", "1", "impulse over the right one"},
    {"impact-at-step-end", "steps", "mean delay of impacts"},
    {"impact-interpolated", "1", "order of the impact times"},
    {"impact-tolerance", "s", "largest delay of an impact"},
    {"contact-compliant", "s", "median duration of a contact"},
    {"contact-in-tension", "1", "impulse in tension over impulse in compression"},
    {"wrong-limit", "1", "distance of the limit over the envelope"},
    {"noise-floor", "1", "error of the floor over the envelope"},
    {"commensurate-steps", "1", "part of the steps"},
    {"numerical-damping", "1", "part of the energy that is lost at the finest step"},
    {"period-error", "%", "relative change of the frequency at the finest step"},
    {"unstable-coarse-steps", "s", "largest stable step"},
});
// clang-format on

static_assert(value_rows.size() == diagnose::diagnosis_codes.size());

}  // namespace

record::Sheet list_diagnoses() {
  record::Sheet sheet{"clackers/diagnoses/1",
                      "Causes that check and verify look for",
                      {{"code", "", ""},
                       {"unit", "", "of the value"},
                       {"value", "", "what it is"},
                       {"meaning", "", "and what to do about it"}},
                      {}};
  const auto cell = [](std::string_view text) {
    return text.empty() ? record::Cell{} : record::Cell{std::string(text)};
  };
  for (const auto& row : value_rows)
    sheet.rows.push_back({std::string(row.code.name()), cell(row.unit), cell(row.value),
                          std::string(row.code.meaning())});
  return sheet;
}

}  // namespace clackers::tables
