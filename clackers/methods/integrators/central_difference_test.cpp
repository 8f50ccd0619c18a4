#include "clackers/methods/integrators/central_difference.hpp"

#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

TEST(CentralDifference, KeepsEveryClaim) { checks::keeps_every_claim(CentralDifference{}); }

TEST(CentralDifference, GivesTheDisplacementsOfTheTwoStepForm) {
  const double h = 0.2, m = 2.0, c = 0.3, k = 5.0;
  using Number = model::Matrix<1>;
  const model::SmoothSystem<1> system{Number(m), Number(c), Number(k),
                                      [](double t, std::span<double> f) { f[0] += std::sin(t); }};
  CentralDifference::Stepper<1> stepper({}, system, h);
  model::State<1> now{1.0, model::Vector<1>(0.7), model::Vector<1>(-0.4)};
  const double a0 = (std::sin(1.0) - c * now.v[0] - k * now.u[0]) / m;
  double before = now.u[0] - h * now.v[0] + 0.5 * h * h * a0, u = now.u[0];
  stepper.restart(now);
  for (int i = 0; i < 50; ++i) {
    const double next =
        (std::sin(1.0 + i * h) - k * u + m * (2 * u - before) / (h * h) + c * before / (2 * h)) /
        (m / (h * h) + c / (2 * h));
    before = u;
    u = next;
    stepper.step(now);
    EXPECT_NEAR(now.u[0], u, 1e-13);  // 50 steps of some ten roundings of numbers below 2
  }
}

}  // namespace
}  // namespace clackers::methods
