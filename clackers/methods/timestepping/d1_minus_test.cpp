#include <gtest/gtest.h>

#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

using runs::mass_on_stop;
using runs::RattlingMass;
using runs::run;

TEST(D1Minus, StepsByItsFormula) {
  for (const bool is_nonlinear : {false, true}) {
    auto p = RattlingMass{.sigma = 0.2, .eta = 0.6, .w = 1.3}.problem(11.0);
    p.system.add_load = [](double t, std::span<double> f) { f[0] += std::sin(t); };
    if (is_nonlinear) p.system.nonlinear = std::make_shared<checks::CubicForce<model::any_dof>>();
    const double h = 0.125, m = p.system.mass(0, 0), c = p.system.damping(0, 0),
                 k = p.system.stiffness(0, 0);
    const auto a = [&](double t, double u, double v) {
      const double p_uv = is_nonlinear ? u * u * u + 0.2 * u * u * v : 0.0;
      return (std::sin(t) - c * v - k * u - p_uv) / m;
    };
    const auto path = run("d1-minus", p, h).trajectory;
    std::size_t impacts = 0;
    for (std::size_t n = 0; n + 1 < path.t.size(); ++n) {
      const double u0 = path.u[n], v0 = path.v[n], u1 = path.u[n + 1], v1 = path.v[n + 1];
      const double a0 = a(path.t[n], u0, v0), v = v0 + h * a0;
      EXPECT_NEAR(u1, u0 + h / 2 * (v0 + v), 1e-14);
      const double before = v0 + h / 2 * (a0 + a(path.t[n + 1], u1, v));
      if (u1 > 0.0 || before > 0.0) {
        EXPECT_NEAR(v1, before, 1e-13);
        continue;
      }
      EXPECT_NEAR(v1, -0.6 * before, 1e-13);
      const auto& reported = path.impacts->at(impacts++);
      EXPECT_NEAR(reported.impulse, m * (v1 - before), 1e-13);
      EXPECT_NEAR(reported.v_before[0], before, 1e-13);
      EXPECT_EQ(reported.t, path.t[n + 1]);
    }
    EXPECT_EQ(impacts, path.impacts->size());
    EXPECT_GE(impacts, 3u);
  }
}

// One impact, then rest under a load, then a flight: forces of a closed contact are no impacts.
TEST(D1Minus, AClosedContactIsKeptByForces) {
  auto p = mass_on_stop(1.0, 0.0, 0.0, 0.5, -1.0, 0.0, 6.0);
  p.system.add_load = [](double t, std::span<double> f) { f[0] += t - 3.0; };
  const double h = 1.0 / 64;
  const auto path = run("d1-minus", p, h).trajectory;
  EXPECT_EQ(path.impacts->size(), 1u);
  const double depth = path.u[std::size_t(2.0 / h)];
  EXPECT_LE(depth, 0.0);
  EXPECT_GT(depth, -2.0 * h);
  for (std::size_t k = 0; k < path.t.size(); ++k)
    if (path.t[k] > 1.0 && path.t[k] <= 3.0) {
      EXPECT_EQ(path.u[k], depth);
      EXPECT_NEAR(path.v[k], 0.0, 1e-15);
    }
  // u'' = t - 3
  EXPECT_NEAR(path.u.back() - depth, 4.5, 0.01);
  EXPECT_NEAR(path.v.back(), 4.5, 0.01);
}

// A load that lifts the mass at the start of the step and pulls it back at its end.
TEST(D1Minus, AContactThatOpensInTheStepHasNoForceAtItsEnd) {
  auto p = mass_on_stop(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1);
  p.system.add_load = [](double t, std::span<double> f) { f[0] += 1.0 - 110.0 * t; };
  const auto path = run("d1-minus", p, 0.1).trajectory;
  EXPECT_NEAR(path.u.back(), 0.005, 1e-15);
  EXPECT_NEAR(path.v.back(), 0.05 * (1.0 - 10.0), 1e-15);
  EXPECT_TRUE(path.impacts->empty());
}

}  // namespace
}  // namespace clackers::methods
