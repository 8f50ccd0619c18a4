// Located impacts with integrators that choose their steps, and with those that are exact.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/runs.hpp"

namespace clackers::methods {
namespace {

using runs::mass_on_stop;
using runs::RattlingMass;
using runs::Result;

std::vector<std::string> integrators_that(bool (*is_one)(const Facts&)) {
  std::vector<std::string> all;
  for (const auto& entry : entries())
    if (entry.kind == "integrator" && is_one(integrator(entry.name)->facts()))
      all.push_back(entry.name);
  return all;
}

const auto adaptive = integrators_that([](const Facts& facts) { return facts.is_adaptive; });
const auto exact =
    integrators_that([](const Facts& facts) { return facts.exact_under >= ExactUnder::no_load; });

Result run_by(const std::string& name, const model::ImpactProblem<>& problem, double tolerance) {
  model::TrajectorySink sink(true);
  const auto outcome =
      method(name)->prepare(problem, Resolution::by_tolerance(tolerance))->advance(sink);
  return {sink.trajectory(), outcome};
}

double largest_error(const Result& found, const RattlingMass& reference) {
  double worst = 0.0;
  for (std::size_t i = 0; i < found.trajectory.t.size(); ++i)
    worst = std::max(worst, std::abs(found.trajectory.u[i] - reference.u(found.trajectory.t[i])));
  return worst;
}

TEST(EventDriven, IsExactWithAnExactFlow) {
  ASSERT_GE(exact.size(), 2u);
  const RattlingMass reference{.sigma = 0.05, .eta = 0.7, .w = 1.3};
  for (const auto& name : exact)
    for (const double h : {1.1, 0.1, 0.01}) {
      const auto found = runs::run(name, reference.problem(12.0), h);
      ASSERT_EQ(found.trajectory.impacts->size(), 5u) << name;
      EXPECT_LT(largest_error(found, reference), 1e-13) << name << ", h = " << h;
      EXPECT_NEAR(found.trajectory.impacts->back().t, reference.impact_time(5), 1e-13) << name;
    }
}

TEST(EventDriven, LocatesImpactsToTheToleranceOfAnAdaptiveIntegrator) {
  ASSERT_GE(adaptive.size(), 3u);
  for (const double eta : {1.0, 0.7}) {
    const RattlingMass reference{.sigma = 0.05, .eta = eta, .w = 1.3};
    for (const auto& name : adaptive)
      for (const double tolerance : {1e-5, 1e-8, 1e-11}) {
        SCOPED_TRACE(testing::Message() << name << " tolerance " << tolerance << " eta " << eta);
        const auto found = run_by(name, reference.problem(12.0), tolerance);
        ASSERT_TRUE(found.outcome.finished) << found.outcome.detail;
        const auto& path = found.trajectory;
        ASSERT_EQ(path.impacts->size(), 5u);
        EXPECT_LT(largest_error(found, reference), 10.0 * tolerance);
        EXPECT_LT(std::abs(path.impacts->back().t - reference.impact_time(5)), 30.0 * tolerance);
        // The state at an impact is in its report alone.
        EXPECT_EQ(path.t.front(), 1.0);
        EXPECT_EQ(path.t.back(), 12.0);
        EXPECT_TRUE(std::ranges::is_sorted(path.t, std::less_equal<>{}));
        for (const auto& impact : *path.impacts) {
          EXPECT_FALSE(std::ranges::binary_search(path.t, impact.t));
          EXPECT_GE(impact.u[0], 0.0);
          EXPECT_NEAR(impact.v_after[0], -eta * impact.v_before[0], 1e-15);
        }
      }
  }
}

// Steps go on with the length before the impact: nothing begins anew.
TEST(EventDriven, KeepsTheStepOfAnAdaptiveIntegratorThroughImpacts) {
  const RattlingMass reference{.sigma = 0.0, .eta = 1.0, .w = 1.0};
  for (const auto& name : adaptive) {
    const auto found = run_by(name, reference.problem(101.0), 1e-8);
    auto free = reference.problem(101.0);
    free.contacts[0].gap = -10.0;
    const auto without = run_by(name, free, 1e-8);
    const auto impacts = static_cast<double>(found.trajectory.impacts->size());
    EXPECT_NEAR(impacts, 32.0, 0.5);
    EXPECT_NEAR(double(found.outcome.work.steps),
                double(without.outcome.work.steps) + 0.5 * impacts, impacts)
        << name;
  }
}

// Pressed and lifted by -cos t: it is let go at pi/2, though pressed again at the end of a long step.
TEST(EventDriven, FindsAReleaseInsideALongStepOfAnAdaptiveIntegrator) {
  auto problem = mass_on_stop(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * std::numbers::pi);
  problem.system.add_load = [](double t, std::span<double> f) { f[0] -= std::cos(t); };
  for (const auto& name : adaptive) {
    const auto found = run_by(name, problem, 1e-8);
    ASSERT_TRUE(found.outcome.finished) << found.outcome.detail;
    // v = 1 - sin t from there on.
    EXPECT_NEAR(found.trajectory.u.back(), 1.5 * std::numbers::pi + 1.0, 1e-6) << name;
  }
}

// Two masses that are together for T_c, apart for pi, and land with the gap's rate 0.
TEST(EventDriven, LandsSoftlyWithAnAdaptiveIntegrator) {
  using Matrix = Eigen::MatrixXd;
  model::ImpactProblem<> problem;
  problem.system = {Matrix::Identity(2, 2), Matrix::Zero(2, 2), Matrix::Zero(2, 2)};
  problem.system.stiffness.diagonal() << 9.0, 1.0;
  problem.contacts = {model::contact_between(2, 0, 1, 0.0)};
  problem.start = {0.0, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Ones(2)};
  const double together = std::numbers::pi / std::sqrt(5.0);
  problem.end = 3.0 * together + 2.0 * std::numbers::pi;
  for (const auto& name : adaptive) {
    const auto found = run_by(name, problem, 1e-9);
    ASSERT_TRUE(found.outcome.finished) << name << ": " << found.outcome.detail;
    const auto n = found.trajectory.v.size();
    EXPECT_NEAR(found.trajectory.v[n - 2], -1.0, 1e-5) << name;
    EXPECT_NEAR(found.trajectory.v[n - 1], -1.0, 1e-5) << name;
  }
}

// A ball on a floor under gravity: its bounces accumulate.
TEST(EventDriven, ComesToRestWithAnAdaptiveIntegrator) {
  auto problem = mass_on_stop(1.0, 0.0, 0.0, 1.0, 0.0, 0.5, 10.0);
  problem.system.add_load = [](double, std::span<double> f) { f[0] -= 1.0; };
  for (const auto& name : adaptive) {
    const auto found = run_by(name, problem, 1e-8);
    ASSERT_TRUE(found.outcome.finished) << found.outcome.detail;
    EXPECT_NEAR(found.trajectory.u.back(), 0.0, 1e-13);
    // sqrt 2 (1 + 2 (1/2 + 1/4 + ...))
    EXPECT_NEAR(found.trajectory.impacts->back().t, 3.0 * std::numbers::sqrt2, 1e-6);
  }
}

// It stays on the floor with eta = 0, until the load lifts it at t = 5.
TEST(EventDriven, RestsAndIsReleasedWithAnAdaptiveIntegrator) {
  auto problem = mass_on_stop(1.0, 0.0, 0.0, 0.5, 0.0, 0.0, 8.0);
  problem.system.add_load = [](double t, std::span<double> f) { f[0] += 0.2 * (t - 5.0); };
  for (const auto& name : adaptive) {
    const auto found = run_by(name, problem, 1e-9);
    ASSERT_TRUE(found.outcome.finished) << found.outcome.detail;
    const auto& path = found.trajectory;
    EXPECT_EQ(path.impacts->size(), 1u);
    for (std::size_t i = 0; i < path.t.size(); ++i) {
      const double flight = std::max(0.0, path.t[i] - 5.0);
      if (path.t[i] > 2.0) {
        EXPECT_NEAR(path.u[i], std::pow(flight, 3) / 30.0, 1e-8) << name;
      }
    }
  }
}

TEST(Reversal, DoesNotTakeAdaptiveIntegrators) {
  const auto problem = mass_on_stop(1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 8.0);
  EXPECT_REFUSED(
      method("dopri5+reversal")->prepare(problem, Resolution::by_tolerance(1e-6)),
      "integrator-not-taken",
      "dopri5+reversal: reversal errs by the step in which an impact falls, and an adaptive "
      "integrator chooses its steps without regard to impacts. Use event-driven.");
}

TEST(Penalty, DoesNotTakeIntegratorsOfLinearMotion) {
  const auto problem = mass_on_stop(1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 8.0);
  EXPECT_REFUSED(method("exponential+penalty")->prepare(problem, 0.1), "linear-only",
                 "exponential+penalty: the force of a compliant contact is nonlinear");
  auto nonlinear = problem;
  struct Force : model::NonlinearForce<model::any_dof> {
    using V = model::Vector<model::any_dof>;
    using M = model::Matrix<model::any_dof>;
    void add(const V&, const V&, V&) const override {}
    void add_tangent(const V&, const V&, M&, M&) const override {}
  };
  nonlinear.system.nonlinear = std::make_shared<Force>();
  EXPECT_REFUSED(method("exponential")->prepare(nonlinear, 0.1), "linear-only",
                 "exponential+event-driven: the problem has a nonlinear force");
}

}  // namespace
}  // namespace clackers::methods
