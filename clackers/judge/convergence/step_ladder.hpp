#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "clackers/model/run.hpp"

namespace clackers::judge {

/// The steps of a refinement study.
struct RefinementPlan {
  double coarsest = 0.05;     ///< [s], 0 < coarsest <= end
  int levels = 8;             ///< 1 or more; each level halves the step of the one before
  int samples_per_level = 8;  ///< 1 to 64 steps, of ratio 2^(1/samples_per_level)
};

/// The steps of one level.
struct StepLevel {
  double nominal = 0.0;           ///< coarsest / 2^level [s]
  std::vector<long long> counts;  ///< numbers of steps n, ascending
  std::vector<double> steps;      ///< end / n [s], coarsest first
};

using model::most_steps;

/// The steps end / n of a study, n whole, so that every run ends on `end`.
///
/// n is the whole number nearest to the wanted end / h; then, among the numbers at most a quarter
/// of the way to the steps before and behind, the nearest one for which every t / h, t an impact time,
/// stays at least min(0.05, 1/(4 K)) away from whole numbers (K impact times; four in ten numbers
/// or more allow that), or the one that stays away furthest where none allows it.
/// Numbers are strictly ascending through the ladder: where the steps are so long that two
/// coincide, a level has fewer of them, but at least one.
///
/// Only impact times within (0, end) count. Throws InputError for coarsest <= 0, above end or not
/// finite, for levels or samples outside their range, and with code too-many-steps when the
/// finest run would need more than 1e9 steps.
std::vector<StepLevel> step_ladder(const RefinementPlan& plan, double end,
                                   std::span<const double> impact_times);

/// The levels of any set of steps (or tolerances): indices into `steps`, coarsest level first, within
/// a level coarsest first, equal steps in the order given.
///
/// A level is one octave. The octaves begin at or shortly above the largest step: their edges lie in
/// the middle of a gap of the fractional parts of log2 h, the first one above the largest step that is
/// at least half as wide as the widest. So neither steps end / n, which miss their nominal values by
/// a little, nor uneven ones are divided by coincidence. Octaves without a step are left out: steps in a
/// ratio of 3, 4 or 10 are one level each.
///
/// Throws InputError unless every step is positive and finite.
std::vector<std::vector<std::size_t>> levels_of_steps(std::span<const double> steps);

}  // namespace clackers::judge
