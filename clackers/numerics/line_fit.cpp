#include "clackers/numerics/line_fit.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::numerics {
namespace {

constexpr auto who = "line fit";

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

void validate(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size())
    refuse(who, "number of y", double(y.size()), "as many as x", {}, "wrong-size");
  if (x.size() < 2)
    refuse(who, "number of points", double(x.size()), "at least 2", {}, "wrong-size");
  for (const double value : x) require_finite(who, "x", value);
  for (const double value : y) require_finite(who, "y", value);
}

}  // namespace

double student_t95(int freedom) {
  if (!(freedom >= 1)) refuse(who, "degrees of freedom", double(freedom), "at least 1");
  // A value takes microseconds, and fits ask for the same ones.
  static std::array<std::atomic<double>, 512> known{};
  const auto index = std::size_t(freedom);
  double t = index < known.size() ? known[index].load() : 0.0;
  if (t == 0.0) t = boost::math::quantile(boost::math::students_t(double(freedom)), 0.975);
  if (index < known.size()) known[index] = t;
  return t;
}

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  validate(x, y);
  const double x0 = mean(x), y0 = mean(y);
  double sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - x0) * (x[i] - x0);
    sxy += (x[i] - x0) * (y[i] - y0);
  }
  if (!(sxx > 0.0)) refuse(who, "x", x0, "at least two different values");
  LineFit fit;
  fit.slope = sxy / sxx;
  fit.intercept = y0 - fit.slope * x0;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    // From the centre, so that a far-away origin of x costs no digits.
    const double residual = (y[i] - y0) - fit.slope * (x[i] - x0);
    squares += residual * residual;
    fit.largest_above = std::max(fit.largest_above, residual);
    fit.largest_below = std::max(fit.largest_below, -residual);
  }
  const int freedom = int(x.size()) - 2;
  if (freedom == 0) {
    fit.slope_error = fit.slope_spread = std::numeric_limits<double>::infinity();
  } else {
    fit.slope_error = std::sqrt(squares / freedom / sxx);
    fit.slope_spread = student_t95(freedom) * fit.slope_error;
  }
  return fit;
}

}  // namespace clackers::numerics
