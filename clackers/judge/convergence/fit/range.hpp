#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/assessment.hpp"
#include "clackers/judge/convergence/fit/error_ladder.hpp"
#include "clackers/judge/convergence/fit/window.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"

namespace clackers::judge {

/// Where the levels of a ladder lie, from the finest one down: what every rule of fit_ladder reads.
struct Range {
  std::vector<LevelView> levels;
  double smallest_step = 0.0;
  int finest = -1;             ///< the last level
  int first = 0;               ///< start of the usable levels that lead to it without a gap
  int tracked = 0;             ///< the first of them with errors smaller than the motion itself
  int above = -1, clear = -1;  ///< the last one above the rounding floor, and the last well above
  std::optional<Window> line;  ///< the longest straight one that ends at `clear`
  LadderFit blank;             ///< steps, errors and the rounding floor alone

  const LevelView& level(int i) const { return levels[std::size_t(i)]; }
  /// The last `count` clear levels.
  std::optional<Window> last(int count) const { return window(levels, clear - count + 1, clear); }
  int clear_levels() const { return clear - first + 1; }
  int tracked_levels() const { return clear - tracked + 1; }
};

/// Throws as view() does.
Range range_of(std::span<const ErrorLevel> ladder, const FitContext& context);

// What rules return.

LadderFit shows(LadderFit fit, Behaviour behaviour, std::string_view reason = {});
LadderFit undecided(const Range& range, Code reason);
LadderFit diverges(const LadderFit& fit);
/// The line of a window with the uncertainty of its order; what levels that rounding may bend do to
/// the slope is part of it.
LadderFit with_line(const Range& range, const Window& found);
/// How far the order of the levels [first, last] may lie above the slope that they show because a floor
/// bends them: up to the order of  a h^p + c , and from a slope below one, where the coarser half of the
/// ladder is steeper, up to one at least: methods of a lower order are rare, floors are not.
double shortfall_of_floor(const Range& range, int first, int last, double slope);
/// One run a level, and the errors before the window go up and down: a few of them lie on a line by
/// chance.
bool is_underdetermined(const Range& range, const Window& found);
/// Of an order: reduced where it is more than a tenth below the claim, otherwise proper.
Behaviour behaviour_of_order(double order, const FitContext& context);
/// The reason of a floor; `rough` where its runs scatter.
Code floor_reason(const FitContext& context, bool rough);

/// How many octaves equally spread points cover: the distance of the outer ones, and one spacing.
double octaves_of(const RawPoints& points);

/// Most clear levels have one run: scatter cannot be distinguished from order.
bool one_sample_a_level(const Range& range);

/// A line says something of an order where it spans this many octaves.
inline constexpr double shortest_line = 3.0;

/// The claimed line, or where nothing is claimed any, of the levels up to `last`, if it spans
/// `shortest_line` octaves; of three levels at least.
std::optional<Window> line_up_to(const Range& range, const FitContext& context, int last);

/// The order of errors that follow a line, ln against ln, and what a bend makes of it.
struct OrderInterval {
  double slope = 0.0;   ///< of the line
  double spread = 0.0;  ///< half width of the slope's 95 % interval (Student), bend left out
  /// Order as the step goes to zero of the law  a h^q (1 + c h)  that fits best: h is the slowest of
  /// the next terms, so that a faster one leaves the order between the slope and this.
  double limit = 0.0;
  double coarsest = 0.0;  ///< slope of that law at the largest step
  double gain = 0.0;      ///< what that law lowers n ln(mean square) by, against the line

  /// Half width of the interval of the order about the slope: that of the line and, where the points
  /// bend, the distance to the farther end of the law. Below the finest step they may bend on, or have
  /// been bent by a floor.
  double half_width() const;
};

/// Fits both to points of at least two different x = ln h. Fewer than five points do not bend.
OrderInterval order_interval(std::span<const double> x, std::span<const double> y);

}  // namespace clackers::judge
