#pragma once

#include <span>

namespace clackers::numerics {

/// The least-squares line  y = intercept + slope x  through points of equal weight.
struct LineFit {
  double slope = 0.0, intercept = 0.0;
  double slope_error = 0.0;    ///< standard error of the slope, infinite for two points
  double slope_spread = 0.0;   ///< half width of the slope's 95 % confidence interval (Student t)
  double largest_above = 0.0;  ///< largest y - line, 0 where no point lies above
  double largest_below = 0.0;  ///< largest line - y, 0 where no point lies below

  double at(double x) const { return intercept + slope * x; }
};

/// Fits a line. Throws InputError unless x and y have the same size, at least two points, finite
/// values, and two different x.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

/// The factor t such that a Student variable with `freedom` >= 1 degrees of freedom lies within
/// [-t, t] with probability 0.95.
double student_t95(int freedom);

}  // namespace clackers::numerics
