#pragma once

#include <span>

namespace clackers::judge {

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
