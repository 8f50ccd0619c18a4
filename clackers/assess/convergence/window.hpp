#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clackers/assess/convergence/error_ladder.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::assess {

/// Consecutive levels [first, last] of a ladder, zero-based, and the line through their raw points
/// in logarithmic axes. Up to one point in `luck_share` that lies far below all others does not pull
/// at the line: an error that passes through zero is luck, one that is too large is not.
struct Window {
  int first = 0, last = 0;
  numerics::LineFit line;
  std::vector<double> rates;        ///< slope of the raw points of each two adjacent levels
  std::vector<double> rate_errors;  ///< their standard errors, infinite for two points alone
  int points = 0;
  int far_above = 0, far_below = 0;  ///< raw points further from the line than `straight_scatter`
  double scatter =
      1.0;  ///< largest factor between a raw error and the line, either way, luck included

  int levels() const { return last - first + 1; }
};

/// A raw error further than this factor from its line makes the line doubtful. Methods that locate
/// impacts were measured to stay within 1.05 in their asymptotic range, those that do not to
/// scatter by 10 to 30.
inline constexpr double straight_scatter = 1.5;
/// One raw point in this many may lie far below a line, and few enough far above leave its order
/// readable though no longer straight: half a point a level of the default eight.
inline constexpr int luck_share = 16;
/// A line needs this many consecutive levels.
inline constexpr int shortest_window = 4;
/// Rates of a straight line lie this close to its slope: a factor 2^0.2 = 1.15 for a halved step.
inline constexpr double straight_rates = 0.2;

/// The window, or nothing when its points do not carry a line (levels of zeros alone).
std::optional<Window> window(std::span<const LevelView> levels, int first, int last);

/// What is asked of a line.
struct Straightness {
  double rates = straight_rates;  ///< largest |rate - centre|
  bool around_slope = true;       ///< the centre is the line's own slope; otherwise `centre`
  double centre = 0.0;
  int outliers_of = 0;  ///< when positive, one point in this many may lie far above
};

/// Whether the rates are as asked, at most one raw point in `luck_share` lies far below the line, and
/// none (or as few as asked) far above.
bool is_straight(const Window& window, const Straightness& asked);

/// The longest straight window that ends at level `last` and begins at `first` or later. A third
/// of the tolerance of rates is tried before the whole, so that a clean asymptotic range is not
/// diluted by the bend in front of it.
std::optional<Window> longest_straight(std::span<const LevelView> levels, int first, int last,
                                       Straightness asked);

}  // namespace clackers::assess
