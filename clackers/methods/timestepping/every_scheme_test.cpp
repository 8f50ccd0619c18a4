// The facts of every method that steps on its own, measured in smooth motion.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

using checks::asymptotic_order;
using checks::Errors;
using checks::finest;
using runs::run;

std::vector<std::string> schemes() {
  std::vector<std::string> all{
      "nonsmooth-generalized-alpha:rho=0", "nonsmooth-generalized-alpha:rho=1",
      "nonsmooth-generalized-alpha:rho=0.3", "moreau-jean:theta=0.75", "moreau-jean:theta=1"};
  for (const auto& entry : entries()) {
    if (entry.kind != "method") continue;
    const auto facts = method(entry.name)->facts();
    if (!facts.is_adaptive && facts.through_impacts.behaviour != Behaviour::exact)
      all.push_back(entry.name);
  }
  return all;
}

class EveryScheme : public testing::TestWithParam<std::string> {
 protected:
  std::string name = GetParam();
  Facts facts = method(name)->facts();
};

// Root mean square errors of a run from t = 1 on the exact motion, for 3.5 <= t <= 6.
Errors errors(const std::string& name, const auto& exact, double h) {
  const auto steps = std::lround(5.0 / h);
  model::ImpactProblem<> p{exact.system, {}, exact.exact(1.0), 6.0};
  const auto [path, outcome] = run(name, p, 5.0 / double(steps));
  EXPECT_TRUE(outcome.finished) << outcome.detail;
  Errors sum;
  const auto n = std::size_t(exact.n);
  for (std::size_t k = path.t.size() / 2; k < path.t.size(); ++k) {
    const auto reference = exact.exact(path.t[k]);
    for (std::size_t i = 0; i < n; ++i) {
      sum.u += std::pow(path.u[k * n + i] - reference.u[Eigen::Index(i)], 2);
      sum.v += std::pow(path.v[k * n + i] - reference.v[Eigen::Index(i)], 2);
    }
  }
  return {std::sqrt(2.0 * sum.u / double(steps)), std::sqrt(2.0 * sum.v / double(steps))};
}

void expect_order(const std::string& name, const auto& exact) {
  const double order = method(name)->facts().smooth_order;
  const auto u = asymptotic_order([&](double h) { return errors(name, exact, h).u; }, 0.125,
                                  finest(order), 1e-12);
  const auto v = asymptotic_order([&](double h) { return errors(name, exact, h).v; }, 0.125,
                                  finest(order), 1e-12);
  EXPECT_NEAR(u.order, order, 0.05) << "u, scatter " << u.scatter;
  EXPECT_NEAR(v.order, order, 0.05) << "v, scatter " << v.scatter;
}

TEST_P(EveryScheme, HasTheSmoothOrderItClaims) {
  for (const double c : {0.0, 0.3})
    for (const int n : {1, 2, 3}) expect_order(name, checks::Ramps<model::any_dof>(n, c));
}

TEST_P(EveryScheme, HasTheSameOrderWithANonlinearForce) {
  const checks::Cubic<model::any_dof> exact(2);
  model::ImpactProblem<> p{exact.system, {}, exact.exact(1.0), 6.0};
  if (const auto no = method(name)->objection(p))
    EXPECT_EQ(no->code, Code("linear-only"));
  else
    expect_order(name, exact);
}

// u'' + u = 0 from (1, 0).
model::Trajectory free_run(const std::string& name, double h, int steps) {
  using Number = Eigen::MatrixXd;
  model::ImpactProblem<> p;
  p.system = {Number::Ones(1, 1), Number::Zero(1, 1), Number::Ones(1, 1)};
  p.start = {0.0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1)};
  p.end = steps * h;
  return run(name, p, h).trajectory;
}

std::pair<double, double> after(const std::string& name, double h, int steps) {
  const auto path = free_run(name, h, steps);
  return {path.u.back(), path.v.back()};
}

TEST_P(EveryScheme, IsStableExactlyWhereItClaims) {
  const auto grows = [&](double h) { return !(std::abs(after(name, h, 4000).first) < 1e6); };
  if (facts.is_unconditionally_stable()) {
    for (const double h : {1.0, 10.0, 1e3}) EXPECT_FALSE(grows(h)) << "h = " << h;
    return;
  }
  EXPECT_FALSE(grows(facts.stability_limit * 0.999));
  EXPECT_TRUE(grows(facts.stability_limit * 1.002));
}

// From the decay at omega h = 1e6. A double eigenvalue adds a factor of some n / (n - 1).
TEST_P(EveryScheme, HasItsRadiusAtInfinity) {
  const double radius = facts.radius_at_infinity;
  if (std::isnan(radius)) return;
  constexpr double h = 1e6;
  const auto size_after = [&](int steps) {
    const auto [u, v] = after(name, h, steps);
    return std::hypot(u, h * v);
  };
  const auto [first, more] = radius < 0.1 ? std::pair(8, 6) : std::pair(200, 50);
  const double before = size_after(first);
  const double measured =
      before > 0.0 ? std::pow(size_after(first + more) / before, 1.0 / more) : 0.0;
  EXPECT_NEAR(measured, radius, 0.011);
}

// The largest energies of the first and of the last period of a run; within one the energy of a scheme
// with an energy of its own swings.
TEST_P(EveryScheme, LosesEnergyOfAFreeMotionOnlyWhereItDissipates) {
  const auto path = free_run(name, 0.1, 20000);
  const auto largest = [&](std::size_t begin) {
    double most = 0.0;
    for (std::size_t k = begin; k < begin + 63; ++k)
      most = std::max(most, path.u[k] * path.u[k] + path.v[k] * path.v[k]);
    return most;
  };
  const bool dissipates = facts.smooth_order < 2.0 || facts.radius_at_infinity < 1.0;
  const double ratio = largest(path.t.size() - 63) / largest(0);
  if (dissipates)
    EXPECT_LT(ratio, 0.999);
  else
    EXPECT_NEAR(ratio, 1.0, 1e-5);
}

std::string scheme_test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryScheme, testing::ValuesIn(schemes()), scheme_test_name);

}  // namespace
}  // namespace clackers::methods
