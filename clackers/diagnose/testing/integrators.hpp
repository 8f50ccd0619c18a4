#pragma once

// Small solvers of impact problems, right ones and wrong ones, for tests of diagnoses. They share
// nothing with methods/. Masses are not coupled and there is one contact at most.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::diagnose::testing {

struct Masses {
  Eigen::VectorXd u, v;
};

/// One step of size h of M a + C v + K u = 0.
using Step = std::function<Masses(const model::SmoothSystem<>&, const Masses&, double h)>;

inline Eigen::VectorXd acceleration(const model::SmoothSystem<>& s, const Masses& x) {
  return -(s.damping.diagonal().cwiseProduct(x.v) + s.stiffness.diagonal().cwiseProduct(x.u))
              .cwiseQuotient(s.mass.diagonal());
}

inline Masses rk4(const model::SmoothSystem<>& s, const Masses& x, double h) {
  const auto slope = [&](const Masses& y) { return Masses{y.v, acceleration(s, y)}; };
  const auto add = [&](const Masses& k, double f) { return Masses{x.u + f * k.u, x.v + f * k.v}; };
  const auto a = slope(x), b = slope(add(a, 0.5 * h)), c = slope(add(b, 0.5 * h)),
             d = slope(add(c, h));
  return {x.u + h / 6.0 * (a.u + 2.0 * b.u + 2.0 * c.u + d.u),
          x.v + h / 6.0 * (a.v + 2.0 * b.v + 2.0 * c.v + d.v)};
}

/// Newmark's family; alpha is HHT's in [-1/3, 0] with its beta and gamma.
inline Step newmark(double beta, double gamma, double alpha = 0.0) {
  return [=](const model::SmoothSystem<>& s, const Masses& x, double h) {
    const auto a0 = acceleration(s, x);
    Masses y = x;
    for (Eigen::Index i = 0; i < x.u.size(); ++i) {
      const double m = s.mass(i, i), c = s.damping(i, i), k = s.stiffness(i, i), w = 1.0 + alpha;
      const double up = x.u[i] + h * x.v[i] + h * h * (0.5 - beta) * a0[i];
      const double vp = x.v[i] + h * (1.0 - gamma) * a0[i];
      const double a1 = -(w * (c * vp + k * up) - alpha * (c * x.v[i] + k * x.u[i])) /
                        (m + w * (gamma * h * c + beta * h * h * k));
      y.u[i] = up + h * h * beta * a1;
      y.v[i] = vp + h * gamma * a1;
    }
    return y;
  };
}
inline Step hht(double alpha) {
  return newmark(0.25 * (1.0 - alpha) * (1.0 - alpha), 0.5 - alpha, alpha);
}

inline Masses verlet(const model::SmoothSystem<>& s, const Masses& x, double h) {
  Masses y = x;
  y.v += 0.5 * h * acceleration(s, x);
  y.u += h * y.v;
  // Damping of the new velocity, solved for.
  for (Eigen::Index i = 0; i < x.u.size(); ++i)
    y.v[i] = (y.v[i] - 0.5 * h * s.stiffness(i, i) / s.mass(i, i) * y.u[i]) /
             (1.0 + 0.5 * h * s.damping(i, i) / s.mass(i, i));
  return y;
}

inline Masses implicit_euler(const model::SmoothSystem<>& s, const Masses& x, double h) {
  Masses y = x;
  for (Eigen::Index i = 0; i < x.u.size(); ++i) {
    const double m = s.mass(i, i), c = s.damping(i, i), k = s.stiffness(i, i);
    y.v[i] = (m * x.v[i] - h * k * x.u[i]) / (m + h * c + h * h * k);
    y.u[i] = x.u[i] + h * y.v[i];
  }
  return y;
}

inline Masses symplectic_euler(const model::SmoothSystem<>& s, const Masses& x, double h) {
  Masses y = x;
  y.v += h * acceleration(s, x);
  y.u += h * y.v;
  return y;
}

/// Two-stage, L-stable, second order (TR-BDF2 as a one-step method).
inline Masses tr_bdf2(const model::SmoothSystem<>& s, const Masses& x, double h) {
  const double g = 2.0 - std::sqrt(2.0);
  const auto middle = newmark(0.25, 0.5)(s, x, g * h);
  Masses y = x;
  const double a = 1.0 / (g * (2.0 - g)), b = (1.0 - g) * (1.0 - g) / (g * (2.0 - g)),
               w = (1.0 - g) / (2.0 - g) * h;
  for (Eigen::Index i = 0; i < x.u.size(); ++i) {
    const double m = s.mass(i, i), c = s.damping(i, i), k = s.stiffness(i, i);
    const double up = a * middle.u[i] - b * x.u[i], vp = a * middle.v[i] - b * x.v[i];
    y.v[i] = (m * vp - w * k * up) / (m + w * c + w * w * k);
    y.u[i] = up + w * y.v[i];
  }
  return y;
}

/// Where an impact is put.
enum class Location { root, linear, end_of_step };

struct Solver {
  Step step = rk4;
  Location location = Location::root;
  int missed = 0, doubled = 0;
  double impulse = 1.0;  ///< factor of all impulses
  double late = 0.0;     ///< the file's time minus the true one [s]
  int late_steps = 0;
  double clock = 1.0;          ///< the file's times over the true ones
  double tolerance = 0.0;      ///< of the root, in parts of a step
  double damping_after = 1.0;  ///< factor of the damping after the first impact
};

/// The history of the problem (which may be another one than the case's) on t = n h up to `end`.
inline model::Trajectory solve(const Solver& solver, const model::ImpactProblem<>& problem,
                               double h, double end) {
  model::Trajectory out;
  out.dof = int(problem.dof());
  auto s = problem.system;
  Masses x{problem.start.u, problem.start.v};
  const model::Contact<>* contact = problem.contacts.empty() ? nullptr : &problem.contacts[0];
  int hits = 0;
  bool inside = false;
  const auto collide = [&](Masses& y) {
    if (++hits == 1) s.damping *= solver.damping_after;
    if (hits == solver.missed) {
      inside = true;
      return;
    }
    const Eigen::VectorXd push = contact->direction.cwiseQuotient(s.mass.diagonal());
    const double factor = solver.impulse * (hits == solver.doubled ? 2.0 : 1.0);
    y.v -= factor * (1.0 + contact->restitution) * contact->gap_rate(y.v) /
           contact->direction.dot(push) * push;
  };
  const auto steps = std::lround(end / h);
  for (long n = 0; n <= steps; ++n) {
    const double t = solver.clock * h * double(n + solver.late_steps) + solver.late;
    if (t >= 0.0 && t <= end * (1.0 + 1e-12)) {
      out.t.push_back(std::min(t, end));
      for (const double one : x.u) out.u.push_back(one);
      for (const double one : x.v) out.v.push_back(one);
    }
    double left = h;
    for (int guard = 0; guard < 50 && left > 1e-14 * h; ++guard) {
      const auto y = solver.step(s, x, left);
      if (contact && inside && contact->gap_at(y.u) >= 0.0) inside = false;
      const bool crossed = contact && !inside && contact->gap_at(y.u) < 0.0 &&
                           (contact->gap_rate(y.v) < 0.0 || contact->gap_rate(x.v) < 0.0);
      if (!crossed) {
        x = y;
        break;
      }
      if (solver.location == Location::end_of_step) {
        x = y;
        if (contact->gap_rate(x.v) < 0.0) collide(x);
        break;
      }
      double low = 0.0, high = left;
      if (solver.location == Location::linear) {
        const double g0 = std::max(contact->gap_at(x.u), 0.0), g1 = contact->gap_at(y.u);
        high = left * g0 / (g0 - g1);
      } else {
        for (int i = 0; i < 60 && high - low > solver.tolerance * h; ++i) {
          const double middle = 0.5 * (low + high);
          (contact->gap_at(solver.step(s, x, middle).u) < 0.0 ? high : low) = middle;
        }
      }
      if (high > 0.0) x = solver.step(s, x, high);
      left -= high;
      if (contact->gap_rate(x.v) < 0.0) collide(x);
    }
  }
  return out;
}

}  // namespace clackers::diagnose::testing
