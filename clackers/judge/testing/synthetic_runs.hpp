#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "clackers/judge/convergence/self_convergence.hpp"

// Runs made by hand, for tests.
namespace clackers::judge::synthetic {

/// Runs of `levels` levels with the values `at(h)`, steps halved from `coarsest`, `samples` of
/// ratio 2^(1/samples) a level.
inline std::vector<ResponseLevel> runs(const std::function<std::vector<double>(double)>& at,
                                       int levels = 8, int samples = 1, double coarsest = 0.1,
                                       double floor = 0.0) {
  std::vector<ResponseLevel> made;
  for (int i = 0; i < levels; ++i) {
    made.emplace_back();
    for (int k = 0; k < samples; ++k) {
      const double h = coarsest * std::exp2(-i - double(k) / samples);
      made.back().push_back({h, at(h), floor});
    }
  }
  return made;
}

/// The first run of each level.
inline std::vector<Response> chain(const std::vector<ResponseLevel>& levels) {
  std::vector<Response> made;
  for (const auto& level : levels) made.push_back(level.front());
  return made;
}

/// u at t = 3 of u'' + stiffness u = 0 from u = 1 at rest by the implicit midpoint rule, order 2.
inline double midpoint(double h, double stiffness = 1.0) {
  double u = 1.0, v = 0.0;
  const auto steps = std::lround(3.0 / h);
  const double s = 3.0 / double(steps), w = 0.25 * s * s * stiffness;
  for (long i = 0; i < steps; ++i) {
    const double next = ((1.0 - w) * u + s * v) / (1.0 + w);
    v = ((1.0 - w) * v - s * stiffness * u) / (1.0 + w);
    u = next;
  }
  return u;
}

}  // namespace clackers::judge::synthetic
