#include "clackers/methods/contact/reversal.hpp"

#include "clackers/methods/integrators/newmark.hpp"
#include "clackers/methods/testing/runs.hpp"

namespace clackers::methods {
namespace {

using runs::RattlingMass;
using runs::run;

TEST(Reversal, DoesWhatANaiveCodeDoes) {
  const RattlingMass reference{.sigma = 0.05, .eta = 0.8, .w = 1.3};
  const auto problem = reference.problem(21.0);
  const double h = 0.1;
  const auto [path, outcome] = run("newmark+reversal", problem, h);
  const auto fixed = model::with_dof<1>(problem);
  Newmark::Stepper<1> stepper({}, fixed.system, h);
  auto now = fixed.start;
  stepper.restart(now);
  std::size_t impacts = 0;
  for (std::size_t k = 1; k <= 200; ++k) {
    stepper.step(now);
    now.t = k == 200 ? 21.0 : 1.0 + double(k) * h;
    if (now.u[0] < 0.0 && now.v[0] < 0.0) {
      const auto& impact = path.impacts->at(impacts++);
      EXPECT_EQ(impact.t, now.t);
      EXPECT_EQ(impact.u[0], now.u[0]);
      EXPECT_EQ(impact.v_before[0], now.v[0]);
      EXPECT_NEAR(impact.impulse, -2.0 * 1.8 * now.v[0], 1e-15);
      now.v[0] = now.v[0] - 1.8 * now.v[0];
      EXPECT_NEAR(impact.v_after[0], now.v[0], 1e-16);
      now.v[0] = impact.v_after[0];
      stepper.restart(now);
    }
    ASSERT_EQ(path.u.at(k), now.u[0]) << k;
    ASSERT_EQ(path.v.at(k), now.v[0]) << k;
    ASSERT_EQ(path.t.at(k), now.t) << k;
  }
  EXPECT_EQ(path.impacts->size(), impacts);
  EXPECT_GE(impacts, 8u);
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

TEST(Reversal, EndsWhereTwoCoupledContactsFireInOneStep) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Matrix3d::Identity();
  p.system.damping = p.system.stiffness = Eigen::Matrix3d::Zero();
  p.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, 1.0}, {Eigen::Vector3d(0, 1, -1), 0.0, 1.0}};
  p.start = {0.0, Eigen::Vector3d(2, 0, -2), Eigen::Vector3d(-1, 0, 1)};
  p.end = 6.0;
  const auto outcome = run("rk4+reversal", p, 0.3).outcome;
  EXPECT_EQ(outcome.reason, Code("simultaneous-contacts"));
  EXPECT_NE(outcome.detail.find("contacts 1 and 2 share a mass"), std::string::npos)
      << outcome.detail;
  p.start.v[2] = 0.0;  // one after the other
  EXPECT_TRUE(run("rk4+reversal", p, 0.3).outcome.finished);
}

}  // namespace
}  // namespace clackers::methods
