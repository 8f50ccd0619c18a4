#pragma once

#include <optional>
#include <vector>

#include "clackers/base/judgement.hpp"
#include "clackers/judge/convergence/assessment.hpp"
#include "clackers/measure/errors/score.hpp"
#include "clackers/measure/impacts/shared_impacts.hpp"

namespace clackers::judge {

/// Largest distance of a measured order from the claimed one, relative: of a line, and of an upper
/// envelope. The logarithm of the largest of eight errors that scatter evenly (in logarithms) by a
/// factor 30 has the standard deviation 0.099 ln 30 = 0.34; over eight levels of ratio 2 that gives
/// a slope one of 0.34 / (6.5 ln 2) = 0.075, and 0.25 is three of them.
inline constexpr double order_tolerance = 0.1;
inline constexpr double envelope_order_tolerance = 0.25;

/// Errors within this factor of a line of the claimed order are proper, as claimed, and so are those
/// within what these octaves of the step make of it: more where the order is above four.
inline constexpr double proper_scatter = 2.0, proper_octaves = 0.25;

/// A run that ends with less or more than these shares of the true energy has not followed the
/// motion, whatever its error relative to an envelope: beyond a factor 2 amplitudes are off by 0.29
/// of themselves at least.
inline constexpr double least_energy_ratio = 0.5, largest_energy_ratio = 2.0;

/// A line whose order is uncertain by more than this share of the claim decides nothing.
inline constexpr double line_spread = 1.0 / 3.0;

/// An envelope whose order is uncertain by more than this share of the claim decides nothing.
inline constexpr double envelope_spread = 0.5;
/// Over this many octaves a wider interval still tells an order from its neighbours.
inline constexpr int enough_octaves = 5;
inline constexpr double wide_envelope_spread = 0.75;

/// A first row after the start holds the error of some steps; beyond this share of the envelope it
/// is of another motion.
inline constexpr double far_start = 0.1;

/// Errors above this share of the motion win and lose impacts.
inline constexpr double large_error = 0.01;

/// What is known of a history beside its score.
struct HistoryFacts {
  long long rows = 0;
  double printed_floor = 0.0;        ///< part of u_error that printing alone may make
  double first = 0.0;                ///< time of the first row [s]
  double start_error = 0.0;          ///< of the first row, relative to the envelopes
  bool rows_resolve_impacts = true;  ///< false: rows too far apart to find impacts in them
  double last = 0.0;                 ///< time of the last row [s]
  double end = 0.0;                  ///< of the case [s]; 0: not known, so no row is missing
  long long expected_to_last = 0;    ///< impacts of the reference until `last`
  long long expected = 0;            ///< impacts of the reference until `end`
};

/// What is known of a method or of histories beside their errors.
struct JudgeContext {
  double contact_time = 0.0;             ///< of a compliant contact [s], 0 for a rigid one
  std::optional<double> tolerance{};     ///< largest allowed u_error of the finest run
  std::optional<HistoryFacts> finest{};  ///< of the finest history; nothing for a method
  /// The differences between the histories shrink regularly where their errors do not: they converge
  /// to another limit than the true motion.
  bool wrong_limit = false;
  /// Code of a cause that its claim cannot stand beside, and the least verdict that it leaves.
  std::string cause_against{};
  Verdict least_verdict = Verdict::not_claimed;
  /// Code of why the runs show no order, whatever their errors; empty where they may.
  std::string no_ladder{};
  bool noise = false;  ///< a floor of the runs is noise, as their rows show
  /// Where contacts that share masses close together, if they do, and what the error does there.
  std::optional<measure::SharedImpacts> shared{};
  /// Longer steps may take impacts in another order [s]; measure::closest_impacts().
  double closest_impacts = 0.0;
  /// The ladder is one of tolerances of an adaptive solver: `step` of a run is its tolerance.
  bool by_tolerance = false;
};

/// Assesses a method by its ladder, coarsest level first, against its claim through impacts
/// (`undecided` claims nothing). Behaviour and verdict go by the displacement error; velocity and
/// impact times are fitted beside it. The rules for the behaviour, first hit wins:
///
///     divergent [energy-growth]     no line, errors that do not fall, and most runs of both finest
///                                   levels end with more than twice the true energy and with
///                                   more than it had at the start, unless a compliant law has
///                                   another limit (below)
///     divergent [simultaneous-impacts]
///                                   undecided, the errors of the four finest levels are as large as
///                                   the motion and do not fall, and they come from impacts of one
///                                   instant (comes_from_shared_impacts)
///     stagnating [simultaneous-impacts]
///                                   at an unexplained or a rough floor that comes from them, and at
///                                   any that is as large as the motion
///     stagnating [contact-stiffness]
///                                   a compliant law that claims nothing, as that of dry friction, whose
///                                   errors are as large as the motion and the same on the four finest
///                                   levels
///     stagnating [reason claimed]   at such a floor above `large_error`, where a claim to diverge, or
///                                   none, names its reason
///     undecided [numerical-damping] undecided with falling errors, and most of those runs end with
///                                   less than half of it
///     undecided [too-few-levels]    errors above `large_error` fall by no order that a method
///                                   has, and most runs of the finest level miscount impacts
///     stagnating [printed-digits]   the finest history's error is within `rounding_slack` of what
///                                   printing makes, and the fit is exact, a floor or has too few
///                                   levels
///     exact                         claimed, with errors that grow as steps shrink, but by no more than
///                                   rounding of second differences
///     reduced                       a straight line of the very order that is claimed as reduced
///     what fit_ladder found         otherwise
///
/// Where a line, an envelope or an unexplained floor above `large_error` does not agree, it is that of the
/// levels behind those at which more than a quarter of the runs miscount impacts with errors above
/// `large_error`, but for a finest level of that
/// kind. Where one does not agree, levels of steps longer than twice the time between impacts that take part in each
/// other (closest_impacts), or than a 32nd of it where irregular convergence is claimed, do not count either; with less
/// than four others it is undecided [too-few-levels]. Where an envelope that is claimed does not agree, that of the finer
/// half of the levels counts: if it no longer falls too fast, or if its whole interval is above the slope of all levels
/// and it agrees.
///
/// Verdict on the claim: `not claimed` without a claim; `undecided` where the behaviour is, where an
/// exact motion met a claim of some order (nothing above rounding to measure it on), where printed
/// digits hide the order, and where the spread of an envelope's order covers a claim beyond the
/// tolerance; `agrees` where the behaviour is the claimed one with an order within the tolerance
/// above, or the claimed reason of a floor (a floor without a claimed reason agrees with any, also
/// with one as large as the motion where impacts are simultaneous);
/// otherwise `disagrees`. A claim is two-sided: better than claimed is another behaviour and
/// disagrees as well, unless velocities are as claimed, or an irregular order is claimed and no impact
/// happens. Impacts missed or extra on the two finest levels disagree whatever the errors say, unless
/// the claim is a floor and their number is right (then they came too late to be matched) or, at the very
/// floor that is claimed, above `large_error`, off by at most a half; where an envelope is claimed, only
/// if most runs of both levels miscount. A claim to diverge says nothing of impacts, and agrees with a
/// floor above a tenth of the motion. A claim to converge disagrees where the files converge to another limit.
///
/// A tolerance has a verdict of its own, `undecided` where printing makes more than the difference
/// between error and tolerance. The finest history of no claimed behaviour disagrees where it is of
/// another motion: it starts far from the reference, misses an impact or has one too many. Of
/// several verdicts counts the first of disagrees, undecided, agrees, not claimed.
Assessment judge(const measure::Ladder& ladder, const Claim& claim, const JudgeContext& facts = {});

/// Half the distance between two claimed orders: a velocity whose order lies further below that of
/// the displacement has a lower one.
inline constexpr double lower_velocity_order = 0.5;

/// A history that ends before this share of the case has not shown it.
inline constexpr double early_end = 0.9;

/// The last run of the finest level; runs come coarsest first.
const measure::RunScore& finest_run(const measure::Ladder& ladder);

/// Whether a run ended and missed impacts or had some too many.
bool miscounts(const measure::RunScore& run);

/// What the verdict rests on beside the fits: `of_behaviour` is the verdict of the displacement's
/// behaviour alone. Empty for no levels.
std::vector<Evidence> evidence_of(const Assessment& fits, Verdict of_behaviour,
                                  const measure::Ladder& ladder, const Claim& claim,
                                  const JudgeContext& facts);

}  // namespace clackers::judge
