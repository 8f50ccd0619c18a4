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
/// impact times are fitted beside it. The rules, which say what a fit, energies, missed and extra
/// impacts, printed digits and a tolerance are worth, are those of
/// docs/manual/reference/verdict-rules.md, in its order: behaviour_of() has the conditions that replace
/// the result of a fit, compare() and evidence_of() the verdicts. A claim is two-sided.
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
