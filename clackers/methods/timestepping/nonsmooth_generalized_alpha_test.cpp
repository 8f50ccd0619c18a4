#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

using runs::RattlingMass;
using runs::run;

// All unknowns of the formula from displacements and velocities: W from the difference of the two
// rules for u1 and v1, which share a1.
TEST(NonsmoothGeneralizedAlpha, StepsByItsFormula) {
  for (const double rho : {0.0, 0.5, 0.8, 1.0})
    for (const bool is_nonlinear : {false, true}) {
      auto p = RattlingMass{.sigma = 0.2, .eta = 0.6, .w = 1.3}.problem(11.0);
      p.system.add_load = [](double t, std::span<double> f) { f[0] += std::sin(t); };
      if (is_nonlinear) p.system.nonlinear = std::make_shared<checks::CubicForce<model::any_dof>>();
      const double h = 0.125, m = p.system.mass(0, 0), c = p.system.damping(0, 0),
                   k = p.system.stiffness(0, 0);
      const double am = (2 * rho - 1) / (rho + 1), af = rho / (rho + 1), gamma = 0.5 - am + af,
                   beta = (1 - am + af) * (1 - am + af) / 4;
      const auto smooth = [&](double t, double u, double v) {
        const double p_uv = is_nonlinear ? u * u * u + 0.2 * u * u * v : 0.0;
        return (std::sin(t) - c * v - k * u - p_uv) / m;
      };
      const auto name = "nonsmooth-generalized-alpha:rho=" + std::to_string(rho);
      const auto [path, outcome] = run(name, p, h);
      double a0 = smooth(1.0, path.u[0], path.v[0]), s0 = a0;
      std::size_t impacts = 0;
      for (std::size_t n = 0; n + 1 < path.t.size(); ++n) {
        const double u0 = path.u[n], v0 = path.v[n], u1 = path.u[n + 1], v1 = path.v[n + 1];
        const double s1 = smooth(path.t[n + 1], u1, v1);
        const double a1 = ((1 - af) * s1 + af * s0 - am * a0) / (1 - am);
        const double w = v1 - v0 - h * ((1 - gamma) * a0 + gamma * a1);
        EXPECT_NEAR(u1, u0 + h * v0 + h * h * ((0.5 - beta) * a0 + beta * a1) + h / 2 * w, 1e-11);
        EXPECT_GE(w, -1e-11);
        if (w > 1e-9) {
          const auto& reported = path.impacts->at(impacts++);
          EXPECT_NEAR(reported.impulse, m * w, 1e-10);
          EXPECT_EQ(reported.t, path.t[n + 1]);
          EXPECT_EQ(reported.v_before[0], v0);
          EXPECT_NEAR(v1, -0.6 * v0, 1e-11);
        }
        a0 = a1;
        s0 = s1;
      }
      EXPECT_EQ(impacts, path.impacts->size());
      if (!is_nonlinear) {  // the response is that of the step: nothing is iterated
        EXPECT_EQ(outcome.work.force_evaluations, 1 + 80 + static_cast<long long>(impacts));
      }
      EXPECT_GE(impacts, 3u);
    }
}

// Damping that couples the modes makes the response not symmetric: the impulses are iterated.
TEST(NonsmoothGeneralizedAlpha, HoldsTheLawWithDampingThatCouplesModes) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector3d(1.0, 2.0, 0.5).asDiagonal();
  p.system.stiffness = Eigen::Vector3d(1.0, 30.0, 200.0).asDiagonal();
  p.system.damping = 4.0 * Eigen::MatrixXd::Ones(3, 3);
  p.contacts = {{Eigen::Vector3d(1, -1, 0), -0.1, 0.5}, {Eigen::Vector3d(0, 1, -1), -0.1, 0.8}};
  p.start = {0.0, Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-1, 0, 1.1)};
  p.end = 2.0;
  const auto [path, outcome] = run("nonsmooth-generalized-alpha", p, 0.1);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  ASSERT_GE(path.impacts->size(), 2u);
  for (const auto& impact : *path.impacts) {
    const auto& contact = p.contacts[std::size_t(impact.contact)];
    const Eigen::Map<const Eigen::Vector3d> before(impact.v_before.data()),
        after(impact.v_after.data());
    EXPECT_NEAR(contact.gap_rate(after), -contact.restitution * contact.gap_rate(before), 1e-10);
  }
}

TEST(NonsmoothGeneralizedAlpha, RefusesARadiusOutsideItsRange) {
  for (const auto* rho : {"-0.1", "1.1"})
    EXPECT_REFUSED(method(std::string("nonsmooth-generalized-alpha:rho=") + rho), "out-of-range",
                   "0 <= rho <= 1");
}

}  // namespace
}  // namespace clackers::methods
