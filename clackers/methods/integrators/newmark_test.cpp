#include "clackers/methods/integrators/newmark.hpp"

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

TEST(Newmark, KeepsEveryClaimOverTheFamily) {
  for (const auto& method :
       {Newmark{.beta = 0.25, .gamma = 0.5}, Newmark{.beta = 0.0, .gamma = 0.5},
        Newmark{.beta = 1.0 / 12, .gamma = 0.5}, Newmark{.beta = 1.0 / 6, .gamma = 0.5}})
    checks::keeps_every_claim(method);
}

TEST(Newmark, KeepsItsClaimsWithGammaAboveOneHalf) {
  // First order shows late: the error constant of second order is larger.
  const Newmark damped{.beta = 0.3025, .gamma = 0.6}, conditional{.beta = 0.2, .gamma = 0.55};
  checks::converges_at_the_order_it_claims(damped, 1.0 / 512);
  checks::is_stable_exactly_where_it_claims(damped);
  checks::is_stable_exactly_where_it_claims(conditional);
}

TEST(Newmark, KeepsTheEnergyOfAnUndampedMotionWithAverageAcceleration) {
  const auto system = checks::oscillator();
  Newmark::Stepper<1> stepper({}, system, 0.5);
  model::State<1> now{0.0, model::Vector<1>(1.0), model::Vector<1>(0.0)};
  stepper.restart(now);
  for (int i = 0; i < 1000; ++i) stepper.step(now);
  // A thousand steps of a few roundings each.
  EXPECT_NEAR(now.u.squaredNorm() + now.v.squaredNorm(), 1.0, 1000 * 8 * 0x1p-53);
}

TEST(Newmark, StepsByItsFormula) {
  const auto system = checks::Ramps<1>(1, 0.3);
  const double h = 0.1, beta = 0.2, gamma = 0.7;
  Newmark::Stepper<1> stepper({.beta = beta, .gamma = gamma}, system.system, h);
  const model::State<1> x0 = system.exact(1.0);
  model::State<1> x1 = x0;
  stepper.restart(x1);
  stepper.step(x1);
  const double m = system.system.mass(0, 0), c = system.system.damping(0, 0),
               k = system.system.stiffness(0, 0);
  const auto a = [&](const model::State<1>& x) {
    double f = 0.0;
    system.system.add_load(x.t, {&f, 1});
    return (f - c * x.v[0] - k * x.u[0]) / m;
  };
  EXPECT_NEAR(x1.u[0], x0.u[0] + h * x0.v[0] + h * h * ((0.5 - beta) * a(x0) + beta * a(x1)),
              1e-15);
  EXPECT_NEAR(x1.v[0], x0.v[0] + h * ((1 - gamma) * a(x0) + gamma * a(x1)), 1e-15);
}

TEST(Newmark, RefusesParametersOutsideTheirRange) {
  for (const double beta : {-0.1, 0.51, double(NAN)})
    EXPECT_THROW((Newmark{.beta = beta, .gamma = 0.5}.validate()), InputError) << beta;
  for (const double gamma : {0.4, 1.1, double(NAN)})
    EXPECT_THROW((Newmark{.beta = 0.25, .gamma = gamma}.validate()), InputError) << gamma;
  EXPECT_NO_THROW((Newmark{.beta = 0.5, .gamma = 1.0}.validate()));
  EXPECT_REFUSED(
      (Newmark{.beta = 0.25, .gamma = 0.4}.validate()), "out-of-range",
      "newmark: gamma = 0.4; allowed: 1/2 <= gamma <= 1. Below 1/2 undamped motion grows "
      "at every step size; use gamma = 0.5 for no numerical dissipation.");
}

TEST(Newmark, RefusesAStepAndASystemItCannotStep) {
  auto system = checks::oscillator();
  for (const double h : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(Newmark::Stepper<1>({}, system, h), InputError) << h;
  system.stiffness(0, 0) = -100.0;  // 1 - h²/4 100 < 0
  EXPECT_THROW(Newmark::Stepper<1>({}, system, 0.5), InputError);
  EXPECT_NO_THROW(Newmark::Stepper<1>({}, system, 0.1));
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
  Newmark::Stepper<1> stepper({}, system, 1.0);
  model::State<1> now{0.0, model::Vector<1>(1.0), model::Vector<1>(0.0)};
  stepper.restart(now);
  for (int i = 0; i < 5 && !stepper.failed(); ++i) stepper.step(now);
  EXPECT_TRUE(stepper.failed());
  stepper.reset();
  EXPECT_FALSE(stepper.failed());
}

TEST(Newmark, CountsItsWork) {
  const checks::Ramps<2> linear(2, 0.3);
  const checks::Cubic<1> cubic(1);
  Newmark::Stepper<2> one({}, linear.system, 0.1);
  Newmark::Stepper<1> other({}, cubic.system, 0.1);
  model::State<2> x = linear.exact(1.0);
  model::State<1> y = cubic.exact(1.0);
  one.reset();
  other.reset();
  one.restart(x);
  other.restart(y);
  for (int i = 0; i < 10; ++i) {
    one.step(x);
    other.step(y);
  }
  one.partial(x, 0.05);
  model::Work linear_work, cubic_work;
  one.add_work(linear_work);
  other.add_work(cubic_work);
  EXPECT_EQ(linear_work.force_evaluations, 12);
  EXPECT_EQ(linear_work.factorizations, 1);
  EXPECT_EQ(linear_work.newton_iterations, 0);
  EXPECT_GE(cubic_work.newton_iterations, 20);
  EXPECT_LE(cubic_work.newton_iterations, 60);
}

}  // namespace
}  // namespace clackers::methods
