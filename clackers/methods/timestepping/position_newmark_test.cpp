// Newmark's method with a multiplier or an augmented Lagrangian for the gap: the warning, in numbers.

#include "clackers/methods/timestepping/position_newmark.hpp"

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/runs.hpp"

namespace clackers::methods {
namespace {

using runs::mass_on_stop;
using runs::run;

const std::vector<std::string> both{"newmark-position-multiplier", "augmented-lagrangian"};

// A mass meets a stop in flight with velocity -1, a part x of a step above it at the last free
// instant. It leaves with 3 - 4 x, after a second step in contact with 8 x - 5 for x > 2/3.
TEST(PositionNewmark, ReboundsByThePositionOfTheImpactInItsStep) {
  for (const auto& name : both)
    for (const double h : {0.1, 0.01})
      for (const double x : {0.01, 0.25, 0.5, 0.65, 0.68, 0.8, 0.99}) {
        auto p = mass_on_stop(2.0, 0.0, 0.0, (3.0 + x) * h, -1.0, 1.0, 10.0 * h);
        const auto path = run(name, p, h).trajectory;
        const double rebound = x < 2.0 / 3 ? 3.0 - 4.0 * x : 8.0 * x - 5.0;
        EXPECT_NEAR(path.v.back(), rebound, 1e-9) << name << " at " << x;
        double impulse = 0.0;
        for (const auto& impact : *path.impacts) impulse += impact.impulse;
        EXPECT_GT(impulse, 0.0);
        for (const double u : path.u) EXPECT_GE(u, -1.1e-12);
      }
}

// A contact force at the end of the step alone: it leaves with 1 - 2 x, after a second step in contact
// with 2 x - 1.
TEST(NewmarkImplicitContact, ReboundsByThePositionOfTheImpactInItsStep) {
  for (const double h : {0.1, 0.01})
    for (const double x : {0.01, 0.25, 0.49, 0.51, 0.8, 0.99}) {
      auto p = mass_on_stop(2.0, 0.0, 0.0, (4.0 - x) * h, -1.0, 1.0, 10.0 * h);
      const auto path = run("newmark-implicit-contact", p, h).trajectory;
      EXPECT_NEAR(path.v.back(), std::abs(1.0 - 2.0 * x), 1e-9) << x;
      for (const double u : path.u) EXPECT_GE(u, -1.1e-12);
    }
}

TEST(NewmarkImplicitContact, StepsByItsFormula) {
  auto p = mass_on_stop(2.0, 0.4, 3.0, 1.0, 0.5, 1.0, 3.0);
  p.system.add_load = [](double t, std::span<double> f) { f[0] += std::sin(t); };
  const double h = 0.1;
  const auto path = run("newmark-implicit-contact", p, h).trajectory;
  double a0 = (-0.4 * 0.5 - 3.0 * 1.0) / 2.0, force = 0.0;
  for (std::size_t n = 0; n + 1 < path.t.size(); ++n) {
    const double v0 = path.v[n], u1 = path.u[n + 1], v1 = path.v[n + 1];
    EXPECT_NEAR(u1, path.u[n] + h / 2 * (v0 + v1), 1e-13);
    const double a1 = (std::sin(path.t[n + 1]) - 0.4 * v1 - 3.0 * u1) / 2.0;
    const double contact = 2.0 * (v1 - v0 - h / 2 * (a0 + a1)) / h;
    EXPECT_NEAR(std::min(u1, contact), 0.0, 1e-10);
    force += contact;
    a0 = a1;
  }
  EXPECT_GT(force, 1.0);
}

TEST(PositionNewmark, StepsByItsFormula) {
  auto p = mass_on_stop(2.0, 0.4, 3.0, 1.0, 0.5, 1.0, 3.0);
  p.system.add_load = [](double t, std::span<double> f) { f[0] += std::sin(t); };
  const double h = 0.1;
  for (const auto& name : both) {
    const auto path = run(name, p, h).trajectory;
    double a0 = (-0.4 * 0.5 - 3.0 * 1.0) / 2.0, force = 0.0;
    for (std::size_t n = 0; n + 1 < path.t.size(); ++n) {
      const double v0 = path.v[n], u1 = path.u[n + 1], v1 = path.v[n + 1];
      EXPECT_NEAR(u1, path.u[n] + h / 2 * (v0 + v1), 1e-13);
      const double a1 = 2.0 / h * (v1 - v0) - a0;
      const double contact = 2.0 * a1 + 0.4 * v1 + 3.0 * u1 - std::sin(path.t[n + 1]);
      EXPECT_NEAR(std::min(u1, contact), 0.0, 1e-10);
      force += contact;
      a0 = a1;
    }
    EXPECT_GT(force, 1.0);
  }
}

TEST(AugmentedLagrangian, FactorOneIsAtItsLimitAtOnceAndOthersLater) {
  const auto p = mass_on_stop(2.0, 0.0, 0.0, 0.35, -1.0, 1.0, 1.0);
  const auto evaluations = [&](const std::string& name) {
    const auto [path, outcome] = run(name, p, 0.1);
    EXPECT_TRUE(outcome.finished);
    EXPECT_NEAR(path.v.back(), 1.0, name.ends_with("1e-3") ? 0.1 : 1e-9);
    return outcome.work.force_evaluations;
  };
  EXPECT_LE(evaluations("augmented-lagrangian"), 11 + 2);
  EXPECT_GT(evaluations("augmented-lagrangian:factor=0.5"), 11 + 20);
  EXPECT_LT(evaluations("augmented-lagrangian:factor=0.5,tolerance=1e-3"),
            evaluations("augmented-lagrangian:factor=0.5"));
  EXPECT_GT(evaluations("augmented-lagrangian:factor=1.5"), 11 + 20);
}

TEST(AugmentedLagrangian, AnIterationWithoutEndEndsTheRun) {
  const auto p = mass_on_stop(2.0, 0.0, 0.0, 0.35, -1.0, 1.0, 1.0);
  const auto outcome = run("augmented-lagrangian:factor=1.999", p, 0.1).outcome;
  EXPECT_FALSE(outcome.finished);
  EXPECT_EQ(outcome.reason, Code("complementarity-failed"));
  EXPECT_NE(outcome.detail.find("t = 0.4 s"), std::string::npos) << outcome.detail;
}

TEST(AugmentedLagrangian, RefusesParametersOutsideTheirRange) {
  for (const auto* factor : {"0", "2"})
    EXPECT_REFUSED(method(std::string("augmented-lagrangian:factor=") + factor), "out-of-range",
                   "0 < factor < 2");
  for (const auto* tolerance : {"0", "-1"})
    EXPECT_REFUSED(method(std::string("augmented-lagrangian:tolerance=") + tolerance),
                   "out-of-range", "tolerance");
}

TEST(PositionNewmark, TakesEtaOneAlone) {
  for (const auto& name : both)
    for (const double eta : {0.7, 0.0})
      EXPECT_REFUSED(method(name)->prepare(mass_on_stop(2.0, 0.0, 1.0, 1.0, 0.0, eta, 2.0), 0.1),
                     "law-needs-restitution", name, "no law of restitution");
}

}  // namespace
}  // namespace clackers::methods
