#pragma once

#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods::checks {

/// Steps from x0 in a problem with load and damping, and what formulas ask of them. For tests only.
struct OneStep {
  Ramps<1> problem{1, 0.3};
  model::State<1> x0 = problem.exact(1.0), x1 = x0;
  double m = problem.system.mass(0, 0), c = problem.system.damping(0, 0),
         k = problem.system.stiffness(0, 0);

  std::vector<model::State<1>> path{x0};  ///< x0, x1 and as many more as were asked for

  OneStep(const std::string& specification, double h, int steps = 1) {
    auto now = x0;
    SingleSteps<1> stepper(specification, problem.system, h, now);
    for (int i = 0; i < steps; ++i) {
      stepper.step(now);
      path.push_back(now);
    }
    x1 = path[1];
  }
  double load(double t) const {
    double f = 0.0;
    problem.system.add_load(t, {&f, 1});
    return f;
  }
  double a(double t, double u, double v) const { return (load(t) - c * v - k * u) / m; }
  double a(const model::State<1>& x) const { return a(x.t, x.u[0], x.v[0]); }
};

}  // namespace clackers::methods::checks
