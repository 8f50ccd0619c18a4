#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/codes.hpp"

namespace clackers::diagnose {

/// A number that a diagnosis rests on.
struct Fact {
  std::string name;  ///< one of `fact_names`
  double value = 0.0;
};

/// What facts are called, everywhere:
///
///     gain, runner-up-gain   rms distance of the history from the reference over that from the
///                            motion under this cause, and under the next best one
///     uncertainty            half width of the 95 % interval of `value`, in its unit
///     expected               what the case has in place of `value`
///     mass, impact, contact  which one, from 1
///     files                  histories that show the cause with the same value
///     order                  power of the step that `value` or the error falls with
///     floor                  error relative to the envelope below which nothing falls
///     step                   step at which something begins or ends [s]
///     steps                  `value` in steps
///     penetration            largest violation of the gap [m]
///     stiffness              apparent stiffness of the contact [N/m]
///     digits                 decimal digits of a printed number
///     share                  part of the rows, runs or impacts that show the cause, 0 to 1
///     time                   where it happens [s]
inline constexpr auto fact_names = std::to_array<std::string_view>(
    {"gain", "runner-up-gain", "uncertainty", "expected", "mass", "impact", "contact", "files",
     "order", "floor", "step", "steps", "penetration", "stiffness", "digits", "share", "time"});

/// One cause.
struct Diagnosis {
  std::string code;  ///< one of `diagnosis_codes`
  /// The parameter of the cause, in `unit`; NaN where the code has none. Its meaning by code stands
  /// in the table of docs/manual/reference/diagnoses.md.
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string unit;
  double confidence = 0.0;     ///< 0 to 1; only what reaches `least_confidence` is reported
  std::vector<Fact> evidence;  ///< in the order in which a reader wants them
  /// A name where the cure needs one: "t,u2,v2,u1,v1" for --columns, the unit "mm", a column.
  std::string text;
  std::string runner_up;  ///< code of the next best cause, empty for none

  /// The fact of that name; NaN without it.
  double fact(std::string_view name) const {
    for (const auto& one : evidence)
      if (one.name == name) return one.value;
    return std::numeric_limits<double>::quiet_NaN();
  }
};

/// Below it a cause is not reported.
inline constexpr double least_confidence = 0.5;

// clang-format off
/// Every cause that is looked for. The first block describes files, the second time, the third the
/// system, the fourth impacts, the fifth what refinement shows.
inline constexpr auto diagnosis_codes = std::to_array<Code>({
    "unit-scaled", "columns-exchanged", "masses-exchanged", "sign-reversed", "starts-at-rest",
    "velocity-at-half-steps", "velocity-order-lower", "printed-digits", "single-precision",
    "output-resampled", "ends-early",
    "time-shifted", "time-unit", "time-drifts",
    "restitution-differs", "mass-ratio-differs", "frequency-differs", "damping-differs",
    "damping-changes-at-impact", "gap-differs",
    "impact-missed", "impact-doubled", "impact-impulse-wrong", "impact-at-step-end",
    "impact-interpolated", "impact-tolerance", "contact-compliant", "contact-in-tension",
    "wrong-limit", "noise-floor", "commensurate-steps", "numerical-damping", "period-error",
    "unstable-coarse-steps",
});
// clang-format on

/// Confidence from which a cause changes the verdict.
inline constexpr double sure = 0.9;

/// Whether a cause that is sure means another system than the case: no refinement leads to its motion.
inline bool is_other_system(const Diagnosis& found) {
  // clang-format off
  constexpr auto codes = std::to_array<Code>({
      "restitution-differs", "mass-ratio-differs", "frequency-differs", "damping-differs",
      "damping-changes-at-impact", "gap-differs", "impact-missed", "impact-doubled",
      "impact-impulse-wrong"});
  // clang-format on
  for (const auto& code : codes)
    if (found.code == code.name()) return found.confidence >= sure;
  return false;
}

/// Whether a cause that is sure means that a floor is noise, not another motion.
inline bool is_noise(const Diagnosis& found) {
  return found.code == Code("noise-floor").name() && found.confidence >= sure;
}

}  // namespace clackers::diagnose
