#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace clackers::judge {

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
