#pragma once

// Problems with a known motion and how to run them. For tests only.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "clackers/methods/registry.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::methods::runs {

struct Result {
  model::Trajectory trajectory;
  model::Outcome outcome;
};

/// A step, or for adaptive methods a tolerance whose steps are not longer on problems of this size.
inline Resolution resolution_of(const Method& method, double h) {
  return method.facts().is_adaptive ? Resolution::by_tolerance(1e-8) : Resolution(h);
}

inline Result run(const std::string& specification, const model::ImpactProblem<>& problem,
                  double h) {
  model::TrajectorySink sink(true);
  const auto chosen = method(specification);
  const auto outcome = chosen->prepare(problem, resolution_of(*chosen, h))->advance(sink);
  return {sink.trajectory(), outcome};
}

/// One mass m u'' + c u' + k u = load against a stop at u = 0 from above.
inline model::ImpactProblem<> mass_on_stop(double m, double c, double k, double u, double v,
                                           double eta, double end) {
  using Number = Eigen::MatrixXd;
  model::ImpactProblem<> p;
  p.system = {Number::Constant(1, 1, m), Number::Constant(1, 1, c), Number::Constant(1, 1, k)};
  p.contacts = {{Eigen::VectorXd::Constant(1, 1.0), 0.0, eta}};
  p.start = {0.0, Eigen::VectorXd::Constant(1, u), Eigen::VectorXd::Constant(1, v)};
  p.end = end;
  return p;
}

/// A stop at the equilibrium of a damped unit mass, started at t = 1 on its free motion from
/// u(0) = 1, v(0) = -sigma: u = eta^k exp(-sigma t) |cos(w t)|, an impact at every odd w t = pi/2.
struct RattlingMass {
  double sigma = 0.05, eta = 1.0, w = 1.0;

  int count(double t) const { return int(std::floor(w * t / std::numbers::pi + 0.5)); }
  double impact_time(int k) const { return (k - 0.5) * std::numbers::pi / w; }
  double u(double t) const {
    return std::pow(eta, count(t)) * std::exp(-sigma * t) * std::abs(std::cos(w * t));
  }
  double v(double t) const {  // away from impacts
    const double sign = count(t) % 2 == 0 ? 1.0 : -1.0;
    return -sign * std::pow(eta, count(t)) * std::exp(-sigma * t) *
           (sigma * std::cos(w * t) + w * std::sin(w * t));
  }
  model::ImpactProblem<> problem(double end) const {
    auto p =
        mass_on_stop(2.0, 4.0 * sigma, 2.0 * (w * w + sigma * sigma), u(1.0), v(1.0), eta, end);
    p.start.t = 1.0;
    return p;
  }
};

}  // namespace clackers::methods::runs
