#pragma once

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/trajectory.hpp"

// Motions of two masses written as formulas, and their histories, for tests.
namespace clackers::measure {

/// Two undamped masses of 1 and 1/2 kg, frequencies w1 and w2, mass 1 above.
inline model::ImpactProblem<> masses(double w1, double w2, double restitution = 1.0) {
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::Vector2d(1.0, 0.5).asDiagonal();
  problem.system.stiffness = Eigen::Vector2d(w1 * w1, 0.5 * w2 * w2).asDiagonal();
  problem.system.damping = Eigen::Matrix2d::Zero();
  problem.contacts.push_back({Eigen::Vector2d(1.0, -1.0), 0.0, restitution});
  problem.start = {0.0, Eigen::Vector2d(1.0, -1.0), Eigen::Vector2d(0.0, 0.0)};
  problem.end = 40.0;
  return problem;
}

using StateAt = std::function<FreeState(double)>;

inline model::Trajectory sampled(const StateAt& state, double end, double step, bool velocities) {
  model::Trajectory history;
  history.dof = 2;
  for (long i = 0; double(i) * step <= end; ++i) {
    const auto now = state(double(i) * step);
    history.t.push_back(now.t);
    history.u.insert(history.u.end(), now.u.begin(), now.u.end());
    if (velocities) history.v.insert(history.v.end(), now.v.begin(), now.v.end());
  }
  return history;
}

/// Masses that pass through each other as if there were no contact.
inline StateAt unconstrained_motion(double w1, double w2, double phase) {
  return [=](double t) {
    return FreeState{t, Eigen::Vector2d(std::cos(w1 * t), -std::cos(w2 * t + phase)),
                     Eigen::Vector2d(-w1 * std::sin(w1 * t), w2 * std::sin(w2 * t + phase))};
  };
}

/// Every time, displacement and velocity as a program with so many digits prints it.
inline model::Trajectory printed(model::Trajectory history, int digits) {
  for (auto* column : {&history.t, &history.u, &history.v})
    for (double& entry : *column) {
      char text[40];
      std::snprintf(text, sizeof text, "%.*g", digits, entry);
      entry = std::stod(text);
    }
  return history;
}

/// Equal masses and frequencies: u1 - u2 is one oscillator above a stop, u1 + u2 = 0. A spring of
/// stiffness k works while they overlap: contact for pi / wc with wc^2 = w^2 + 2 k, deepest at
/// gap rate / wc.
struct Penalty {
  static constexpr double pi = std::numbers::pi;
  double stiffness;
  double wc() const { return std::sqrt(1.0 + 2.0 * stiffness); }
  double contact() const { return pi / wc(); }
  double first(int k) const { return 0.5 * pi + k * (pi + contact()); }
  FreeState operator()(double t) const {
    double x = t - first(0), g = -std::sin(x), rate = -std::cos(x);  // of half the gap
    if (x > 0.0) {
      x = std::fmod(x, pi + contact());
      const bool in_contact = x < contact();
      const double y = x - contact();
      g = in_contact ? -std::sin(wc() * x) / wc() : std::sin(y);
      rate = in_contact ? -std::cos(wc() * x) : std::cos(y);
    }
    return {t, Eigen::Vector2d(g, -g), Eigen::Vector2d(rate, -rate)};
  }
};

inline model::ImpactProblem<> equal_masses() {
  auto problem = masses(1.0, 1.0);
  problem.system.mass.setIdentity();
  problem.system.stiffness.setIdentity();
  return problem;
}

}  // namespace clackers::measure
