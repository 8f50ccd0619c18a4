#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/one_step.hpp"

namespace clackers::methods {
namespace {

using checks::OneStep;
using checks::SingleSteps;

TEST(CentralDifference, GivesTheDisplacementsOfTheTwoStepForm) {
  const double h = 0.2, m = 2.0, c = 0.3, k = 5.0;
  using Number = model::Matrix<1>;
  const model::SmoothSystem<1> system{Number(m), Number(c), Number(k),
                                      [](double t, std::span<double> f) { f[0] += std::sin(t); }};
  model::State<1> now{1.0, model::Vector<1>(0.7), model::Vector<1>(-0.4)};
  SingleSteps<1> stepper("central-difference", system, h, now);
  const double a0 = (std::sin(1.0) - c * now.v[0] - k * now.u[0]) / m;
  double before = now.u[0] - h * now.v[0] + 0.5 * h * h * a0, u = now.u[0];
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

TEST(Newmark, KeepsTheEnergyOfAnUndampedMotionWithAverageAcceleration) {
  const auto system = checks::oscillator();
  auto now = checks::displaced();
  SingleSteps<1> stepper("newmark", system, 0.5, now);
  for (int i = 0; i < 1000; ++i) stepper.step(now);
  // A thousand steps of a few roundings each.
  EXPECT_NEAR(now.u.squaredNorm() + now.v.squaredNorm(), 1.0, 1000 * 8 * 0x1p-53);
}

TEST(Newmark, StepsByItsFormula) {
  const double h = 0.1, beta = 0.2, gamma = 0.7;
  const OneStep s("newmark:beta=0.2,gamma=0.7", h);
  EXPECT_NEAR(s.x1.u[0],
              s.x0.u[0] + h * s.x0.v[0] + h * h * ((0.5 - beta) * s.a(s.x0) + beta * s.a(s.x1)),
              1e-15);
  EXPECT_NEAR(s.x1.v[0], s.x0.v[0] + h * ((1 - gamma) * s.a(s.x0) + gamma * s.a(s.x1)), 1e-15);
}

TEST(GeneralizedAlpha, StepsByItsFormula) {
  const double h = 0.1, am = 0.2 / 1.6, af = 0.6 / 1.6, gamma = 0.5 - am + af,
               beta = 0.25 * (1 - am + af) * (1 - am + af);
  const OneStep s("generalized-alpha:rho=0.6", h);
  const auto& [x0, x1] = std::pair(s.x0, s.x1);
  const double a0 = s.a(x0);
  // a1 from the update of v must satisfy that of u and the equation of motion.
  const double a1 = ((x1.v[0] - x0.v[0]) / h - (1 - gamma) * a0) / gamma;
  EXPECT_NEAR(x1.u[0], x0.u[0] + h * x0.v[0] + h * h * ((0.5 - beta) * a0 + beta * a1), 1e-14);
  EXPECT_NEAR(s.m * ((1 - am) * a1 + am * a0) + s.c * ((1 - af) * x1.v[0] + af * x0.v[0]) +
                  s.k * ((1 - af) * x1.u[0] + af * x0.u[0]),
              s.load(1.0 + (1 - af) * h), 1e-13);
}

TEST(AlphaMethods, HaveTheSpectralRadiusThatTheirParameterSays) {
  const auto radius = [](const char* text) { return integrator(text)->facts().radius_at_infinity; };
  // A double root is good to the square root of rounding.
  EXPECT_NEAR(radius("generalized-alpha:rho=0.7"), 0.7, 1e-7);
  EXPECT_NEAR(radius("wbz-alpha:rho=0.7"), 0.7, 1e-7);
  EXPECT_NEAR(radius("hht-alpha:alpha=-0.2"), 0.8 / 1.2, 1e-7);
  EXPECT_NEAR(radius("dissipative-newmark:gamma=0.8"), 0.7 / 1.3, 1e-7);
  EXPECT_NEAR(radius("newmark"), 1.0, 1e-15);
  EXPECT_TRUE(std::isnan(radius("newmark:beta=0.1")));
}

TEST(AlphaMethods, RefuseParametersOutsideTheirRange) {
  for (const auto* text :
       {"newmark:beta=-0.1", "newmark:beta=0.51", "newmark:gamma=0.4", "newmark:gamma=1.1",
        "generalized-alpha:rho=-0.1", "generalized-alpha:rho=1.1"})
    EXPECT_THROW(integrator(text), InputError) << text;
  EXPECT_NO_THROW(integrator("newmark:beta=0.5,gamma=1"));
  EXPECT_REFUSED(
      integrator("newmark:gamma=0.4"), "out-of-range",
      "newmark: gamma = 0.4; allowed: 1/2 <= gamma <= 1. Below 1/2 undamped motion grows "
      "at every step size; use gamma = 0.5 for no numerical dissipation.");
}

TEST(Newmark, RefusesASystemItCannotStep) {
  auto system = checks::oscillator();
  system.stiffness(0, 0) = -100.0;  // 1 - h²/4 100 < 0
  const auto newmark = integrator("newmark");
  EXPECT_THROW(newmark->stepper(system, checks::endless(0.0, 0.5)), InputError);
  EXPECT_NO_THROW(newmark->stepper(system, checks::endless(0.0, 0.1)));
}

// p = -3 |u|^(1/3) sign(u): its slope at 0 is infinite, where Newton's iteration never settles.
struct Cusp : model::NonlinearForce<1> {
  void add(const model::Vector<1>& u, const model::Vector<1>&, model::Vector<1>& p) const override {
    p[0] += 1e6 * std::cbrt(u[0]);
  }
  void add_tangent(const model::Vector<1>& u, const model::Vector<1>&, model::Matrix<1>& du,
                   model::Matrix<1>&) const override {
    du(0, 0) += 1e6 / 3.0 * std::pow(std::abs(u[0]), -2.0 / 3);
  }
};

TEST(Newmark, TellsWhenNewtonsIterationFails) {
  auto system = checks::oscillator();
  system.nonlinear = std::make_shared<Cusp>();
  auto now = checks::displaced();
  SingleSteps<1> stepper("newmark", system, 1.0, now);
  for (int i = 0; i < 5 && !stepper->failed(); ++i) stepper.step(now);
  EXPECT_TRUE(stepper->failed());
  stepper->reset();
  EXPECT_FALSE(stepper->failed());
}

TEST(Newmark, CountsItsWork) {
  const checks::Ramps<2> linear(2, 0.3);
  const checks::Cubic<1> cubic(1);
  model::State<2> x = linear.exact(1.0);
  model::State<1> y = cubic.exact(1.0);
  SingleSteps<2> one("newmark", linear.system, 0.1, x);
  SingleSteps<1> other("newmark", cubic.system, 0.1, y);
  one->reset();
  other->reset();
  one->restart(x);
  other->restart(y);
  for (int i = 0; i < 10; ++i) {
    one.step(x);
    other.step(y);
  }
  one->partial(x, 0.05);
  model::Work linear_work, cubic_work;
  one->add_work(linear_work);
  other->add_work(cubic_work);
  EXPECT_EQ(linear_work.force_evaluations, 12);
  EXPECT_EQ(linear_work.factorizations, 1);
  EXPECT_EQ(linear_work.newton_iterations, 0);
  EXPECT_GE(cubic_work.newton_iterations, 20);
  EXPECT_LE(cubic_work.newton_iterations, 60);
}

}  // namespace
}  // namespace clackers::methods
