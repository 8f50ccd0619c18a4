#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/base/codes.hpp"
#include "clackers/base/judgement.hpp"

namespace clackers::judge {

/// What a ladder of errors says: a behaviour, and a line  error = constant * h^order  where there
/// is one.
struct LadderFit {
  Behaviour behaviour = Behaviour::undecided;
  std::string reason;        ///< code, empty when the behaviour needs none
  bool has_line = false;     ///< false: order, spread and constant mean nothing
  bool on_envelope = false;  ///< the line is that of the upper envelope of each level
  double order = 0.0;
  double spread =
      0.0;  ///< half width of the order's 95 % confidence interval, or how far the finest
            ///< rate lies from it where the rates move one way and that is more
  double scatter = 1.0;  ///< largest factor between raw errors and the line, over the window
  double constant = 0.0;
  int first_level = 0, last_level = 0;  ///< window of the line, zero-based, inclusive
  /// Largest and smallest step of the runs in that window; a tolerance in a ladder of tolerances.
  double largest_step = 0.0, smallest_step = 0.0;
  double floor = 0.0;          ///< the level of stagnation or of rounding, 0 where none was seen
  double floor_step = 0.0;     ///< largest step at which the errors lie at the floor, 0 without one
  double floor_scatter = 1.0;  ///< largest factor between raw errors and the floor
  double cancel_step = 0.0;    ///< near it the signed error passes zero; 0 where it does not
  /// Share of the runs at the rounding floor because their step divides the time between impacts.
  double coincident_share = 0.0;
  double stable_step = 0.0;  ///< largest step below those whose runs failed; 0 where none did
  std::vector<double> steps, errors;  ///< of the upper envelope, a value a level
};

inline constexpr auto evidence_names = std::to_array<std::string_view>(
    {"impacts-miscounted", "printed-digits", "within-tolerance", "beyond-tolerance",
     "tolerance-not-resolved", "other-start", "other-impacts", "sparse-rows", "wrong-limit",
     "ends-early", "commensurate-steps", "errors-cancel", "unstable-coarse-steps",
     "steps-per-contact", "simultaneous-impacts", "more-samples", "velocity-order-lower",
     "velocity-order", "error-over-tolerance"});
using EvidenceCode = NameOf<evidence_names>;

/// A fact, beside the fits, that the verdict rests on. Its numbers by code:
///
///     impacts-miscounted      step [s], impacts matched, expected, extra
///     printed-digits          u_error of the finest history, what printing makes of it
///     within-tolerance        u_error of the finest history, the tolerance, what printing makes of it
///     beyond-tolerance        the same
///     tolerance-not-resolved  the same: error and tolerance are nearer than what printing makes
///     other-start             distance of the first row from the reference over the envelope
///     other-impacts           impacts matched, expected, extra, of a history without a claim
///     sparse-rows             none: rows too far apart to find impacts in them
///     wrong-limit             none: the files converge to another motion
///     ends-early              last time, end of the case [s], impacts until then, until the end
///     commensurate-steps      share of the runs at the rounding floor beside others that are not
///     errors-cancel           step at which the error passes zero [s]
///     unstable-coarse-steps   largest step below those that failed [s]
///     steps-per-contact       contact time over the finest step, contact time [s]
///     simultaneous-impacts    instant [s], contacts, error before it and after it
///     more-samples         order of the envelope, its spread
///     velocity-order-lower    order of the velocities, of the displacements
///     velocity-order          order of the velocities, its spread, the claimed one
///     error-over-tolerance    mean, least and largest error over tolerance, along the line
struct Evidence {
  std::string code;                        ///< one of `evidence_names`
  Verdict verdict = Verdict::not_claimed;  ///< of this only
  std::vector<double> numbers;
};
inline Evidence evidence(EvidenceCode code, Verdict verdict, std::vector<double> numbers = {}) {
  return {std::string(code.name()), verdict, std::move(numbers)};
}

/// What of a claim is contradicted, where the verdict is `disagrees`.
enum class Mismatch {
  none,
  behaviour,     ///< another behaviour than the claimed one
  lower_order,   ///< the claimed behaviour, with a lower order
  higher_order,  ///< the claimed behaviour, with a higher order
  floor_reason,  ///< a floor as claimed, of another cause
  evidence       ///< the errors agree; the first evidence that disagrees does not
};

/// The assessment of one method, or of the histories of one.
struct Assessment {
  LadderFit displacement;           ///< decides behaviour and verdict
  LadderFit velocity, impact_time;  ///< shown beside it
  Verdict verdict = Verdict::undecided;
  Mismatch mismatch = Mismatch::none;
  std::string reason;  ///< code of what decided, for `clackers explain`; empty when none is needed
  std::vector<Evidence> evidence;
};

}  // namespace clackers::judge
