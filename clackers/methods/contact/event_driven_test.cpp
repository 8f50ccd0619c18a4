#include <Eigen/LU>
#include <algorithm>
#include <functional>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

using runs::mass_on_stop;
using runs::RattlingMass;
using runs::run;

// Every registered one with a fixed step, and two with parameters that matter here; see
// other_integrators_test.cpp for the others.
const std::vector<std::string> integrators = [] {
  std::vector<std::string> all{"generalized-alpha:rho=0.8", "generalized-alpha:rho=0"};
  for (const auto& entry : entries()) {
    if (entry.kind != "integrator") continue;
    const auto facts = integrator(entry.name)->facts();
    if (!facts.is_adaptive && facts.exact_under < ExactUnder::no_load) all.push_back(entry.name);
  }
  return all;
}();

// A mass thrown up under unit gravity, its floor at u = 0.
model::ImpactProblem<> ball(double u, double v, double eta, double end) {
  auto p = mass_on_stop(1.0, 0.0, 0.0, u, v, eta, end);
  p.system.add_load = [](double, std::span<double> f) { f[0] -= 1.0; };
  return p;
}

TEST(EventDriven, KeepsTheOrderOfTheIntegratorThroughImpacts) {
  for (const double eta : {1.0, 0.7})
    for (const auto& name : integrators) {
      const RattlingMass reference{.sigma = 0.05, .eta = eta, .w = 1.3};
      const auto claim = method(name)->facts().through_impacts;
      EXPECT_EQ(claim.behaviour, Behaviour::proper);
      double worst_time = 0.0, finest = 0.0;
      const auto fit = checks::asymptotic_order(
          [&](double h) {
            finest = h;
            const auto n = std::round(11.0 / h);
            const auto [path, outcome] = run(name, reference.problem(12.0), 11.0 / n);
            EXPECT_EQ(path.impacts->size(), 5u);
            double worst = 0.0;
            for (std::size_t i = 0; i < path.t.size(); ++i)
              worst = std::max(worst, std::abs(path.u[i] - reference.u(path.t[i])));
            worst_time = std::abs(path.impacts->back().t - reference.impact_time(5));
            return worst;
          },
          1.0 / 8, 1.0 / (claim.order > 1.0 ? 256 : 4096), 1e-11);
      EXPECT_NEAR(fit.order, claim.order, 0.1 * claim.order) << name << " eta " << eta;
      // Measured with order 2: at most 7.7 h^order, by generalized-alpha:rho=0.
      EXPECT_LT(worst_time, 10.0 * std::pow(finest, std::min(claim.order, 4.0))) << name;
    }
}

// An undamped mass hits its stop every half period. An integrator of order p shifts its frequency
// by at most 0.5 (w h)^p: measured 0.44 for generalized-alpha:rho=0, the others less.
TEST(EventDriven, FindsEveryImpactOnce) {
  const RattlingMass reference{.sigma = 0.0, .eta = 1.0, .w = 1.0};
  for (const auto& name : integrators)
    for (const double n : {997.0, 2000.0, 6283.0}) {
      SCOPED_TRACE(testing::Message() << name << " n = " << n);
      const auto [path, outcome] = run(name, reference.problem(301.0), 300.0 / n);
      const double shift = 0.5 * std::pow(300.0 / n, method(name)->facts().smooth_order);
      ASSERT_TRUE(outcome.finished);
      EXPECT_NEAR(double(path.impacts->size()), 96.0, 0.5 + 96.0 * shift);  // (2 k - 1) pi/2 < 301
      for (std::size_t k = 0; k < path.impacts->size(); ++k) {
        const auto& impact = (*path.impacts)[k];
        EXPECT_LT(impact.v_before[0], 0.0);
        EXPECT_NEAR(impact.v_after[0], -impact.v_before[0], 1e-15 * 4);
        EXPECT_NEAR(impact.impulse, 4.0 * impact.v_after[0], 1e-14);
        EXPECT_GE(impact.u[0], 0.0);
        if (k > 0) {
          EXPECT_NEAR(impact.t - (*path.impacts)[k - 1].t, std::numbers::pi,
                      std::numbers::pi * shift + 1e-12);
        }
      }
      for (const double u : path.u) EXPECT_GE(u, 0.0);
    }
}

// Newmark's method with gamma = 1/2 and RK4 are exact under a constant force, so impacts of a
// bouncing ball are exact to rounding, also several in one step.
TEST(EventDriven, LocatesSeveralImpactsInOneStep) {
  const double eta = 0.5, v0 = 1.0;  // falls from the floor upwards: flights of 2, 1, 1/2, ... s
  for (const std::string name : {"newmark", "rk4", "central-difference"}) {
    const auto [path, outcome] = run(name, ball(0.0, v0, eta, 3.9), 3.9);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    ASSERT_EQ(path.impacts->size(), 5u) << name;
    double t = 0.0, flight = 2.0, v = v0;
    for (const auto& impact : *path.impacts) {
      t += flight;
      EXPECT_NEAR(impact.t, t, 1e-14) << name;
      EXPECT_NEAR(impact.v_before[0], -v, 1e-14);
      v *= eta;
      EXPECT_NEAR(impact.v_after[0], v, 1e-14);
      flight *= eta;
    }
    const double rest = 3.9 - t;
    EXPECT_NEAR(path.u.back(), v * rest - rest * rest / 2, 1e-14);
    EXPECT_NEAR(path.v.back(), v - rest, 1e-14);
    EXPECT_EQ(path.t, (std::vector<double>{0.0, 3.9}));
    EXPECT_EQ(outcome.work.steps, 1);
    EXPECT_EQ(outcome.work.event_searches, 5);
  }
}

// Impacts accumulate at t = 2/(1 - eta); the load lifts the ball at t = 7, u = (t - 7)^3/6. On a floor at
// `height` its rounding ends the flights, at 0 the speed.
TEST(EventDriven, ComesToRestWhereImpactsAccumulateAndIsReleased) {
  for (const double eta : {0.1, 0.5, 0.7})
    for (const double height : {0.0, 2.0})
      for (const std::string name : {"rk4", "newmark", "dopri5"}) {
        SCOPED_TRACE(testing::Message() << name << " eta " << eta << " height " << height);
        auto p = ball(height, 1.0, eta, 9.0);
        p.contacts[0].gap = height;
        p.system.add_load = [](double t, std::span<double> f) { f[0] += t < 7.0 ? -1.0 : t - 7.0; };
        const auto [path, outcome] = run(name, p, 0.1);
        ASSERT_TRUE(outcome.finished) << outcome.detail;
        const double rest = 2.0 / (1.0 - eta);
        // 2^-26 = eta^n, or 1e-15 = eta^2n; the dense output of an adaptive one errs more.
        const double most = 6.0 + std::log(0x1p-30) / std::log(eta);
        EXPECT_GE(path.impacts->size(), 5u);
        EXPECT_LE(double(path.impacts->size()), most);
        EXPECT_NEAR(path.impacts->back().t, rest, 1e-6);
        EXPECT_EQ(path.impacts->back().v_after[0], 0.0);
        for (std::size_t i = 0; i < path.t.size(); ++i) {
          EXPECT_GE(path.u[i], height - 4e-15) << path.t[i];
          if (path.t[i] > rest && path.t[i] < 7.0) {
            EXPECT_NEAR(path.u[i], height, 4e-15) << path.t[i];
            EXPECT_NEAR(path.v[i], 0.0, 1e-15) << path.t[i];
          }
        }
        EXPECT_NEAR(path.u.back(), height + 8.0 / 6.0, name == "newmark" ? 0.02 : 1e-6);
      }
}

// Two balls on each other: the lower one comes to rest on the floor first, the upper one on it.
TEST(EventDriven, ComesToRestOnAMassThatRests) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector2d(1.0, 0.3).asDiagonal();
  p.system.damping = p.system.stiffness = Eigen::Matrix2d::Zero();
  p.system.add_load = [](double, std::span<double> f) {
    f[0] -= 1.0;
    f[1] -= 0.3;
  };
  p.contacts = {{Eigen::Vector2d(1.0, 0.0), 0.0, 0.5}, {Eigen::Vector2d(-1.0, 1.0), 0.1, 0.6}};
  p.start = {0.0, Eigen::Vector2d(1.0, 1.6), Eigen::Vector2d(0.0, 0.2)};
  p.end = 20.0;
  const auto [path, outcome] = run("rk4", p, 0.1);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  EXPECT_NEAR(path.u[path.u.size() - 2], 0.0, 1e-13);
  EXPECT_NEAR(path.u.back(), 0.1, 1e-13);
  EXPECT_NEAR(path.v.back(), 0.0, 1e-13);
  EXPECT_LT(path.impacts->back().t, 15.0);
}

// Elastic impacts do not accumulate, however small, and so do no impacts of a contact that nothing presses.
TEST(EventDriven, DoesNotRestWhereImpactsDoNotAccumulate) {
  auto p = ball(0.0, 1.0, 1.0, 2.5);
  const auto [path, outcome] = run("rk4", p, 0.1);
  EXPECT_EQ(path.impacts->size(), 1u);
  // Mass 2 hits mass 1 hard, then each its wall with less than 2^-26 of that speed.
  auto slow = mass_on_stop(1.0, 0.0, 0.0, 1e-9, -1e-9, 0.5, 10.0);
  slow.contacts.push_back({Eigen::VectorXd::Constant(1, -1.0), -1.0, 1e-9});
  slow.start.u[0] = 0.5;
  slow.start.v[0] = 1.0;
  slow.end = 0.5 + 2.5e9;
  const auto [other, result] = run("rk4", slow, 1e6);
  ASSERT_TRUE(result.finished) << result.detail;
  ASSERT_EQ(other.impacts->size(), 2u);
  EXPECT_NEAR(other.impacts->back().v_after[0], 0.5e-9, 1e-16);
}

// Both ends of the step are open; between them the ball is above a ceiling at `height`.
model::ImpactProblem<> ball_below_ceiling(double height) {
  auto p = ball(0.0, 1.0, 1.0, 1.9);  // its apex is 1/2, at t = 1
  p.contacts[0].direction[0] = -1.0;
  p.contacts[0].gap = -height;
  return p;
}

TEST(EventDriven, FindsAnImpactBetweenTwoOpenEnds) {
  for (const double dip : {0.1, 1e-3, 1e-9}) {
    const auto [path, outcome] = run("rk4", ball_below_ceiling(0.5 - dip), 1.9);
    ASSERT_EQ(path.impacts->size(), 1u) << dip;
    EXPECT_NEAR((*path.impacts)[0].t, 1.0 - std::sqrt(2 * dip), 1e-15 / std::sqrt(dip) + 1e-15);
  }
}

TEST(EventDriven, PassesAGrazeThatDoesNotTouch) {
  for (const double margin : {0.1, 1e-9, 1e-13}) {
    const auto [path, outcome] = run("rk4", ball_below_ceiling(0.5 + margin), 1.9);
    EXPECT_TRUE(outcome.finished);
    EXPECT_TRUE(path.impacts->empty()) << margin;
    EXPECT_NEAR(path.v.back(), -0.9, 1e-15 * 4);
  }
}

// A large step under a load that changes fast: the step map reaches the floor where its velocity is
// upwards. This is grazing, and no impact.
model::ImpactProblem<> grazing(double end, std::function<double(double)> load) {
  auto p = mass_on_stop(1.0, 0.0, 0.0, 1.0, -1.0, 1.0, end);
  p.system.add_load = [load](double t, std::span<double> f) { f[0] += load(t); };
  return p;
}

// Average acceleration, u(s) = 1 - s + s^2/4 [f(0) + f(s)], is positive before s = 3 under this
// load and crosses 0 there with v = 1/3. The flight from there is pulled down again.
TEST(EventDriven, MeetsAnImpactAfterGrazingInTheSameStep) {
  const auto load = [](double t) {
    return t < 2.5 ? std::min(0.5 + 0.1 * t, 0.6) : 0.6 - (2.0 / 0.9 - 1.8) * (t - 2.5);
  };
  const auto [path, outcome] = run("newmark", grazing(10.0, load), 10.0);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_GE(path.impacts->size(), 1u);
  EXPECT_GT(path.impacts->front().t, 3.0);
  EXPECT_LT(path.impacts->front().v_before[0], 0.0);
  EXPECT_GE(path.u.back(), 0.0);
}

TEST(EventDriven, MeetsAContactAgainThatGrazedBeforeAnImpactElsewhere) {
  // The central difference grazes at t = 1. Thrown up from there, the mass comes back from a
  // ceiling at u = 3 within the same step.
  auto p = grazing(3.0, [](double t) { return 10.0 * t; });
  p.contacts.push_back({Eigen::VectorXd::Constant(1, -1.0), -3.0, 1.0});
  const auto [path, outcome] = run("central-difference", p, 3.0);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_GE(path.impacts->size(), 2u);
  EXPECT_EQ((*path.impacts)[0].contact, 1);
  EXPECT_EQ((*path.impacts)[1].contact, 0);
  EXPECT_GE(path.u.back(), 0.0);
  EXPECT_LE(path.u.back(), 3.0);
}

TEST(EventDriven, KeepsTheEnergyOfAnElasticImpact) {
  const RattlingMass reference{.sigma = 0.0, .eta = 1.0, .w = 1.0};
  const auto [path, outcome] = run("newmark", reference.problem(101.0), 0.1);
  for (std::size_t i = 0; i < path.t.size(); ++i)
    // Average acceleration keeps it in flight at whole steps, and 64 impacts of one partial step
    // each likewise; a thousand steps of a few roundings remain.
    EXPECT_NEAR(path.u[i] * path.u[i] + path.v[i] * path.v[i], 1.0, 1e-12);
}

TEST(EventDriven, KeepsTheOutputOnTheGrid) {
  const RattlingMass reference{.sigma = 0.05, .eta = 0.9, .w = 1.0};
  const double h = 11.0 / 230;
  const auto [path, outcome] = run("newmark", reference.problem(12.0), h);
  ASSERT_EQ(path.t.size(), 231u);
  for (std::size_t k = 0; k < 230; ++k) EXPECT_EQ(path.t[k], 1.0 + double(k) * h);
  EXPECT_EQ(path.t.back(), 12.0);
  EXPECT_EQ(outcome.work.steps, 230);
}

TEST(EventDriven, EndsARunThatIsNoWholeNumberOfStepsWithAShorterOne) {
  const RattlingMass reference{.sigma = 0.05, .eta = 0.9, .w = 1.0};
  for (const double end :
       {12.0, 1.0 + 1.5 * std::numbers::pi}) {  // the second: within the impact's step
    const auto [path, outcome] = run("rk4", reference.problem(end), 0.013);
    EXPECT_EQ(path.t.back(), end);
    EXPECT_NEAR(path.u.back(), reference.u(end), 1e-9);
    EXPECT_LT(path.t[path.t.size() - 1] - path.t[path.t.size() - 2], 0.013);
  }
}

TEST(EventDriven, RepeatsARunToTheBit) {
  const auto prepared = method("newmark")->prepare(ball(0.3, 1.0, 0.0, 4.0), 0.1);
  model::TrajectorySink one(true), two(true);
  const auto first = prepared->advance(one), second = prepared->advance(two);
  EXPECT_EQ(one.trajectory().u, two.trajectory().u);
  EXPECT_EQ(one.trajectory().t, two.trajectory().t);
  EXPECT_EQ(first.work.force_evaluations, second.work.force_evaluations);
  EXPECT_EQ(first.work.event_searches, second.work.event_searches);
}

// Resting contact.

TEST(EventDriven, RestsAfterAnImpactThatGivesNothingBack) {
  for (const auto& name : integrators) {
    const auto [path, outcome] = run(name, ball(0.5, 0.0, 0.0, 3.0), 0.07);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_EQ(path.impacts->size(), 1u);
    EXPECT_NEAR(path.u.back(), 0.0, 1e-15);
    EXPECT_EQ(path.v.back(), 0.0);
  }
}

// A mass at rest on its stop, pushed by -cos(t): it is let go at t = pi/2, and then moves as
// u = t - pi/2 + cos(t).
TEST(EventDriven, LetsGoWhereTheContactForceWouldHaveToPull) {
  for (const double eta : {0.0, 1.0})
    for (const std::string name : {"newmark", "rk4", "generalized-alpha:rho=0.8"}) {
      auto p = mass_on_stop(1.0, 0.0, 0.0, 0.0, 0.0, eta, 4.0);
      p.system.add_load = [](double t, std::span<double> f) { f[0] -= std::cos(t); };
      const auto order = method(name)->facts().smooth_order;
      const auto fit = checks::observed_order(
          [&](double h) {
            const auto [path, outcome] = run(name, p, 4.0 / std::round(4.0 / h));
            EXPECT_TRUE(path.impacts->empty());
            return std::abs(path.u.back() - (4.0 - std::numbers::pi / 2 + std::cos(4.0)));
          },
          1.0 / 16, 4);
      EXPECT_NEAR(fit.order, order, 0.1 * order) << name;
    }
}

// Mass 1, pressed down by a unit force, lands on mass 2, which hangs on a spring; the two go on as
// one mass, u'' = -(1 + 5 u2)/3, and never part since the downward force outweighs m1 u''.
TEST(EventDriven, HoldsTwoMassesTogetherAfterAnInelasticImpact) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector2d(1.0, 2.0).asDiagonal();
  p.system.damping = Eigen::Matrix2d::Zero();
  p.system.stiffness = Eigen::Vector2d(0.0, 5.0).asDiagonal();
  p.system.add_load = [](double, std::span<double> f) { f[0] -= 1.0; };
  p.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 0.0}};
  p.start = {0.0, Eigen::Vector2d(0.125, 0.0), Eigen::Vector2d(0.0, 0.0)};
  p.end = 10.0;
  // Impact at t = 1/2 with v1 = -1/2: both leave with -1/6 about the new equilibrium -1/5.
  const double w = std::sqrt(5.0 / 3), t = 9.5;
  const double exact = -0.2 + 0.2 * std::cos(w * t) - 1.0 / 6 / w * std::sin(w * t);
  const auto [path, outcome] = run("rk4", p, 0.01);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_EQ(path.impacts->size(), 1u);
  EXPECT_NEAR((*path.impacts)[0].t, 0.5, 1e-15);
  EXPECT_NEAR(path.u[path.u.size() - 1], exact, 1e-8);  // 1000 steps, (w h)^4 / 120 each period
  EXPECT_NEAR(path.u[path.u.size() - 2], path.u[path.u.size() - 1], 1e-13);
}

// Several contacts.

model::ImpactProblem<> row_of(int n, double end) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::MatrixXd::Identity(n, n);
  p.system.damping = p.system.stiffness = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    b[i] = 1.0;
    b[i + 1] = -1.0;
    p.contacts.push_back({b, 0.0, 1.0});
  }
  p.start = {0.0, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  p.end = end;
  return p;
}

TEST(EventDriven, PassesAnImpactAlongARowOfMasses) {
  auto p = row_of(4, 10.0);
  p.start.u << 6.0, 4.0, 3.0, 1.0;
  p.start.v << -1.0, 0.0, 0.0, 0.0;
  for (const double h : {10.0, 0.1}) {
    const auto [path, outcome] = run("rk4", p, h);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    ASSERT_EQ(path.impacts->size(), 3u);
    const double times[] = {2.0, 3.0, 5.0};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR((*path.impacts)[k].t, times[k], 1e-13);
      EXPECT_EQ((*path.impacts)[k].contact, int(k));
    }
    EXPECT_NEAR(path.v.back(), -1.0, 1e-14);
    EXPECT_NEAR(path.u.back(), 1.0 - 5.0, 1e-13);
  }
}

// Both outer masses reach the middle one at t = 2 and leave it as they came.
TEST(EventDriven, SolvesTwoCoupledImpactsAtOneInstant) {
  auto p = row_of(3, 10.0);
  p.start.u << 2.0, 0.0, -2.0;
  p.start.v << -1.0, 0.0, 1.0;
  const auto [path, outcome] = run("newmark", p, 0.3);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_EQ(path.impacts->size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const auto& impact = path.impacts->at(std::size_t(i));
    EXPECT_EQ(impact.contact, i);
    EXPECT_NEAR(impact.t, 2.0, 1e-14);
    EXPECT_NEAR(impact.impulse, 2.0, 1e-14);
    EXPECT_EQ(impact.v_before, (std::vector<double>{-1.0, 0.0, 1.0}));
    EXPECT_NEAR(impact.v_after[0], 1.0, 1e-14);
  }
  const std::vector<double> end(path.u.end() - 3, path.u.end()), expected{8.0, 0.0, -8.0};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(end[i], expected[i], 1e-13);
}

// Newton's law for three masses that meet at once, by hand: the rates -eta U(-) and the momentum
// are three equations for the velocities.
TEST(EventDriven, KeepsLawAndMomentumWhereThreeMassesMeetAtOnce) {
  const Eigen::Vector3d m(1.0, 0.25, 3.0), v(-2.0, 0.0, 1.0);
  const double eta[] = {0.6, 0.9};
  auto p = row_of(3, 2.0);
  p.system.mass = m.asDiagonal();
  p.start.u << 2.0, 0.0, -1.0;
  p.start.v = v;
  for (std::size_t i = 0; i < 2; ++i) p.contacts[i].restitution = eta[i];
  const auto [path, outcome] = run("rk4", p, 0.3);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_EQ(path.impacts->size(), 2u);
  Eigen::Matrix3d a;
  a << 1, -1, 0, 0, 1, -1, m[0], m[1], m[2];
  const Eigen::Vector3d after =
      a.inverse() * Eigen::Vector3d(-eta[0] * (v[0] - v[1]), -eta[1] * (v[1] - v[2]), m.dot(v));
  for (Eigen::Index i = 0; i < 3; ++i)
    EXPECT_NEAR(path.v[path.v.size() - 3 + std::size_t(i)], after[i], 1e-14);
  EXPECT_NEAR(path.impacts->front().impulse, m[0] * (after[0] - v[0]), 1e-14);
  EXPECT_NEAR(path.impacts->back().impulse, m[2] * (v[2] - after[2]), 1e-14);
}

// Mass 3 strikes mass 2, which touches mass 1 at rest: the momentum is shared, by every method that
// finds the impacts of an instant together, whatever the numbers of the contacts.
TEST(EventDriven, SharesAnImpactWithANeighbourAtRest) {
  auto p = row_of(3, 6.0);
  p.start.u << 0.0, 0.0, -2.0;
  p.start.v << 0.0, 0.0, 1.0;
  for (int numbering = 0; numbering < 2; ++numbering) {
    const auto [path, outcome] = run("rk4", p, 0.3);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_EQ(path.impacts->size(), 2u);
    EXPECT_NEAR(path.v[path.v.size() - 3], 2.0 / 3, 1e-15);
    EXPECT_NEAR(path.v[path.v.size() - 2], 2.0 / 3, 1e-15);
    EXPECT_NEAR(path.v.back(), -1.0 / 3, 1e-15);
    EXPECT_NEAR(path.u[path.u.size() - 3] - path.u[path.u.size() - 2], 0.0, 1e-14);
    std::swap(p.contacts[0], p.contacts[1]);
  }
}

// A row of four masses that is its own mirror image, pressed together by a load: both outer masses
// strike the middle ones, which touch, at one instant.
TEST(EventDriven, DoesNotDependOnTheNumbersOfTheContacts) {
  auto p = row_of(4, 12.0);
  p.system.mass = Eigen::Vector4d(1.0, 2.0, 2.0, 1.0).asDiagonal();
  p.system.stiffness = Eigen::Vector4d(1.0, 3.0, 3.0, 1.0).asDiagonal();
  p.system.damping = 0.02 * p.system.mass;
  p.system.add_load = [](double t, std::span<double> f) {
    f[1] -= 0.3 + 0.1 * std::sin(0.7 * t);
    f[2] += 0.3 + 0.1 * std::sin(0.7 * t);
  };
  p.start.u << 1.0, 0.0, 0.0, -1.0;
  for (const double eta : {1.0, 0.5, 0.0}) {
    for (auto& contact : p.contacts) contact.restitution = eta;
    p.contacts[1].restitution = 0.25;
    const auto contacts = p.contacts;
    const auto [first, outcome] = run("rk4", p, 0.05);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    ASSERT_GE(first.impacts->size(), 3u);
    EXPECT_EQ(first.impacts->at(0).t, first.impacts->at(2).t);
    std::vector<std::size_t> order{0, 1, 2};
    while (std::ranges::next_permutation(order).found) {
      for (std::size_t i = 0; i < 3; ++i) p.contacts[i] = contacts[order[i]];
      const auto path = run("rk4", p, 0.05).trajectory;
      ASSERT_EQ(path.impacts->size(), first.impacts->size());
      ASSERT_EQ(path.u.size(), first.u.size());
      for (std::size_t i = 0; i < path.u.size(); ++i) ASSERT_NEAR(path.u[i], first.u[i], 1e-12);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(path.u[4 * 100 + k], -path.u[4 * 100 + 3 - k], 1e-12);
    }
    p.contacts = contacts;
  }
}

// Mass 1 lies on a floor and mass 2 on it, each under its own weight 1.
model::ImpactProblem<> stack(double eta, double end) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector2d(2.0, 3.0).asDiagonal();
  p.system.damping = p.system.stiffness = Eigen::Matrix2d::Zero();
  p.contacts = {{Eigen::Vector2d(1.0, 0.0), 0.0, eta}, {Eigen::Vector2d(-1.0, 1.0), 0.0, eta}};
  p.start = {0.0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  p.end = end;
  return p;
}

TEST(EventDriven, HoldsAStackThatIsPressedOnAFloor) {
  for (const std::string name : {"newmark", "rk4"})
    for (const double eta : {1.0, 0.0}) {
      auto p = stack(eta, 6.0);
      p.system.add_load = [](double t, std::span<double> f) {
        f[0] -= 1.0 + 0.5 * std::sin(t);
        f[1] -= 1.0;
      };
      const auto [path, outcome] = run(name, p, 0.1);
      ASSERT_TRUE(outcome.finished) << outcome.detail;
      EXPECT_TRUE(path.impacts->empty());
      // A rounding of the acceleration, times t^2 / 2.
      for (const double u : path.u) ASSERT_NEAR(u, 0.0, 18 * 0x1p-52);
    }
}

// The upper mass is pulled up from t = pi/2 on, u2'' = -cos(t)/3; the lower one stays.
TEST(EventDriven, ReleasesTheUpperMassOfAStack) {
  auto p = stack(1.0, 4.0);
  p.system.add_load = [](double t, std::span<double> f) {
    f[0] -= 1.0;
    f[1] -= std::cos(t);
  };
  for (int numbering = 0; numbering < 2; ++numbering) {
    const auto [path, outcome] = run("rk4", p, 0.01);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_TRUE(path.impacts->empty());
    EXPECT_NEAR(path.u.back(), (std::cos(4.0) + 4.0 - std::numbers::pi / 2) / 3, 1e-10);
    EXPECT_EQ(path.u[path.u.size() - 2], 0.0);
    std::swap(p.contacts[0], p.contacts[1]);
  }
}

// Without a weight of the lower mass both forces vanish at t = pi/2, and the lower mass still
// stays.
TEST(EventDriven, DecidesForcesThatVanishAtOneInstant) {
  auto p = stack(1.0, 4.0);
  p.system.add_load = [](double t, std::span<double> f) { f[1] -= std::cos(t); };
  for (int numbering = 0; numbering < 2; ++numbering) {
    const auto [path, outcome] = run("rk4", p, 0.01);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_TRUE(path.impacts->empty());
    EXPECT_NEAR(path.u.back(), (std::cos(4.0) + 4.0 - std::numbers::pi / 2) / 3, 1e-10);
    EXPECT_NEAR(path.u[path.u.size() - 2], 0.0, 1e-14);
    std::swap(p.contacts[0], p.contacts[1]);
  }
}

// Lifted from below where 2 cos(t) = -1 the stack leaves the floor as one mass, 5 u'' = -2 cos(t) -
// 1.
TEST(EventDriven, LiftsAStackAsAWhole) {
  auto p = stack(0.5, 3.0);
  p.system.add_load = [](double t, std::span<double> f) {
    f[0] -= 2.0 * std::cos(t);
    f[1] -= 1.0;
  };
  const double t0 = 2.0 * std::numbers::pi / 3, s = 3.0 - t0;
  const double u =
      (2.0 * std::cos(3.0) - 2.0 * std::cos(t0) + 2.0 * std::sin(t0) * s) / 5 - s * s / 10;
  for (int numbering = 0; numbering < 2; ++numbering) {
    const auto [path, outcome] = run("rk4", p, 0.01);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_TRUE(path.impacts->empty());
    EXPECT_NEAR(path.u.back(), u, 1e-10);
    EXPECT_NEAR(path.u[path.u.size() - 2], u, 1e-10);
    std::swap(p.contacts[0], p.contacts[1]);
  }
}

// A stack that falls on the floor as a whole: with eta = 1 it leaves the floor as one body, with
// eta = 0 it stays.
TEST(EventDriven, DropsAStackAsAWhole) {
  for (const double eta : {1.0, 0.0}) {
    auto p = stack(eta, 3.0);
    p.system.add_load = [](double, std::span<double> f) {
      f[0] -= 2.0;
      f[1] -= 3.0;
    };
    p.start.u = Eigen::Vector2d(0.5, 0.5);
    const auto [path, outcome] = run("rk4", p, 0.07);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    // The upper contact, at rest, passes the impulse on.
    ASSERT_EQ(path.impacts->size(), eta == 1.0 ? 4u : 2u);
    EXPECT_NEAR(path.impacts->at(0).t, 1.0, 1e-14);
    EXPECT_NEAR(path.impacts->at(0).impulse, (1.0 + eta) * 5.0, 1e-13);
    EXPECT_NEAR(path.impacts->at(1).impulse, (1.0 + eta) * 3.0, 1e-13);
    EXPECT_NEAR(path.u.back(), 0.0, 1e-13);
    EXPECT_NEAR(path.u[path.u.size() - 2], 0.0, 1e-13);
  }
}

// A load that is 0 at the start presses later: the contact is active without a force.
TEST(EventDriven, HoldsAContactThatIsPressedOnlyLater) {
  auto p = mass_on_stop(1.0, 0.0, 0.0, 0.0, 0.0, 0.5, 6.0);
  p.system.add_load = [](double t, std::span<double> f) { f[0] -= std::sin(t); };
  const auto [path, outcome] = run("rk4", p, 0.01);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  EXPECT_TRUE(path.impacts->empty());
  // Let go at t = pi: u = t - pi + sin(t).
  EXPECT_NEAR(path.u.back(), 6.0 - std::numbers::pi + std::sin(6.0), 1e-9);
}

TEST(EventDriven, HandlesContactsThatAreNotCoupledAtOneInstant) {
  auto p = row_of(4, 10.0);
  p.contacts.erase(p.contacts.begin() + 1);
  p.start.u << 2.0, 1.0, 0.5, -0.5;
  p.start.v << -1.0, 0.0, -1.0, 0.0;
  p.contacts[0].restitution = p.contacts[1].restitution = 0.0;
  const auto [path, outcome] = run("newmark", p, 0.3);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  EXPECT_EQ(path.impacts->size(), 2u);
  EXPECT_EQ(path.v.back(), -0.5);
}

// A second floor at the place of the first.
TEST(EventDriven, RefusesRedundantContactsThatAreClosed) {
  auto p = ball(0.5, 0.0, 1.0, 3.0);
  p.contacts.push_back(p.contacts[0]);
  const auto [path, outcome] = run("rk4", p, 0.3);
  EXPECT_TRUE(outcome.failed());
  EXPECT_EQ(outcome.reason, Code("redundant-contacts"));
  EXPECT_NE(outcome.detail.find(" s: contacts 1 and 2 are closed together and their directions "
                                "depend linearly on each other, so their impulses are not unique."),
            std::string::npos)
      << outcome.detail;
  EXPECT_NEAR(path.t.back(), 0.9, 1e-15);
  p.start.u[0] = 0.0;
  const auto no = method("rk4")->objection(p);
  ASSERT_TRUE(no);
  EXPECT_REFUSED(method("rk4")->prepare(p, 0.1), "redundant-contacts", no->sentence);
}

// How a run ends.

TEST(EventDriven, EndsAsDivergedBeyondTheStabilityLimitWithFiniteStatesOnly) {
  const RattlingMass reference{.sigma = 0.0, .eta = 1.0, .w = 1.0};
  for (const bool has_contact : {true, false}) {
    auto p = reference.problem(10001.0);
    if (!has_contact) p.contacts.clear();
    const auto [path, outcome] = run("central-difference", p, 2.5);
    // Impacts cut the steps short, and with them this run stays bounded.
    EXPECT_EQ(outcome.failed(), !has_contact);
    if (!has_contact) {
      EXPECT_EQ(outcome.reason, Code("diverged")) << outcome.detail;
      EXPECT_LT(path.t.back(), 10001.0);
    }
    for (const double u : path.u) ASSERT_TRUE(std::isfinite(u));
  }
}

struct ImpatientSink : model::Sink {
  int impacts = 0;
  double last = 0.0;
  bool take(const model::SampleBlock& block) override {
    last = block.t.back();
    return true;
  }
  bool take(const model::ReportedImpact&) override { return ++impacts < 3; }
};

TEST(EventDriven, EndsAtTheImpactWhereTheSinkSaysSo) {
  const RattlingMass reference{.sigma = 0.0, .eta = 1.0, .w = 1.0};
  ImpatientSink sink;
  const auto outcome = method("rk4")->prepare(reference.problem(100.0), 0.1)->advance(sink);
  EXPECT_TRUE(outcome.stopped_by_sink);
  EXPECT_FALSE(outcome.failed());
  EXPECT_EQ(sink.impacts, 3);
  EXPECT_NEAR(sink.last, reference.impact_time(3), 0.1);
}

TEST(EventDriven, RunsANonlinearForceOfAnySize) {
  for (const int n : {1, 2, 3})
    for (const auto& name : integrators) {
      SCOPED_TRACE(testing::Message() << name << " n = " << n);
      // Equal masses on cubic springs; the first has a stop. Each moves by itself, so the first one
      // does the same for every n.
      model::ImpactProblem<> p;
      p.system.mass = Eigen::MatrixXd::Identity(n, n);
      p.system.damping = p.system.stiffness = Eigen::MatrixXd::Zero(n, n);
      p.system.nonlinear = std::make_shared<checks::CubicForce<model::any_dof>>();
      p.contacts = {{Eigen::VectorXd::Unit(n, 0), 0.0, 1.0}};
      p.start = {0.0, Eigen::VectorXd::LinSpaced(n, 1.0, 1.5), Eigen::VectorXd::Zero(n)};
      if (n == 1) p.start.u[0] = 1.0;
      p.end = 10.0;
      const auto [path, outcome] = run(name, p, 0.01);
      ASSERT_TRUE(outcome.finished) << outcome.detail;
      if (name == "newmark" || name == "rk4") {
        EXPECT_EQ(outcome.work.newton_iterations > 0, name == "newmark");
      }
      auto alone = p;
      alone.system.mass = Eigen::MatrixXd::Identity(1, 1);
      alone.system.damping = alone.system.stiffness = Eigen::MatrixXd::Zero(1, 1);
      alone.contacts[0].direction = Eigen::VectorXd::Ones(1);
      alone.start = {0.0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1)};
      const auto reference = run("rk4", alone, 0.001).trajectory;
      EXPECT_EQ(path.impacts->size(), reference.impacts->size());
      EXPECT_GE(path.impacts->size(), 2u);
      // Second order, (w h)^2 / 12 a radian with w below 2, over 10 s; first order, w h / 20 a
      // radian.
      const bool is_first = method(name)->facts().smooth_order < 2.0;
      EXPECT_NEAR(path.u[path.u.size() - std::size_t(n)], reference.u.back(),
                  is_first ? 0.2 : 2e-3);
    }
}

}  // namespace
}  // namespace clackers::methods
