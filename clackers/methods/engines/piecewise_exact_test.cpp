#include <algorithm>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::methods {
namespace {

using runs::mass_on_stop;
using runs::RattlingMass;
using runs::run;

using std::numbers::pi;

TEST(PiecewiseExact, RattlesAsTheClosedFormAtEveryStep) {
  for (const auto& mass : {RattlingMass{.sigma = 0.05, .eta = 1.0, .w = 1.0},
                           RattlingMass{.sigma = 0.2, .eta = 0.6, .w = 1.3},
                           RattlingMass{.sigma = 0.0, .eta = 0.9, .w = 7.0}})
    for (const double h : {0.037, 1.3, 20.0}) {
      const auto [path, outcome] = run("piecewise-exact", mass.problem(21.0), h);
      ASSERT_TRUE(outcome.finished) << outcome.detail;
      for (std::size_t i = 0; i < path.t.size(); ++i) {
        // Phases of up to 147 radians, each flight's rounded a few times.
        EXPECT_NEAR(path.u[i], mass.u(path.t[i]), 3e-14) << h;
        EXPECT_NEAR(path.v[i], mass.v(path.t[i]), 2e-13) << h;
      }
      ASSERT_EQ(std::ssize(*path.impacts), mass.count(21.0) - mass.count(1.0));
      for (std::size_t i = 0; i < path.impacts->size(); ++i) {
        const auto& impact = (*path.impacts)[i];
        const double t = mass.impact_time(mass.count(1.0) + int(i) + 1);
        EXPECT_NEAR(impact.t, t, 1e-14 * t);
        EXPECT_NEAR(impact.v_after[0], -mass.eta * impact.v_before[0], 1e-15);
        EXPECT_NEAR(impact.impulse, 2.0 * (impact.v_after[0] - impact.v_before[0]), 1e-15);
      }
    }
}

TEST(PiecewiseExact, ItsImpactsDoNotDependOnTheStep) {
  const auto problem = RattlingMass{.sigma = 0.02, .eta = 0.95, .w = 3.0}.problem(51.0);
  const auto coarse = run("piecewise-exact", problem, 50.0),
             fine = run("piecewise-exact", problem, 0.01);
  ASSERT_EQ(coarse.trajectory.impacts->size(), fine.trajectory.impacts->size());
  for (std::size_t i = 0; i < fine.trajectory.impacts->size(); ++i)
    EXPECT_EQ((*coarse.trajectory.impacts)[i].t, (*fine.trajectory.impacts)[i].t);
  EXPECT_EQ(coarse.trajectory.u.back(), fine.trajectory.u.back());
  EXPECT_EQ(coarse.trajectory.t.size(), 2u);
}

TEST(PiecewiseExact, EndsARunThatIsNoWholeNumberOfStepsAtItsEnd) {
  const RattlingMass mass;
  const auto path = run("piecewise-exact", mass.problem(2.0), 0.3).trajectory;
  ASSERT_EQ(path.t.size(), 5u);
  EXPECT_EQ(path.t.back(), 2.0);
  EXPECT_NEAR(path.u.back(), mass.u(2.0), 1e-15);
}

TEST(PiecewiseExact, DeliversTheRightLimitAtAnImpactOfTheGrid) {
  // u = 1 - t, an impact at t = 1.
  const auto path =
      run("piecewise-exact", mass_on_stop(1.0, 0.0, 0.0, 1.0, -1.0, 0.5, 2.0), 0.25).trajectory;
  EXPECT_EQ(path.t[4], 1.0);
  EXPECT_EQ(path.v[4], 0.5);
  EXPECT_EQ(path.impacts->at(0).t, 1.0);
  EXPECT_EQ(path.u.back(), 0.5);
}

// Springs of their own and between neighbours, damping that couples their modes.
model::ImpactProblem<> chain(double eta) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector3d(1.0, 0.4, 2.0).asDiagonal();
  Eigen::Matrix3d k, c;
  k << 20.0, -5.0, 0.0, -5.0, 90.0, -3.0, 0.0, -3.0, 15.0;
  c << 0.3, -0.1, 0.0, -0.1, 0.1, 0.0, 0.0, 0.0, 0.02;
  p.system.stiffness = k;
  p.system.damping = c;
  p.contacts = {{Eigen::Vector3d(1, -1, 0), -0.3, eta},
                {Eigen::Vector3d(0, 1, -1), -0.2, eta},
                {Eigen::Vector3d(0, 0, 1), -0.4, eta}};
  p.start = {0.0, Eigen::Vector3d(0.6, 0.1, 0.2), Eigen::Vector3d(-2.0, 1.5, 0.5)};
  p.end = 6.0;
  return p;
}

TEST(PiecewiseExact, AgreesWithSmallStepsOfRk4ForCoupledModesAndSeveralContacts) {
  for (const double eta : {1.0, 0.6, 0.0}) {
    const auto problem = chain(eta);
    const auto exact = run("piecewise-exact", problem, 0.05),
               small = run("rk4+event-driven", problem, 2.5e-4);
    ASSERT_TRUE(exact.outcome.finished && small.outcome.finished) << small.outcome.detail;
    ASSERT_EQ(exact.trajectory.impacts->size(), small.trajectory.impacts->size()) << eta;
    EXPECT_GE(exact.trajectory.impacts->size(), 5u);
    for (std::size_t i = 0; i < exact.trajectory.impacts->size(); ++i) {
      EXPECT_EQ((*exact.trajectory.impacts)[i].contact, (*small.trajectory.impacts)[i].contact);
      EXPECT_NEAR((*exact.trajectory.impacts)[i].t, (*small.trajectory.impacts)[i].t, 1e-8);
    }
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(exact.trajectory.u.end()[-1 - long(i)], small.trajectory.u.end()[-1 - long(i)],
                  1e-8)
          << eta;
  }
}

TEST(PiecewiseExact, KeepsTheEnergyThroughElasticImpacts) {
  auto problem = chain(1.0);
  problem.system.damping.setZero();
  problem.end = 300.0;
  const auto path = run("piecewise-exact", problem, 1.0).trajectory;
  const auto energy = [&](std::size_t row) {
    const Eigen::Vector3d u(&path.u[3 * row]), v(&path.v[3 * row]);
    const Eigen::Matrix3d m = problem.system.mass, k = problem.system.stiffness;
    return 0.5 * (v.dot(m * v) + u.dot(k * u));
  };
  EXPECT_GE(path.impacts->size(), 300u);
  for (std::size_t row = 0; row < path.t.size(); ++row)
    EXPECT_NEAR(energy(row) / energy(0), 1.0, 1e-12) << path.t[row];
}

// A spring whose rest is below the stop at u = 0.5 presses the mass on it.
model::ImpactProblem<> pressed(double eta) {
  auto p = mass_on_stop(1.0, 0.1, 4.0, 1.0, 0.0, eta, 40.0);
  p.contacts[0].gap = 0.5;
  return p;
}

TEST(PiecewiseExact, RestsAfterAnInelasticImpact) {
  const auto [path, outcome] = run("piecewise-exact", pressed(0.0), 0.1);
  ASSERT_TRUE(outcome.finished);
  ASSERT_EQ(path.impacts->size(), 1u);
  for (std::size_t i = 0; i < path.t.size(); ++i) {
    if (path.t[i] < (*path.impacts)[0].t) continue;
    EXPECT_EQ(path.u[i], 0.5);
    EXPECT_EQ(path.v[i], 0.0);
  }
}

TEST(PiecewiseExact, RestsWhereImpactsHaveAccumulated) {
  for (const double eta : {0.3, 0.9}) {
    const auto [path, outcome] = run("piecewise-exact", pressed(eta), 0.1);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_EQ(path.u.back(), 0.5);
    EXPECT_EQ(path.v.back(), 0.0);
    const auto& impacts = *path.impacts;
    // Speeds fall by eta from impact to impact in the end, until the gap rises by less than its
    // rounding: v^2/(2 k gap) of 1e-15.
    ASSERT_GE(impacts.size(), 5u);
    EXPECT_NEAR(impacts.back().v_before[0] / impacts.end()[-2].v_before[0], eta, 1e-3);
    EXPECT_LT(-impacts.back().v_before[0], 3e-7);
    EXPECT_GT(-impacts.back().v_before[0], 1e-9);
    // Flights of nearly constant acceleration last 2 v/a, and v falls by eta.
    EXPECT_NEAR(
        (impacts.end()[-1].t - impacts.end()[-2].t) / (impacts.end()[-2].t - impacts.end()[-3].t),
        eta, 0.05);
  }
}

// Mass 1 at a stop, a spring of 5 to mass 2, which swings around 0: the force on the stop is -5 u2.
model::ImpactProblem<> relieved() {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Matrix2d::Identity();
  p.system.damping = Eigen::Matrix2d::Zero();
  p.system.stiffness = Eigen::Matrix2d{{5.0, -5.0}, {-5.0, 9.0}};
  p.contacts = {{Eigen::Vector2d(1, 0), 0.0, 0.5}};
  p.start = {0.0, Eigen::Vector2d(0, -1), Eigen::Vector2d(0, 0)};
  p.end = 1.0;
  return p;
}

TEST(PiecewiseExact, ReleasesAContactWhereItsForceEnds) {
  const auto problem = relieved();
  const auto path = run("piecewise-exact", problem, 1.0 / 64.0).trajectory;
  const double release = 0.5 * pi / 3.0;
  EXPECT_TRUE(path.impacts->empty());
  // After the release the two modes go on from u = (0, 0), v = (0, 3).
  const auto modes =
      numerics::normal_modes(problem.system.stiffness, Eigen::MatrixXd::Identity(2, 2)).value();
  for (std::size_t i = 0; i < path.t.size(); ++i) {
    const double t = path.t[i];
    if (t < release) {
      EXPECT_EQ(path.u[2 * i], 0.0) << t;
      EXPECT_NEAR(path.u[2 * i + 1], -std::cos(3.0 * t), 1e-15) << t;
      continue;
    }
    Eigen::Vector2d u = Eigen::Vector2d::Zero();
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector2d shape = modes.shapes.col(j);
      const double omega = std::sqrt(modes.squares[j]);
      u += shape * (3.0 * shape[1] / omega * std::sin(omega * (t - release)));
    }
    EXPECT_NEAR(path.u[2 * i], u[0], 1e-14) << t;
    EXPECT_NEAR(path.u[2 * i + 1], u[1], 1e-14) << t;
  }
}

TEST(PiecewiseExact, DepartsFromAClosedContactWithoutAnImpact) {
  // At rest on the stop at u = 0.5, with the spring's rest above it.
  auto p = mass_on_stop(1.0, 0.0, 4.0, -0.5, 0.0, 0.5, 3.0);
  p.contacts[0].gap = -0.5;
  const auto path = run("piecewise-exact", p, 0.1).trajectory;
  EXPECT_TRUE(path.impacts->empty());
  for (std::size_t i = 0; i < path.t.size(); ++i)
    EXPECT_NEAR(path.u[i], -0.5 * std::cos(2.0 * path.t[i]), 1e-15);
}

// Free masses in a row; the gaps between neighbours are closed by the start or later.
model::ImpactProblem<> free_row(const Eigen::VectorXd& u, const Eigen::VectorXd& v, double eta) {
  const auto n = u.size();
  model::ImpactProblem<> p;
  p.system.mass = Eigen::MatrixXd::Identity(n, n);
  p.system.damping = p.system.stiffness = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    b[i] = 1.0;
    b[i + 1] = -1.0;
    p.contacts.push_back({b, 0.0, eta});
  }
  p.start = {0.0, u, v};
  p.end = 6.0;
  return p;
}

TEST(PiecewiseExact, ClosesSeveralContactsAtOnceWhateverTheirNumbers) {
  // Outer masses strike the middle one from both sides at t = 2.
  auto p = free_row(Eigen::Vector3d(2, 0, -2), Eigen::Vector3d(-1, 0, 1), 0.5);
  const auto one = run("piecewise-exact", p, 0.5);
  std::swap(p.contacts[0], p.contacts[1]);
  const auto other = run("piecewise-exact", p, 0.5);
  ASSERT_TRUE(one.outcome.finished && other.outcome.finished);
  EXPECT_EQ(one.trajectory.u, other.trajectory.u);
  ASSERT_EQ(one.trajectory.impacts->size(), 2u);
  EXPECT_EQ(one.trajectory.impacts->at(0).t, 2.0);
  EXPECT_EQ(one.trajectory.impacts->at(1).t, 2.0);
  const std::vector<double> v(one.trajectory.v.end() - 3, one.trajectory.v.end());
  EXPECT_NEAR(v[0], 0.5, 1e-15);
  EXPECT_NEAR(v[1], 0.0, 1e-15);
  EXPECT_NEAR(v[2], -0.5, 1e-15);
}

// Three free masses with eta < 7 - 4 sqrt 3 collide for ever in a finite time (inelastic collapse).
TEST(PiecewiseExact, CollapsesThreeFreeMassesIntoOne) {
  const auto [path, outcome] =
      run("piecewise-exact", free_row(Eigen::Vector3d(1, 0, -1), Eigen::Vector3d(-1, 0, 0.2), 0.05),
          0.5);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  for (std::size_t i = path.v.size() - 3; i < path.v.size(); ++i)
    EXPECT_NEAR(path.v[i], -0.8 / 3.0, 1e-9);
}

TEST(PiecewiseExact, CountsItsWork) {
  const auto work = run("piecewise-exact", RattlingMass{}.problem(21.0), 0.5).outcome.work;
  EXPECT_EQ(work.steps, 40);
  EXPECT_EQ(work.event_searches, 7);
  EXPECT_GT(work.force_evaluations, 40);
  EXPECT_LT(work.force_evaluations, 40 + 8 * 15);
}

TEST(PiecewiseExact, RefusesWhatItCannotTake) {
  const auto refuse = [](const model::ImpactProblem<>& p, std::string_view code,
                         std::string_view words) {
    EXPECT_REFUSED(method("piecewise-exact")->prepare(p, 0.1), code, words);
  };
  auto p = RattlingMass{}.problem(10.0);
  p.system.nonlinear = std::make_shared<checks::CubicForce<model::any_dof>>();
  refuse(p, "linear-only", "nonlinear force");
  p = RattlingMass{}.problem(10.0);
  p.system.add_load = [](double, std::span<double>) {};
  refuse(p, "linear-only", "load f(t)");
  // Two masses that a dashpot couples, where two eigenvalues have met.
  p = free_row(Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 0), 1.0);
  p.system.stiffness = Eigen::Vector2d(1.0, 4.0).asDiagonal();
  const auto oscillates = [&](double c) {
    p.system.damping = Eigen::Matrix2d{{c, -1.0}, {-1.0, 1.0}};
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    a.topRightCorner<2, 2>().setIdentity();
    a.bottomLeftCorner<2, 2>() = -p.system.stiffness;
    a.bottomRightCorner<2, 2>() = -p.system.damping;
    return numerics::eigenvalues(a).imag().cwiseAbs().minCoeff() > 0.0;
  };
  double low = 1.5, high = 50.0;
  for (int i = 0; i < 60; ++i) (oscillates(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  oscillates(high);
  refuse(p, "linear-only", "no sum of modes");
  p = free_row(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0), 1.0);
  p.contacts.push_back(p.contacts[0]);
  refuse(p, "redundant-contacts", "contacts 1 and 2");
}

TEST(PiecewiseExact, EndsWhereTheMotionIsNoLongerFinite) {
  auto p = mass_on_stop(1.0, -50.0, 1.0, 1.0, 1.0, 1.0, 1000.0);
  const auto outcome = run("piecewise-exact", p, 1.0).outcome;
  EXPECT_FALSE(outcome.finished);
  EXPECT_EQ(outcome.reason, Code("diverged"));
}

}  // namespace
}  // namespace clackers::methods
