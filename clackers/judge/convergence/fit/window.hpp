#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clackers/judge/convergence/fit/error_ladder.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::judge {

/// Consecutive levels [first, last] of a ladder, zero-based, and the line through their raw points
/// in logarithmic axes. Up to one point in `outlier_share` that lies far below all others, as an
/// error near a passage through zero does, is left out of the line; a point far above never is.
struct Window {
  int first = 0, last = 0;
  numerics::LineFit line;
  std::vector<double> rates;        ///< slope of the raw points of each two adjacent levels
  std::vector<double> rate_errors;  ///< their standard errors, infinite for two points alone
  int points = 0;
  double largest_step = 0.0, smallest_step = 0.0;  ///< of the raw points
  int far_above = 0, far_below = 0;  ///< raw points further from the line than `straight_scatter`
  double scatter =
      1.0;  ///< largest factor between a raw error and the line, either way, of all points

  int levels() const { return last - first + 1; }
};

/// A line is not straight where a raw error lies further than this factor from it. Methods that
/// locate impacts were measured to stay within 1.05 in their asymptotic range, those that do not to
/// scatter by 10 to 30.
inline constexpr double straight_scatter = 1.5;
/// One raw point in this many may lie far below a line, and few enough far above leave its order
/// readable though no longer straight: half a point a level of the default eight.
inline constexpr int outlier_share = 16;
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

/// Whether the rates are as asked, at most one raw point in `outlier_share` lies far below the
/// line, and none (or as few as asked) far above.
bool is_straight(const Window& window, const Straightness& asked);

/// The longest straight window that ends at level `last` and begins at `first` or later. A third
/// of the tolerance of rates is tried before the whole, so that a clean asymptotic range is not
/// diluted by the bend in front of it.
std::optional<Window> longest_straight(std::span<const LevelView> levels, int first, int last,
                                       Straightness asked);

// Where the rates of a window are heading, coarse to fine.

/// A rate that moves by more than this from level to level moves for a reason: scatter within
/// `straight_scatter` at eight steps a level leaves a rate an error of 0.02.
inline constexpr double least_move = 0.04;
/// Smaller moves count where the scatter of the raw points makes an error in the rates this many
/// times smaller.
inline constexpr double significant_move = 3.0;

/// Whether a line of another slope than claimed might be the bend in front of the claimed one: its
/// slope, by as much as its 95 % confidence interval, or its finest rate lies within a tenth of the
/// claim; or its last three rates move towards the claim by more than `least_move` each, or by less
/// but significantly and so that their limit (Aitken's) lies within that tenth. So h |ln h| is
/// still on its way to order 1. `claimed` <= 0 is no claim. Needs three rates.
bool may_still_reach(double claimed, const Window& found);

/// Whether the last three rates exceed the claim and rise, each by more than `straight_rates`: an
/// error faster than any power of the step, or one before a line of higher order.
bool rates_rise(double claimed, const Window& found);

/// Where all rates move one way, how far from the slope they may end: a h^q (1 + r)
/// with r = c h has the rate q + r / (1 + r), which at r <= 1/2 has at most twice its last move to go;
/// or how far they were
/// at the coarsest step, where a floor has bent the rest. Otherwise 0: a confidence interval of the
/// slope knows nothing of such a bend.
double drift(const Window& found);

}  // namespace clackers::judge
