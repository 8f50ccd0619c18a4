#pragma once

#include <optional>
#include <vector>

#include "clackers/record/record.hpp"

// Which steps a study takes: chosen by the case where nothing is asked for, and refined further
// while the assessment of a subject is open.
namespace clackers::study {

/// The steps that a study is asked for; what is not given follows the case.
struct RefinementRequest {
  std::optional<double> coarsest{};  ///< [s]; nothing: default_coarsest()
  std::optional<int> levels{};  ///< nothing: default_levels(), of solvers default_solver_levels
  std::optional<int> samples_per_level{};  ///< nothing: 8, of solvers 4
  std::vector<double> tolerances{};  ///< of adaptive methods, descending; empty: 1e-3 to 1e-10
};

/// Whose default steps: runs of solvers cost more than those of methods.
enum class LadderKind { methods, solvers };
inline constexpr int default_samples_per_level = 8;
inline constexpr int default_solver_levels = 6, default_solver_samples_per_level = 4;

/// The default coarsest step: this many a fast period.
inline constexpr double default_steps_per_period = 14.0;

/// fast_period / 14, rounded to two significant digits, but not above `end` [s].
double default_coarsest(double fast_period, double end);

/// 8, or as many levels, at least 5, as keep the nominal step of the finest one above
/// end / 2^20.
int default_levels(double coarsest, double end);

/// The plan of a request on a case; the one place of defaults.
record::RefinementPlan plan_for(const RefinementRequest& request,
                                const record::CaseSummary& problem,
                                LadderKind kind = LadderKind::methods);

/// Largest number of steps a level that refinement chooses.
inline constexpr int most_samples_per_level = 32;

/// Levels that resolve a compliant contact (step <= contact time / 25) which refinement aims at:
/// the floor of a contact needs three flat ones.
inline constexpr int wanted_contact_levels = 3;

/// What refinement would run next, or why nothing.
struct NextPlan {
  std::optional<record::RefinementPlan> plan;
  record::RefinementEnd end = record::RefinementEnd::decided;  ///< where there is no plan
};

/// What a record says of a refinement from the ladder `asked` to `now`; nothing where the first was
/// enough. `next_seconds` is what did not fit into the budget.
std::optional<record::Refinement> refinement_of(const record::RefinementPlan& asked,
                                                const record::RefinementPlan& now,
                                                record::RefinementEnd end,
                                                double next_seconds = 0.0);

/// The next ladder of a subject, whose levels `ladder` are those of `plan`; depends on nothing else, so that
/// it is the same on every machine. The first rule that applies decides:
///
///  1 refused, incomplete, or decided: nothing. Undecided are the verdict `undecided` and an
///    agreement on an envelope whose order is more uncertain than the tolerance of envelopes.
///  2 a compliant contact that too few levels resolve: finer levels up to the first that does, then
///    one by one. Such a ladder is not decided by a disagreement: steps that do not resolve a contact miscount
///    impacts.
///  3 the finest level has a failed run: nothing
///  4 an envelope with an order more uncertain than its tolerance: twice the steps a level
///  5 the finest level is at the rounding floor: a coarser first level, while it has two steps a
///    fast period or more
///  6 anything else: one finer level, while it needs at most 1e9 steps
NextPlan next_plan(const record::Subject& subject, const measure::Ladder& ladder,
                   const record::RefinementPlan& plan, const record::CaseSummary& problem);

}  // namespace clackers::study
