#include "clackers/methods/integrators/generalized_alpha.hpp"

#include "clackers/base/error.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

TEST(GeneralizedAlpha, KeepsEveryClaim) {
  for (const double rho : {0.0, 0.5, 0.8, 1.0}) checks::keeps_every_claim(GeneralizedAlpha{rho});
}

TEST(GeneralizedAlpha, HasTheSpectralRadiusRhoAtInfiniteFrequency) {
  for (const double rho : {0.3, 0.8}) {
    const auto system = checks::oscillator();
    GeneralizedAlpha::Stepper<1> stepper({rho}, system, 1e6);
    model::State<1> now{0.0, model::Vector<1>(1.0), model::Vector<1>(0.0)};
    stepper.restart(now);
    const auto size_after = [&](int steps) {
      for (int i = 0; i < steps; ++i) stepper.step(now);
      return std::hypot(now.u[0], 1e6 * now.v[0]);
    };
    const double first = size_after(200), second = size_after(50);
    // The eigenvalue is defective: n rho^n, which adds a factor (250/200)^(2/50) < 1.01.
    EXPECT_NEAR(std::pow(second / first, 1.0 / 50), rho, 0.01);
  }
}

TEST(GeneralizedAlpha, StepsByItsFormula) {
  const auto problem = checks::Ramps<1>(1, 0.3);
  const GeneralizedAlpha method{0.6};
  const double h = 0.1, am = method.alpha_m(), af = method.alpha_f();
  EXPECT_NEAR(am, 0.2 / 1.6, 1e-16);
  EXPECT_NEAR(af, 0.6 / 1.6, 1e-16);
  GeneralizedAlpha::Stepper<1> stepper(method, problem.system, h);
  const model::State<1> x0 = problem.exact(1.0);
  model::State<1> x1 = x0;
  stepper.restart(x1);
  stepper.step(x1);
  const double m = problem.system.mass(0, 0), c = problem.system.damping(0, 0),
               k = problem.system.stiffness(0, 0);
  const auto load = [&](double t) {
    double f = 0.0;
    problem.system.add_load(t, {&f, 1});
    return f;
  };
  const double a0 = (load(1.0) - c * x0.v[0] - k * x0.u[0]) / m;
  // a1 from the update of v must satisfy that of u and the equation of motion.
  const double a1 = ((x1.v[0] - x0.v[0]) / h - (1 - method.gamma()) * a0) / method.gamma();
  EXPECT_NEAR(x1.u[0],
              x0.u[0] + h * x0.v[0] + h * h * ((0.5 - method.beta()) * a0 + method.beta() * a1),
              1e-14);
  EXPECT_NEAR(m * ((1 - am) * a1 + am * a0) + c * ((1 - af) * x1.v[0] + af * x0.v[0]) +
                  k * ((1 - af) * x1.u[0] + af * x0.u[0]),
              load(1.0 + (1 - af) * h), 1e-13);
}

TEST(GeneralizedAlpha, RefusesRhoOutsideItsRange) {
  for (const double rho : {-0.1, 1.1, double(NAN)})
    EXPECT_THROW(GeneralizedAlpha{rho}.validate(), InputError) << rho;
}

}  // namespace
}  // namespace clackers::methods
