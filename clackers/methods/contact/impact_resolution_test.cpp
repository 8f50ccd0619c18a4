#include "clackers/methods/contact/impact_resolution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

using runs::run;

// Three masses above each other on springs of their own, the middle one three times as fast as the
// others. Every pi they meet at their equilibrium, all at once, with opposite momenta, and part as they
// did after the impact before: u_i = V_i sin(q_i t)/q_i in [0, pi).
struct Row {
  Eigen::Array3d m{1.0, 1.0, 1.5}, q{1.0, 3.0, 1.0}, v{1.0, 0.5, -1.0};

  Eigen::Array3d u(double t) const {
    const double flight = std::fmod(t, std::numbers::pi);
    return v * (q * flight).sin() / q;
  }
  model::ImpactProblem<> problem(double end) const {
    model::ImpactProblem<> p;
    p.system.mass = m.matrix().asDiagonal();
    p.system.damping = Eigen::Matrix3d::Zero();
    p.system.stiffness = (m * q * q).matrix().asDiagonal();
    p.contacts = {model::contact_between(3, 0, 1), model::contact_between(3, 1, 2)};
    p.start = {0.5, u(0.5).matrix(), (v * (0.5 * q).cos()).matrix()};
    p.end = end;
    return p;
  }
};

double worst_error(const std::string& name, double h) {
  const Row row;
  const auto [path, outcome] = run(name, row.problem(9.0), h);
  EXPECT_TRUE(outcome.finished) << name << ' ' << outcome.detail;
  double worst = 0.0;
  for (std::size_t i = 0; i < path.t.size(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      worst = std::max(worst, std::abs(path.u[3 * i + std::size_t(k)] - row.u(path.t[i])[k]));
  return worst;
}

// Of a leading error in u at the impact, in v at other phases alone, of multistep methods that start
// with another one, and with damping.
TEST(ImpactResolution, SimultaneousImpactsKeepTheOrder) {
  for (const std::string name : {"newmark", "wilson-theta", "dissipative-newmark", "houbolt",
                                 "bdf4", "rk4", "velocity-verlet"}) {
    const double order = method(name)->facts().smooth_order;
    const auto fit = checks::asymptotic_order(
        [&](double h) { return worst_error(name, 8.5 / std::round(8.5 / h)); }, 1.0 / 16,
        1.0 / (order > 1.0 ? 512 : 4096), 1e-11);
    EXPECT_NEAR(fit.order, order, 0.1 * order) << name;
  }
}

TEST(ImpactResolution, SimultaneousImpactsKeepTheToleranceOfAdaptiveIntegrators) {
  for (const std::string name : {"dopri5", "tsit5", "dop853"})
    EXPECT_LT(worst_error(name, 0.1), 1e-6) << name;
}

// Rounding is all that closes the contacts apart.
TEST(ImpactResolution, SimultaneousImpactsAreExactWhereFlightsAre) {
  for (const double h : {0.1, 0.01, 0.0007}) EXPECT_LT(worst_error("exponential", h), 1e-10) << h;
}

// Free flight is exact to rounding, so that 1e-9 s tell a sequence of impacts from one.
TEST(ImpactResolution, ImpactsThatARunCanTellApartStayApart) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector3d(1.0, 2.0, 1.0).asDiagonal();
  p.system.damping = p.system.stiffness = Eigen::Matrix3d::Zero();
  p.contacts = {model::contact_between(3, 0, 1), model::contact_between(3, 1, 2)};
  p.end = 1.1;
  for (const std::string name : {"newmark", "rk4", "bdf4"})
    for (const double late : {0.0, 1e-9}) {
      p.start = {0.0, Eigen::Vector3d(1.0, 0.0, -1.0 - late), Eigen::Vector3d(-1.0, 0.0, 1.0)};
      const auto [path, outcome] = run(name, p, 0.07);
      ASSERT_TRUE(outcome.finished) << outcome.detail;
      const auto* v = &path.v[path.v.size() - 3];
      // At once they part as they met; one by one mass 2, pushed down by mass 1, meets mass 3 with
      // -2/3 and leaves it with 4/9, and catches mass 1, which has 1/3.
      EXPECT_NEAR(v[0], late > 0.0 ? 13.0 / 27 : 1.0, 1e-12) << name;
      EXPECT_NEAR(v[1], late > 0.0 ? 10.0 / 27 : 0.0, 1e-12) << name;
      EXPECT_NEAR(v[2], late > 0.0 ? -11.0 / 9 : -1.0, 1e-12) << name;
    }
}

// The gap of the lower contact is wider by what it closes in 1e-3 s, or in 0.75e-3 s once the upper one
// has pushed its mass.
TEST(ImpactResolution, SmallStepsTellApartWhatLargeStepsCannot) {
  auto p = Row().problem(4.0);
  p.contacts[1].gap = -1.5e-3;
  const auto apart = [&](double h) {
    const auto path = run("newmark", p, h).trajectory;
    return path.impacts->at(1).t - path.impacts->at(0).t;
  };
  EXPECT_EQ(apart(0.1), 0.0);
  EXPECT_NEAR(apart(1e-3), 0.75e-3, 1e-5);
}

// Its errors add up to 0.6 s, ten times that is a whole flight.
TEST(ImpactResolution, ImpactsThatAreAStepApartStayApart) {
  auto p = Row().problem(4.0);
  p.contacts[1].gap = -0.6;
  const auto path = run("bdf1", p, 0.1).trajectory;
  EXPECT_GT(path.impacts->at(1).t - path.impacts->at(0).t, 0.1);
}

// Two contacts of one direction: their impulses would not be unique.
TEST(ImpactResolution, DependentContactsStayApart) {
  auto p = Row().problem(9.0);
  p.contacts.push_back(p.contacts[0]);
  p.contacts[2].gap = -1e-7;
  const auto [path, outcome] = run("newmark", p, 0.01);
  EXPECT_TRUE(outcome.finished) << outcome.detail;
  EXPECT_EQ(path.impacts->size(), 4u);
}

}  // namespace
}  // namespace clackers::methods
