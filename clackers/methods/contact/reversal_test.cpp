#include "clackers/methods/testing/runs.hpp"

namespace clackers::methods {
namespace {

using runs::RattlingMass;
using runs::run;

// Under a constant force average acceleration is exact, so a ball dropped from u = 0.55 under unit
// gravity is known to rounding: the first step that ends below the floor ends at t = 1.1 with
// u = -0.055, v = -1.1.
TEST(Reversal, ReversesTheVelocityAtTheEndOfTheStepAndKeepsThePenetration) {
  auto p = runs::mass_on_stop(2.0, 0.0, 0.0, 0.55, 0.0, 0.8, 2.0);
  p.system.add_load = [](double, std::span<double> f) { f[0] -= 2.0; };
  const auto [path, outcome] = run("newmark+reversal", p, 0.1);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_EQ(path.impacts->size(), 1u);
  const auto& impact = path.impacts->front();
  EXPECT_NEAR(impact.t, 1.1, 1e-15);
  EXPECT_NEAR(impact.u[0], -0.055, 1e-15 * 8);
  EXPECT_NEAR(impact.v_before[0], -1.1, 1e-15 * 8);
  EXPECT_NEAR(impact.v_after[0], 0.88, 1e-15 * 8);
  EXPECT_NEAR(impact.impulse, 2.0 * 1.98, 1e-14);
  for (std::size_t k = 0; k < path.t.size(); ++k) {
    const double t = path.t[k], s = t - 1.1;
    const bool is_before = k <= 10;
    EXPECT_NEAR(path.u[k], is_before ? 0.55 - 0.5 * t * t : -0.055 + 0.88 * s - 0.5 * s * s, 1e-14);
    EXPECT_NEAR(path.v[k], is_before ? -t : 0.88 - s, 1e-14);
  }
}

TEST(Reversal, ClaimsAnIrregularFirstOrderWhateverTheIntegrator) {
  for (const std::string name : {"newmark+reversal", "rk4+reversal"}) {
    const auto claim = method(name)->facts().through_impacts;
    EXPECT_EQ(claim.behaviour, Behaviour::irregular);
    EXPECT_EQ(claim.order, 1.0);
  }
}

// The worst error over eight neighbouring steps falls like h, and neighbours scatter.
TEST(Reversal, HasAnEnvelopeOfFirstOrder) {
  const RattlingMass reference{.sigma = 0.05, .eta = 1.0, .w = 1.3};
  const auto envelope = [&](double h0) {
    double worst = 0.0;
    for (int i = 0; i < 8; ++i) {
      const double h = 20.0 / std::round(20.0 / (h0 * std::exp2(i / 8.0)));
      const auto path = run("rk4+reversal", reference.problem(21.0), h).trajectory;
      for (std::size_t k = 0; k < path.t.size(); ++k)
        worst = std::max(worst, std::abs(path.u[k] - reference.u(path.t[k])));
    }
    return worst;
  };
  const double order = std::log2(envelope(0.02) / envelope(0.00125)) / 4;
  EXPECT_NEAR(order, 1.0, 0.2);
}

// Both outer masses reach the middle one in one step and leave it as they came.
TEST(Reversal, SolvesTwoCoupledImpactsInOneStep) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Matrix3d::Identity();
  p.system.damping = p.system.stiffness = Eigen::Matrix3d::Zero();
  p.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, 1.0}, {Eigen::Vector3d(0, 1, -1), 0.0, 1.0}};
  p.start = {0.0, Eigen::Vector3d(2, 0, -2), Eigen::Vector3d(-1, 0, 1)};
  p.end = 6.0;
  const auto [path, outcome] = run("rk4+reversal", p, 0.3);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_EQ(path.impacts->size(), 2u);
  EXPECT_NEAR(path.v[path.v.size() - 3], 1.0, 1e-15);
  EXPECT_NEAR(path.v[path.v.size() - 2], 0.0, 1e-15);
  EXPECT_NEAR(path.v.back(), -1.0, 1e-15);
  p.contacts.push_back({Eigen::Vector3d(1, 0, -1), 0.0, 1.0});
  EXPECT_EQ(run("rk4+reversal", p, 0.3).outcome.reason, Code("redundant-contacts"));
}

// Mass 1 lies penetrated and at rest on mass 2 (eta = 0) when mass 3 strikes mass 2 from below:
// mass 2 then moves towards mass 1. Contacts numbered from above and from below must do the same.
TEST(Reversal, DoesNotDependOnTheNumbersOfTheContacts) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Matrix3d::Identity();
  p.system.damping = p.system.stiffness = Eigen::Matrix3d::Zero();
  p.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, 0.0}, {Eigen::Vector3d(0, 1, -1), 0.0, 1.0}};
  p.start = {0.0, Eigen::Vector3d(0.25, 0, -5), Eigen::Vector3d(-1, 0, 1)};
  p.end = 12.0;
  const auto one = run("rk4+reversal", p, 0.3);
  std::swap(p.contacts[0], p.contacts[1]);
  const auto other = run("rk4+reversal", p, 0.3);
  ASSERT_EQ(one.outcome.finished, other.outcome.finished);
  ASSERT_EQ(one.trajectory.u.size(), other.trajectory.u.size());
  for (std::size_t i = 0; i < one.trajectory.u.size(); ++i) {
    EXPECT_NEAR(one.trajectory.u[i], other.trajectory.u[i], 1e-14);
    EXPECT_NEAR(one.trajectory.v[i], other.trajectory.v[i], 1e-15);
  }
  // The second impact, at two contacts: mass 3 takes part in the motion of the others.
  ASSERT_EQ(one.trajectory.impacts->size(), 3u);
  EXPECT_EQ(one.trajectory.impacts->at(1).t, one.trajectory.impacts->at(2).t);
  EXPECT_NEAR(one.trajectory.v[one.trajectory.v.size() - 3],
              one.trajectory.v[one.trajectory.v.size() - 2], 1e-15);
}

}  // namespace
}  // namespace clackers::methods
