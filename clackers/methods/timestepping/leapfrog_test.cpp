// The formulas of central differences with impulses, read off the displacements of a run.

#include "clackers/methods/timestepping/leapfrog.hpp"

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

using runs::mass_on_stop;
using runs::RattlingMass;
using runs::run;

struct Kick {
  double u, w0, w1, impulse;  // at a step, its half steps before and after
};

// The impulse of each step from M (w1 - w0) + h (C v + K u + p - f) = P, v = (w0 + w1) / 2.
std::vector<Kick> kicks(const model::Trajectory& path, const model::ImpactProblem<>& p, double h) {
  const double m = p.system.mass(0, 0), c = p.system.damping(0, 0), k = p.system.stiffness(0, 0);
  std::vector<Kick> all;
  for (std::size_t n = 1; n + 1 < path.t.size(); ++n) {
    const double u = path.u[n];
    const double w0 = (u - path.u[n - 1]) / h, w1 = (path.u[n + 1] - u) / h, v = 0.5 * (w0 + w1);
    EXPECT_NEAR(path.v[n], v, 1e-13);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(1), x(1), rate(1);
    if (p.system.nonlinear) {
      x << u;
      rate << v;
      p.system.nonlinear->add(x, rate, force);
      force = -force;
    }
    p.system.add_load(path.t[n], {force.data(), 1});
    all.push_back({u, w0, w1, m * (w1 - w0) + h * (c * v + k * u - force[0])});
  }
  return all;
}

struct Law {
  std::string name;
  double eta;
  double (*least)(const Kick&, double eta, double h);  // of w1
};

void PrintTo(const Law& law, std::ostream* out) { *out << law.name << ", eta = " << law.eta; }

class LeapfrogLaw : public testing::TestWithParam<Law> {};

TEST_P(LeapfrogLaw, HoldsInEveryStep) {
  const auto& [name, eta, least] = GetParam();
  for (const bool is_nonlinear : {false, true}) {
    auto p = RattlingMass{.sigma = 0.2, .eta = eta, .w = 1.3}.problem(11.0);
    p.system.add_load = [](double t, std::span<double> f) { f[0] += std::sin(2.0 * t); };
    if (is_nonlinear) p.system.nonlinear = std::make_shared<checks::CubicForce<model::any_dof>>();
    const double h = 0.03125;
    const auto [path, outcome] = run(name, p, h);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    double impulses = 0.0, reported = 0.0;
    for (const auto& kick : kicks(path, p, h)) {
      const double excess = kick.w1 - least(kick, eta, h);
      EXPECT_NEAR(std::isinf(excess) ? kick.impulse : std::min(excess, kick.impulse), 0.0, 1e-11);
      impulses += kick.impulse;
    }
    for (const auto& impact : *path.impacts) reported += impact.impulse;
    EXPECT_NEAR(reported, impulses, 1e-11);
    EXPECT_GT(reported, 1.0);
  }
}

double paoli_schatzman(const Kick& x, double eta, double h) {
  return eta * x.w0 - (1.0 + eta) * x.u / h;
}
double cd_lagrange(const Kick& x, double eta, double) {
  return x.u > 0.0 ? -INFINITY : -eta * x.w0;
}
double forward_increment(const Kick& x, double, double h) { return -x.u / h; }

INSTANTIATE_TEST_SUITE_P(Schemes, LeapfrogLaw,
                         testing::Values(Law{"paoli-schatzman", 1.0, paoli_schatzman},
                                         Law{"paoli-schatzman", 0.6, paoli_schatzman},
                                         Law{"paoli-schatzman", 0.0, forward_increment},
                                         Law{"cd-lagrange", 1.0, cd_lagrange},
                                         Law{"cd-lagrange", 0.6, cd_lagrange},
                                         Law{"cd-lagrange", 0.0, cd_lagrange},
                                         Law{"forward-increment-lagrange", 0.0, forward_increment},
                                         Law{"forward-increment-lagrange", 0.6, paoli_schatzman}));

TEST(Leapfrog, AShorterLastStepLiesOnTheParabolaThroughTheLastSteps) {
  auto p = mass_on_stop(2.0, 0.4, 3.0, 1.0, 0.5, 1.0, 0.55);
  const auto path = run("cd-lagrange", p, 0.1).trajectory;
  ASSERT_EQ(path.t.size(), 7u);
  p.end = 0.6;
  const auto whole = run("cd-lagrange", p, 0.1).trajectory;
  const double a = (whole.u[6] - 2.0 * whole.u[5] + whole.u[4]) / 0.01;
  EXPECT_NEAR(path.u[6], whole.u[5] + 0.05 * whole.v[5] + 0.5 * 0.0025 * a, 1e-14);
  // The velocity there is that of a step of 0.05.
  const double w = whole.v[5] + 0.025 * a;
  EXPECT_NEAR(2.0 * (path.v[6] - w) / 0.05 * 2.0 + 0.4 * path.v[6] + 3.0 * path.u[6], 0.0, 1e-12);
}

TEST(PaoliSchatzman, TwoStepsOfAnImpactAreReportedAsOne) {
  for (const double eta : {0.3, 0.7, 1.0})
    for (const double u : {1.01, 1.037, 1.05, 1.099}) {
      const auto path =
          run("paoli-schatzman", mass_on_stop(2.0, 0.0, 0.0, u, -1.0, eta, 2.0), 0.1).trajectory;
      ASSERT_EQ(path.impacts->size(), 1u) << u;
      const auto& impact = path.impacts->front();
      EXPECT_NEAR(impact.impulse, 2.0 * (1.0 + eta), 1e-13);
      EXPECT_NEAR(impact.v_before[0], -1.0, 1e-13);
      EXPECT_NEAR(impact.v_after[0], eta, 1e-13);
      EXPECT_NEAR(path.v.back(), eta, 1e-13);
      // A straight line from the stop, left two steps after the time at which it was reached.
      const double left = 2.0 - path.u.back() / eta;
      EXPECT_NEAR(left, u + 0.2, 1e-12);
    }
}

// Where the weight presses the contact on after two steps, their impact is one.
TEST(PaoliSchatzman, AnImpactOfThreeStepsIsReportedAsOne) {
  for (int i = 0; i < 200; ++i) {
    auto p = mass_on_stop(1.0, 0.0, 0.0, 0.1 + 1e-4 * i, -1.0, 0.5, 0.3);
    p.system.add_load = [](double, std::span<double> f) { f[0] -= 9.81; };
    const auto impacts = *run("paoli-schatzman", p, 0.002).trajectory.impacts;
    ASSERT_GE(impacts.size(), 2u);
    EXPECT_GT(impacts[1].t, impacts[0].t + 0.1) << i;
  }
}

TEST(PaoliSchatzman, AnImpactThatTheRunCutsIsReportedAtItsEnd) {
  const auto p = mass_on_stop(2.0, 0.0, 0.0, 1.05, -1.0, 1.0, 1.1);
  const auto path = run("paoli-schatzman", p, 0.1).trajectory;
  const auto longer = [&] {
    auto q = p;
    q.end = 1.2;
    return run("paoli-schatzman", q, 0.1).trajectory;
  }();
  ASSERT_EQ(longer.impacts->size(), 1u);
  const bool is_cut = longer.impacts->front().t > 1.15;
  EXPECT_TRUE(is_cut);
  ASSERT_EQ(path.impacts->size(), 1u);
  EXPECT_EQ(path.impacts->front().t, 1.1);
  EXPECT_LT(path.impacts->front().impulse, 4.0);
}

// The first block of states, 256 of them, ends in the middle of the impact.
TEST(PaoliSchatzman, ARunEndedInAnImpactLeavesNothingToTheNext) {
  struct FirstBlock : model::TrajectorySink {
    FirstBlock() : TrajectorySink(true) {}
    bool take(const model::SampleBlock&) override { return false; }
    bool take(const model::ReportedImpact&) override {
      ADD_FAILURE() << "the impact is over";
      return false;
    }
  } ended;
  const auto prepared =
      method("paoli-schatzman")->prepare(mass_on_stop(2.0, 0.0, 0.0, 2.545, -1.0, 1.0, 5.0), 0.01);
  prepared->advance(ended);
  model::TrajectorySink whole(true);
  prepared->advance(whole);
  ASSERT_EQ(whole.trajectory().impacts->size(), 1u);
  EXPECT_NEAR(whole.trajectory().impacts->front().t, 2.56, 1e-12);
  EXPECT_NEAR(whole.trajectory().impacts->front().impulse, 4.0, 1e-12);
}

TEST(ForwardIncrementLagrange, RunsAreThoseOfPaoliAndSchatzman) {
  for (const double eta : {0.0, 0.5, 0.8, 1.0}) {
    model::ImpactProblem<> p;
    p.system.mass = Eigen::Vector2d(1.0, 2.0).asDiagonal();
    p.system.damping = 0.1 * Eigen::Matrix2d::Identity();
    p.system.stiffness = Eigen::Vector2d(9.0, 2.0).asDiagonal();
    p.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, eta}, {Eigen::Vector2d(0.0, 1.0), -0.3, eta}};
    p.start = {0.0, Eigen::Vector2d(0.5, -0.1), Eigen::Vector2d(-0.3, 0.7)};
    p.end = 10.0;
    const auto a = run("forward-increment-lagrange", p, 0.01).trajectory,
               b = run("paoli-schatzman", p, 0.01).trajectory;
    EXPECT_GT(a.impacts->size(), 2u);
    EXPECT_EQ(a.u, b.u);
    EXPECT_EQ(a.v, b.v);
    ASSERT_EQ(a.impacts->size(), b.impacts->size());
    for (std::size_t k = 0; k < a.impacts->size(); ++k)
      EXPECT_EQ((*a.impacts)[k].impulse, (*b.impacts)[k].impulse);
  }
  EXPECT_EQ(method("forward-increment-lagrange")->facts().name, "forward-increment-lagrange");
}

// A mass pressed against its stop stays there, and leaves when the load pulls.
TEST(ForwardIncrementLagrange, KeepsALastingContactClosedWithSecondOrder) {
  auto p = mass_on_stop(1.0, 0.3, 0.0, 0.5, -1.0, 0.0, 6.0);
  p.system.add_load = [](double t, std::span<double> f) { f[0] += t - 3.0; };
  const auto u_end = [&](double h) {
    const auto path = run("forward-increment-lagrange", p, h).trajectory;
    for (std::size_t k = 0; k < path.t.size(); ++k) {
      EXPECT_GE(path.u[k], -1e-13);
      if (path.t[k] > 1.0 && path.t[k] < 3.0) {
        EXPECT_NEAR(path.u[k], 0.0, 1e-13);
      }
    }
    return path.u.back();
  };
  // u'' + 0.3 u' = s from rest at s = 0.
  const double c = 0.3, s = 3.0;
  const double exact = s * s / (2 * c) - s / (c * c) + (1.0 - std::exp(-c * s)) / (c * c * c);
  const double coarse = u_end(6.0 / 97) - exact, fine = u_end(6.0 / 389) - exact;
  EXPECT_NEAR(std::log2(std::abs(coarse / fine)) / 2.0, 2.0, 0.25);
}

}  // namespace
}  // namespace clackers::methods
