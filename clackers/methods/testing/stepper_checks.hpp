#pragma once

// What every integrator's test checks of its stepper against its facts. For tests only.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/model/system.hpp"

namespace clackers::methods::checks {

/// Slope of log(error) over log(h) by least squares, and the largest distance of a point from the
/// line, as a factor.
struct Fit {
  double order, scatter;
};

inline Fit observed_order(const std::function<double(double)>& error, double coarsest, int levels) {
  std::vector<double> x, y;
  double mx = 0.0, my = 0.0, sxx = 0.0, sxy = 0.0, worst = 0.0;
  for (int i = 0; i < levels; ++i) {
    const double h = coarsest * std::exp2(-i);
    x.push_back(std::log(h));
    y.push_back(std::log(error(h)));
    mx += x.back() / levels;
    my += y.back() / levels;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - mx) * (x[i] - mx);
    sxy += (x[i] - mx) * (y[i] - my);
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    worst = std::max(worst, std::abs(y[i] - my - sxy / sxx * (x[i] - mx)));
  return {sxy / sxx, std::exp(worst)};
}

/// u'' + c u' + u = t has the line t - c and a free oscillation, from u(0) = 1, v(0) = 1, c < 2.
inline std::pair<double, double> ramp_exact(double c, double t) {
  const double s = -0.5 * c, w = std::sqrt(1.0 - s * s), e = (1.0 + c) * std::exp(s * t);
  return {t - c + e * (std::cos(w * t) - s / w * std::sin(w * t)), 1.0 - e / w * std::sin(w * t)};
}

/// Dof such oscillators q of dampings c, c + 0.1, ..., seen through u = S q: full matrices.
template <int Dof>
struct Ramps {
  Eigen::Index n;
  double c;
  model::Matrix<Dof> s, inverse;
  model::SmoothSystem<Dof> system;

  Ramps(Eigen::Index size, double damping)
      : n(size), c(damping), s(size, size), inverse(size, size) {
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) s(i, j) = i == j ? 1.5 : 0.5 / double(1 + i + 2 * j);
    inverse = Eigen::MatrixXd(s).inverse();
    model::Matrix<Dof> diagonal = model::Matrix<Dof>::Identity(n, n);
    for (Eigen::Index i = 0; i < n; ++i) diagonal(i, i) = c + 0.1 * double(i);
    system.mass = system.stiffness = inverse.transpose() * inverse;
    system.damping = inverse.transpose() * diagonal * inverse;
    system.add_load = [this](double t, std::span<double> f) {
      for (Eigen::Index i = 0; i < n; ++i) f[std::size_t(i)] += t * inverse.col(i).sum();
    };
  }
  Ramps(const Ramps&) = delete;

  model::State<Dof> exact(double t) const {
    model::Vector<Dof> q(n), p(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto [u, v] = ramp_exact(c + 0.1 * double(i), t);
      q[i] = u;
      p[i] = v;
    }
    return {t, s * q, s * p};
  }
};

/// Error at t = 6 of a run that starts on the exact solution at t = 1: no multiple of the period,
/// over which amplitude errors would cancel.
template <int Dof, class Method, class Problem>
double error_at_six(const Method& method, const Problem& problem, double h) {
  const auto steps = std::lround(5.0 / h);
  typename Method::template Stepper<Dof> stepper(method, problem.system, 5.0 / double(steps));
  model::State<Dof> now = problem.exact(1.0);
  stepper.restart(now);
  for (long i = 0; i < steps; ++i) stepper.step(now);
  EXPECT_FALSE(stepper.failed());
  EXPECT_NEAR(now.t, 6.0, 1e-14);
  const auto reference = problem.exact(6.0);
  return std::hypot((now.u - reference.u).norm(), (now.v - reference.v).norm());
}

template <class Method>
void converges_at_the_order_it_claims(const Method& method, double coarsest = 1.0 / 32) {
  SCOPED_TRACE(method.facts().name);
  const double order = method.facts().smooth_order;
  for (const double c : {0.0, 0.3}) {
    const Ramps<1> one(1, c);
    const Ramps<2> two(2, c);
    const Ramps<model::any_dof> three(3, c);
    const auto fit1 =
        observed_order([&](double h) { return error_at_six<1>(method, one, h); }, coarsest, 4);
    const auto fit2 =
        observed_order([&](double h) { return error_at_six<2>(method, two, h); }, coarsest, 4);
    const auto fit3 = observed_order(
        [&](double h) { return error_at_six<model::any_dof>(method, three, h); }, coarsest, 4);
    EXPECT_NEAR(fit1.order, order, 0.05) << "one, c = " << c << ", scatter " << fit1.scatter;
    EXPECT_NEAR(fit2.order, order, 0.05) << "two, c = " << c << ", scatter " << fit2.scatter;
    EXPECT_NEAR(fit3.order, order, 0.05) << "three, c = " << c << ", scatter " << fit3.scatter;
  }
}

/// p = u^3 + u^2 v / 5 on each degree of freedom.
template <int Dof>
struct CubicForce : model::NonlinearForce<Dof> {
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;
  void add(const Vector& u, const Vector& v, Vector& p) const override {
    p.array() += u.array().cube() + 0.2 * u.array().square() * v.array();
  }
  void add_tangent(const Vector& u, const Vector& v, Matrix& du, Matrix& dv) const override {
    du.diagonal().array() += 3.0 * u.array().square() + 0.4 * u.array() * v.array();
    dv.diagonal().array() += 0.2 * u.array().square();
  }
};

/// u'' + 0.3 u' + u + p(u, v) = f with f chosen so that u = sin(t + phase).
template <int Dof>
struct Cubic {
  Eigen::Index n;
  model::SmoothSystem<Dof> system;

  explicit Cubic(Eigen::Index size) : n(size) {
    system.mass = system.stiffness = model::Matrix<Dof>::Identity(n, n);
    system.damping = 0.3 * system.mass;
    system.nonlinear = std::make_shared<CubicForce<Dof>>();
    system.add_load = [this](double t, std::span<double> f) {
      const auto x = exact(t);
      for (Eigen::Index i = 0; i < n; ++i)
        f[std::size_t(i)] += 0.3 * x.v[i] + std::pow(x.u[i], 3) + 0.2 * x.u[i] * x.u[i] * x.v[i];
    };
  }
  Cubic(const Cubic&) = delete;

  model::State<Dof> exact(double t) const {
    model::State<Dof> x{t, model::Vector<Dof>(n), model::Vector<Dof>(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
      x.u[i] = std::sin(t + double(i));
      x.v[i] = std::cos(t + double(i));
    }
    return x;
  }
};

template <class Method>
void converges_at_the_same_order_with_a_nonlinear_force(const Method& method) {
  SCOPED_TRACE(method.facts().name);
  const Cubic<1> one(1);
  const Cubic<model::any_dof> three(3);
  const auto fit1 =
      observed_order([&](double h) { return error_at_six<1>(method, one, h); }, 1.0 / 32, 4);
  const auto fit3 = observed_order(
      [&](double h) { return error_at_six<model::any_dof>(method, three, h); }, 1.0 / 32, 4);
  EXPECT_NEAR(fit1.order, method.facts().smooth_order, 0.05) << "scatter " << fit1.scatter;
  EXPECT_NEAR(fit3.order, method.facts().smooth_order, 0.05) << "scatter " << fit3.scatter;
}

/// An undamped free mass of unit frequency.
inline model::SmoothSystem<1> oscillator() {
  using Number = model::Matrix<1>;
  return {Number(1.0), Number(0.0), Number(1.0)};
}

/// The largest |u| after many steps of the oscillator from u = 1, v = 0.
template <class Method>
double growth(const Method& method, double h) {
  const auto system = oscillator();
  typename Method::template Stepper<1> stepper(method, system, h);
  model::State<1> now{0.0, model::Vector<1>(1.0), model::Vector<1>(0.0)};
  stepper.restart(now);
  for (int i = 0; i < 4000; ++i) stepper.step(now);
  return now.u.norm();
}

template <class Method>
void is_stable_exactly_where_it_claims(const Method& method) {
  SCOPED_TRACE(method.facts().name);
  const auto facts = method.facts();
  if (facts.is_unconditionally_stable()) {
    for (const double h : {1.0, 10.0, 1e3}) EXPECT_LT(growth(method, h), 1e6) << "h = " << h;
  } else {
    EXPECT_LT(growth(method, facts.stability_limit * 0.999), 1e6);
    EXPECT_GT(growth(method, facts.stability_limit * 1.001), 1e6);
  }
}

template <class Method>
void takes_a_partial_step_of_full_length_as_the_step(const Method& method) {
  SCOPED_TRACE(method.facts().name);
  const Ramps<2> problem(2, 0.3);
  model::State<2> now = problem.exact(1.0);
  typename Method::template Stepper<2> stepper(method, problem.system, 0.1);
  stepper.restart(now);
  for (int i = 0; i < 3; ++i) {  // also with a memory that no restart has made
    const model::State<2> whole = stepper.partial(now, 0.1);
    stepper.partial(now, 0.03);  // looking must not change anything
    stepper.step(now);
    EXPECT_EQ(now.u, whole.u);
    EXPECT_EQ(now.v, whole.v);
    EXPECT_NEAR(now.t, 1.1 + 0.1 * i, 1e-15 * 8);
  }
}

template <class Method>
void takes_a_step_back(const Method& method) {
  SCOPED_TRACE(method.facts().name);
  const Ramps<2> problem(2, 0.3);
  model::State<2> now = problem.exact(1.0);
  typename Method::template Stepper<2> stepper(method, problem.system, 0.1);
  stepper.restart(now);
  stepper.step(now);
  const model::State<2> before = now;
  stepper.step(now);
  const model::State<2> after = now;
  stepper.undo();
  EXPECT_EQ(stepper.partial(before, 0.1).u, after.u);
  now = before;
  stepper.step(now);
  EXPECT_EQ(now.u, after.u);
  EXPECT_EQ(now.v, after.v);
  EXPECT_EQ(now.t, after.t);
}

template <class Method>
void counts_time_and_does_not_sum_it(const Method& method) {
  const auto system = oscillator();
  typename Method::template Stepper<1> stepper(method, system, 0.1);
  model::State<1> now{1.0, model::Vector<1>(1.0), model::Vector<1>(0.0)};
  stepper.restart(now);
  for (int i = 0; i < 100000; ++i) stepper.step(now);
  EXPECT_EQ(now.t, 1.0 + 100000 * 0.1);
}

/// Everything above.
template <class Method>
void keeps_every_claim(const Method& method) {
  converges_at_the_order_it_claims(method);
  converges_at_the_same_order_with_a_nonlinear_force(method);
  is_stable_exactly_where_it_claims(method);
  takes_a_partial_step_of_full_length_as_the_step(method);
  takes_a_step_back(method);
  counts_time_and_does_not_sum_it(method);
}

}  // namespace clackers::methods::checks
