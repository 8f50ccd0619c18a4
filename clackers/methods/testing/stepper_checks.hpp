#pragma once

// Steps an integrator alone, and compares it with its facts. For tests only.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clackers/methods/registry.hpp"
#include "clackers/methods/stepping/step_plan.hpp"
#include "clackers/model/system.hpp"

namespace clackers::methods::checks {

/// Steps that never end: t_k = start + k h.
inline StepPlan endless(double start, double h) {
  constexpr long long most = std::numeric_limits<long long>::max();
  return {start, std::numeric_limits<double>::infinity(), h, most, most};
}

/// An integrator with one step at a time.
template <int Dof>
class SingleSteps {
 public:
  using State = model::State<Dof>;

  SingleSteps(const std::string& specification, const model::SmoothSystem<Dof>& system, double h,
              const State& from)
      : stepper_(integrator(specification)->stepper(system, endless(from.t, h))) {
    stepper_->restart(from);
  }

  void step(State& now) {
    pair_ = {now, now};
    stepper_->advance(k_++, pair_);
    now = pair_[1];
  }
  /// Back to the state before the last step.
  void undo() { stepper_->rewind(--k_, pair_, 0); }

  AnyStepper<Dof>* operator->() { return stepper_.get(); }

 private:
  std::unique_ptr<AnyStepper<Dof>> stepper_;
  long long k_ = 0;
  std::array<State, 2> pair_;
};

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

/// The matrices of Ramps with a load such that the motion is u_i = sin(1.3 t + i): no method that is
/// exact for a line is exact for it.
template <int Dof>
struct Waves {
  Ramps<Dof> matrices;
  model::SmoothSystem<Dof> system;

  Waves(Eigen::Index size, double damping) : matrices(size, damping), system(matrices.system) {
    system.add_load = [this](double t, std::span<double> f) {
      const auto x = exact(t);
      Eigen::Map<Eigen::VectorXd>(f.data(), Eigen::Index(f.size())) +=
          system.damping * x.v + (system.stiffness - rate * rate * system.mass) * x.u;
    };
  }
  Waves(const Waves&) = delete;

  model::State<Dof> exact(double t) const {
    model::State<Dof> x{t, model::Vector<Dof>(matrices.n), model::Vector<Dof>(matrices.n)};
    for (Eigen::Index i = 0; i < matrices.n; ++i) {
      x.u[i] = std::sin(rate * t + double(i));
      x.v[i] = rate * std::cos(rate * t + double(i));
    }
    return x;
  }

 private:
  static constexpr double rate = 1.3;
};

struct Errors {
  double u = 0.0, v = 0.0;
};

/// Root mean square errors for 3.5 <= t <= 6 of a run that starts on the exact solution at t = 1:
/// not at one time, at which an error may pass through 0.
template <int Dof, class Problem>
Errors errors(const std::string& specification, const Problem& problem, double h) {
  const auto steps = std::lround(5.0 / h);
  model::State<Dof> now = problem.exact(1.0);
  SingleSteps<Dof> stepper(specification, problem.system, 5.0 / double(steps), now);
  Errors sum;
  for (long i = 1; i <= steps; ++i) {
    stepper.step(now);
    if (2 * i < steps) continue;
    const auto reference = problem.exact(now.t);
    sum.u += (now.u - reference.u).squaredNorm();
    sum.v += (now.v - reference.v).squaredNorm();
  }
  EXPECT_FALSE(stepper->failed());
  EXPECT_NEAR(now.t, 6.0, 1e-14);
  return {std::sqrt(2.0 * sum.u / double(steps)), std::sqrt(2.0 * sum.v / double(steps))};
}

/// Order of the last levels above the floor of rounding: the step is halved from `coarsest` until the
/// error is below the floor or the step below `finest`, and a line is laid through three levels, the
/// finest three that lie on one, or else the last three.
inline Fit asymptotic_order(const std::function<double(double)>& error, double coarsest,
                            double finest, double floor) {
  std::vector<double> errors;
  for (double h = coarsest; h >= finest; h *= 0.5) {
    errors.push_back(error(h));
    if (errors.size() > 3 && !(errors.back() > floor)) {
      errors.pop_back();
      break;
    }
  }
  const auto fit = [&](std::size_t begin) {
    return observed_order(
        [&](double step) { return errors[begin + std::size_t(std::lround(-std::log2(step)))]; },
        1.0, 3);
  };
  for (std::size_t begin = errors.size() - 3; begin > 0; --begin)
    if (const Fit found = fit(begin); found.scatter < 1.02) return found;
  return fit(errors.size() - 3);
}

/// First order is reached late: the error of second order is larger until h is small.
inline double finest(double order) { return order < 1.5 ? 1.0 / 2048 : 1.0 / 512; }

template <int Dof, class Problem>
void expect_order(const std::string& specification, const Problem& problem) {
  const double order = integrator(specification)->facts().smooth_order;
  std::vector<Errors> levels;
  const auto at = [&](double h) {
    const auto i = std::size_t(std::lround(std::log2(0.125 / h)));
    while (levels.size() <= i)
      levels.push_back(errors<Dof>(specification, problem, std::ldexp(0.125, -int(levels.size()))));
    return levels[i];
  };
  // Rounding leaves some 1e-14, and that over h where velocities are differences. Above it orders of
  // five and six are seen at steps that still show the next term.
  const auto u = asymptotic_order([&](double h) { return at(h).u; }, 0.125, finest(order), 1e-12);
  const auto v = asymptotic_order([&](double h) { return at(h).v; }, 0.125, finest(order), 1e-12);
  const double tolerance = order > 4.5 ? 0.05 * order : 0.05;
  EXPECT_NEAR(u.order, order, tolerance) << "u, scatter " << u.scatter;
  EXPECT_NEAR(v.order, order, tolerance) << "v, scatter " << v.scatter;
}

template <template <int> class Problem>
void expect_orders(const std::string& specification) {
  for (const double c : {0.0, 0.3}) {
    SCOPED_TRACE(testing::Message() << "c = " << c);
    expect_order<1>(specification, Problem<1>(1, c));
    expect_order<2>(specification, Problem<2>(2, c));
    expect_order<model::any_dof>(specification, Problem<model::any_dof>(3, c));
  }
}

/// Methods for linear motion alone are those that may be exact under a load that is a line.
inline bool may_be_exact_for_ramps(const std::string& specification) {
  return integrator(specification)->facts().is_linear_only;
}

inline void converges_at_the_order_it_claims(const std::string& specification) {
  if (may_be_exact_for_ramps(specification))
    expect_orders<Waves>(specification);
  else
    expect_orders<Ramps>(specification);
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

inline void converges_at_the_same_order_with_a_nonlinear_force(const std::string& specification) {
  expect_order<1>(specification, Cubic<1>(1));
  expect_order<model::any_dof>(specification, Cubic<model::any_dof>(3));
}

/// An undamped free mass of unit frequency.
inline model::SmoothSystem<1> oscillator() {
  using Number = model::Matrix<1>;
  return {Number(1.0), Number(0.0), Number(1.0)};
}

inline model::State<1> displaced() { return {0.0, model::Vector<1>(1.0), model::Vector<1>(0.0)}; }

/// |u| after many steps of the oscillator from u = 1, v = 0.
inline double growth(const std::string& specification, double h) {
  const auto system = oscillator();
  auto now = displaced();
  SingleSteps<1> stepper(specification, system, h, now);
  for (int i = 0; i < 4000; ++i) stepper.step(now);
  return now.u.norm();
}

/// Its amplitude after as many steps as show an instability that is weak beyond the limit.
inline double amplitude(const std::string& specification, double h) {
  const auto system = oscillator();
  auto now = displaced();
  SingleSteps<1> stepper(specification, system, h, now);
  for (int i = 0; i < 400000; ++i) stepper.step(now);
  return std::hypot(now.u[0], now.v[0]);
}

inline void is_stable_exactly_where_it_claims(const std::string& specification) {
  const auto facts = integrator(specification)->facts();
  const auto grows = [&](double h) { return !(growth(specification, h) < 1e6); };
  const double limit = facts.stability_limit;
  if (facts.is_unconditionally_stable()) {
    for (const double h : {1.0, 10.0, 1e3}) EXPECT_FALSE(grows(h)) << "h = " << h;
  } else if (limit == 0.0) {
    EXPECT_TRUE(grows(1.0));
  } else {
    EXPECT_FALSE(grows(limit * 0.999)) << limit;
    if (grows(limit * 1.002)) return;
    EXPECT_LT(amplitude(specification, 0.9 * limit), 1.0) << limit;
    EXPECT_FALSE(amplitude(specification, 1.1 * limit) < 1.01) << limit;  // or no number
  }
}

/// The spectral radius at omega h = 1e6, from the decay in 50 steps, in up to 1000 where it is slow.
inline void has_its_radius_at_infinity(const std::string& specification) {
  const double radius = integrator(specification)->facts().radius_at_infinity;
  if (std::isnan(radius)) return;
  constexpr double h = 1e6;
  const auto system = oscillator();
  auto now = displaced();
  SingleSteps<1> stepper(specification, system, h, now);
  const auto size_after = [&](int steps) {
    for (int i = 0; i < steps; ++i) stepper.step(now);
    return std::hypot(now.u[0], h * now.v[0]);
  };
  // Two roots on a circle turn; in many steps that does not matter. A defective root grows as n rho^n,
  // which adds a factor (5/4)^(1/50) < 1.005. A radius of 0 at infinity is of order (omega h)^(-1/2).
  const int steps = radius < 0.1 ? 6
                    : radius < 1.0
                        ? std::clamp(static_cast<int>(-20.0 / std::log(radius)), 50, 1000)
                        : 1000;
  const double first = size_after(radius < 0.1 ? 8 : 4 * steps), second = size_after(steps);
  const double measured = first > 0.0 ? std::pow(second / first, 1.0 / steps) : 0.0;
  EXPECT_NEAR(measured, radius, 0.01);
}

inline void takes_a_partial_step_that_leads_to_the_step(const std::string& specification) {
  const Ramps<2> problem(2, 0.3);
  model::State<2> now = problem.exact(1.0);
  SingleSteps<2> stepper(specification, problem.system, 0.1, now);
  const double order = integrator(specification)->facts().smooth_order;
  for (int i = 0; i < 9; ++i) {  // also with a memory that no restart has made
    const model::State<2> part = stepper->partial(now, 0.04), whole = stepper->partial(now, 0.1);
    const auto twin = stepper->partial(now, 0.04);  // looking must not change anything
    EXPECT_EQ(part.u, twin.u);
    EXPECT_NEAR(part.t, now.t + 0.04, 1e-15 * 4);
    stepper.step(now);
    // The same step, or one of the same order.
    const double size = now.u.norm() + now.v.norm();
    EXPECT_LT((now.u - whole.u).norm() + (now.v - whole.v).norm(),
              size * std::pow(0.1, order + 1.0));
    EXPECT_NEAR(now.t, 1.1 + 0.1 * i, 1e-15 * 8);
  }
}

inline void goes_back_into_a_block(const std::string& specification) {
  const Ramps<2> problem(2, 0.3);
  const auto stepper = integrator(specification)->stepper(problem.system, endless(1.0, 0.1));
  std::vector<model::State<2>> block(20, problem.exact(1.0)), again = block;
  stepper->restart(block[0]);
  ASSERT_EQ(stepper->advance(0, block), 19u);
  for (const std::size_t back : {0u, 1u, 12u}) {
    stepper->rewind(0, block, back);
    EXPECT_FALSE(stepper->failed());
    again[0] = block[back];
    ASSERT_EQ(stepper->advance(static_cast<long long>(back), {again.data(), 20 - back}), 19 - back);
    for (std::size_t i = 0; i + back < 20; ++i) {
      EXPECT_EQ(again[i].t, block[back + i].t);
      EXPECT_EQ(again[i].u, block[back + i].u);
      EXPECT_EQ(again[i].v, block[back + i].v);
    }
    stepper->restart(block[0]);
    ASSERT_EQ(stepper->advance(0, block), 19u);
  }
}

void keeps_its_order_when_restarted(const std::string& specification, const auto& problem) {
  const double order = integrator(specification)->facts().smooth_order;
  const auto error = [&](double h) {
    const int steps = int(std::lround(1.25 / h));
    model::State<1> now = problem.exact(1.0);
    SingleSteps<1> stepper(specification, problem.system, 1.25 / steps, now);
    double sum = 0.0;
    for (int i = 1; i <= 4 * steps; ++i) {
      stepper.step(now);
      if (i % steps != 0) continue;
      stepper->restart(now);
      const auto reference = problem.exact(now.t);
      sum += (now.u - reference.u).squaredNorm() + (now.v - reference.v).squaredNorm();
    }
    return std::sqrt(sum);
  };
  const auto fit = asymptotic_order(error, 1.0 / 8, finest(order), 1e-12);
  EXPECT_NEAR(fit.order, order, 0.1 * order) << "scatter " << fit.scatter;
}

/// A run restarted every 1.25 s, as impacts restart it, keeps its order.
inline void keeps_its_order_when_restarted(const std::string& specification) {
  if (may_be_exact_for_ramps(specification))
    keeps_its_order_when_restarted(specification, Waves<1>(1, 0.3));
  else
    keeps_its_order_when_restarted(specification, Ramps<1>(1, 0.3));
}

inline void counts_its_work(const std::string& specification) {
  const Ramps<2> problem(2, 0.3);
  model::State<2> now = problem.exact(1.0);
  SingleSteps<2> stepper(specification, problem.system, 0.1, now);
  const auto work = [&] {
    model::Work sum;
    stepper->add_work(sum);
    return sum;
  };
  for (int i = 0; i < 20; ++i) stepper.step(now);  // past any start
  const auto before = work();
  stepper.step(now);
  const auto step = work();
  for (int i = 0; i < 10; ++i) stepper.step(now);
  const auto after = work();
  EXPECT_GT(step.force_evaluations, before.force_evaluations);
  EXPECT_EQ(after.force_evaluations - step.force_evaluations,
            10 * (step.force_evaluations - before.force_evaluations));
  EXPECT_EQ(after.factorizations, before.factorizations) << "every step factorizes";
  stepper->reset();
  EXPECT_EQ(work().force_evaluations, 0);
}

inline void counts_time_and_does_not_sum_it(const std::string& specification) {
  const auto system = oscillator();
  auto now = displaced();
  now.t = 1.0;
  SingleSteps<1> stepper(specification, system, 0.1, now);
  for (int i = 0; i < 100000; ++i) stepper.step(now);
  EXPECT_EQ(now.t, 1.0 + 100000 * 0.1);
}

}  // namespace clackers::methods::checks
