#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

using runs::RattlingMass;
using runs::run;

TEST(MoreauJean, StepsByItsFormula) {
  for (const auto& [theta, is_nonlinear] :
       {std::pair(0.5, false), {0.8, false}, {1.0, false}, {0.5, true}, {0.8, true}}) {
    auto p = RattlingMass{.sigma = 0.2, .eta = 0.6, .w = 1.3}.problem(11.0);
    p.system.add_load = [](double t, std::span<double> f) { f[0] += std::sin(t); };
    if (is_nonlinear) p.system.nonlinear = std::make_shared<checks::CubicForce<model::any_dof>>();
    const double h = 0.125, m = p.system.mass(0, 0), c = p.system.damping(0, 0),
                 k = p.system.stiffness(0, 0);
    const auto [path, outcome] = run("moreau-jean:theta=" + std::to_string(theta), p, h);
    std::size_t impacts = 0;
    for (std::size_t n = 0; n + 1 < path.t.size(); ++n) {
      const double u0 = path.u[n], v0 = path.v[n], u1 = path.u[n + 1], v1 = path.v[n + 1];
      const double vt = theta * v1 + (1 - theta) * v0, ut = theta * u1 + (1 - theta) * u0;
      const double ft = theta * std::sin(path.t[n + 1]) + (1 - theta) * std::sin(path.t[n]);
      EXPECT_NEAR(u1, u0 + h * vt, 1e-15);
      const double force = is_nonlinear ? ut * ut * ut + 0.2 * ut * ut * vt : 0.0;
      const double impulse = m * (v1 - v0) + h * (c * vt + k * ut + force - ft);
      if (u0 + 0.5 * h * v0 > 0.0) {
        EXPECT_NEAR(impulse, 0.0, 1e-14);
        continue;
      }
      // 0 <= v1 + eta v0 complements P >= 0; with a nonlinear force within the end of the iteration.
      const double slack = is_nonlinear ? 1e-12 : 1e-14;
      EXPECT_GE(v1 + 0.6 * v0, -slack);
      EXPECT_GE(impulse, -1e-14);
      EXPECT_NEAR((v1 + 0.6 * v0) * impulse, 0.0, slack);
      if (impulse < 1e-12) continue;
      const auto& reported = path.impacts->at(impacts++);
      EXPECT_NEAR(reported.impulse, impulse, 10.0 * slack);
      EXPECT_EQ(reported.t, path.t[n + 1]);
      EXPECT_EQ(reported.v_before[0], v0);
      EXPECT_EQ(reported.v_after[0], v1);
    }
    EXPECT_EQ(impacts, path.impacts->size());
    EXPECT_GE(impacts, 3u);
  }
}

TEST(MoreauJean, KeepsTheEnergyWithThetaOneHalfAndLosesItWithMore) {
  const auto p = RattlingMass{.sigma = 0.0, .eta = 1.0, .w = 1.0}.problem(51.0);
  const auto energy = [&](const std::string& name) {
    const auto path = run(name, p, 0.01).trajectory;
    return (path.u.back() * path.u.back() + path.v.back() * path.v.back());
  };
  EXPECT_NEAR(energy("moreau-jean"), 1.0,
              0.01);  // an impact moves it by the penetration, h/2 at most
  EXPECT_LT(energy("moreau-jean:theta=1"), 0.7);
}

TEST(MoreauJean, HasAnEnvelopeOfFirstOrder) {
  const RattlingMass reference{.sigma = 0.05, .eta = 0.9, .w = 1.3};
  const auto envelope = [&](double h0) {
    double worst = 0.0;
    for (int i = 0; i < 8; ++i) {
      const double h = 20.0 / std::round(20.0 / (h0 * std::exp2(i / 8.0)));
      const auto path = run("moreau-jean", reference.problem(21.0), h).trajectory;
      for (std::size_t k = 0; k < path.t.size(); ++k)
        worst = std::max(worst, std::abs(path.u[k] - reference.u(path.t[k])));
    }
    return worst;
  };
  EXPECT_NEAR(std::log2(envelope(0.02) / envelope(0.00125)) / 4, 1.0, 0.2);
  EXPECT_EQ(method("moreau-jean")->facts().through_impacts.order, 1.0);
  EXPECT_EQ(method("moreau-jean")->facts().through_impacts.behaviour, Behaviour::irregular);
}

TEST(MoreauJean, EndsARunThatIsNoWholeNumberOfStepsWithAShorterOne) {
  const RattlingMass reference{.sigma = 0.05, .eta = 1.0, .w = 1.0};
  const auto prepared = method("moreau-jean")->prepare(reference.problem(2.0), 0.3);
  model::TrajectorySink one(true), two(true);
  prepared->advance(one);
  prepared->advance(two);  // the matrix of the last step is not that of the first
  EXPECT_EQ(one.trajectory().t.back(), 2.0);
  EXPECT_EQ(one.trajectory().t.size(), 5u);
  EXPECT_EQ(one.trajectory().u, two.trajectory().u);
  EXPECT_NEAR(one.trajectory().u[4] - one.trajectory().u[3],
              0.05 * (one.trajectory().v[4] + one.trajectory().v[3]), 1e-15);
}

TEST(MoreauJean, RefusesAWeightOutsideItsRange) {
  for (const auto* theta : {"0.49", "1.01"})
    EXPECT_REFUSED(method(std::string("moreau-jean:theta=") + theta), "out-of-range",
                   "1/2 <= theta <= 1");
}

model::ImpactProblem<> three_masses(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Matrix3d::Identity();
  p.system.damping = p.system.stiffness = Eigen::Matrix3d::Zero();
  p.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, 1.0}, {Eigen::Vector3d(0, 1, -1), 0.0, 1.0}};
  p.start = {0.0, u, v};
  p.end = 6.0;
  return p;
}

// Both outer masses reach the middle one in one step and leave it as they came.
TEST(MoreauJean, SolvesTwoCoupledImpactsInOneStep) {
  auto p = three_masses({2, 0, -2}, {-1, 0, 1});
  const auto [path, outcome] = run("moreau-jean", p, 0.3);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_EQ(path.impacts->size(), 2u);
  EXPECT_NEAR(path.v[path.v.size() - 3], 1.0, 1e-15);
  EXPECT_NEAR(path.v[path.v.size() - 2], 0.0, 1e-15);
  EXPECT_NEAR(path.v.back(), -1.0, 1e-15);
  p.contacts.push_back({Eigen::Vector3d(1, 0, -1), 0.0, 1.0});
  EXPECT_EQ(run("moreau-jean", p, 0.3).outcome.reason, Code("redundant-contacts"));
}

// Masses 1 and 2 touch at rest when mass 3 strikes mass 2 from below. That impulse makes the closed
// contact close, whichever number it has, and the momentum is shared.
TEST(MoreauJean, DoesNotDependOnTheNumbersOfTheContacts) {
  auto p = three_masses({0, 0, -2}, {0, 0, 1});
  const auto one = run("moreau-jean", p, 0.3);
  std::swap(p.contacts[0], p.contacts[1]);
  const auto other = run("moreau-jean", p, 0.3);
  for (const auto& [path, outcome] : {one, other}) {
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_EQ(path.impacts->size(), 2u);
    EXPECT_NEAR(path.v[path.v.size() - 3], 2.0 / 3, 1e-15);
    EXPECT_NEAR(path.v[path.v.size() - 2], 2.0 / 3, 1e-15);
    EXPECT_NEAR(path.v.back(), -1.0 / 3, 1e-15);
  }
  for (std::size_t i = 0; i < one.trajectory.u.size(); ++i)
    EXPECT_NEAR(one.trajectory.u[i], other.trajectory.u[i], 1e-14);
}

}  // namespace
}  // namespace clackers::methods
