#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "clackers/judge/convergence/fit/error_ladder.hpp"

// Ladders of errors made by hand, for tests.
namespace clackers::judge::synthetic {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Shape of the default ladder of a study: runs to 20 s.
struct Shape {
  int levels = 8, samples = 8;
  double coarsest = 0.05, end = 20.0;
};

/// Errors `error(h)` at the steps of a shape, each with the rounding floor of its number of steps.
inline std::vector<ErrorLevel> ladder(const std::function<double(double)>& error,
                                      const Shape& shape = {}) {
  std::vector<ErrorLevel> made;
  for (int i = 0; i < shape.levels; ++i) {
    made.emplace_back();
    for (int j = 0; j < shape.samples; ++j) {
      const double n =
          std::round(shape.end / shape.coarsest * std::exp2(i + double(j) / shape.samples));
      const double h = shape.end / n;
      made.back().push_back({h, error(h), n * std::numeric_limits<double>::epsilon()});
    }
  }
  return made;
}

/// A factor, uniform in its logarithm between 1 and `scatter`.
class Scatter {
 public:
  Scatter(double scatter, unsigned seed) : log_(0.0, std::log(scatter)), random_(seed) {}
  double operator()() { return std::exp(log_(random_)); }

 private:
  std::uniform_real_distribution<double> log_;
  std::mt19937 random_;
};

/// A factor that swings between 1/amplitude and amplitude, `period` levels of ratio 2 a swing.
inline double swing(double h, double amplitude, double period) {
  return std::pow(amplitude, std::sin(2.0 * std::numbers::pi * std::log2(h) / period));
}

/// What an impact noticed at the end of its step does: each of `impacts` impacts adds a delay
/// between 0 and h, by the place in the step where it happens.
inline double late_impacts(double h, int impacts, double first = 1.571, double spacing = 3.1455) {
  double shift = 0.0, worst = 0.0;
  for (int k = 0; k < impacts; ++k) {
    const double t = first + k * spacing + shift;
    shift += h * (std::ceil(t / h) - t / h);
    // Alternating impacts of an elastic pair give a delay back at the next one.
    shift = -shift;
    worst = std::max(worst, std::abs(shift));
  }
  return worst;
}

}  // namespace clackers::judge::synthetic
