// Steps of one mass with damping and load against the formulas of the cards, where orders, limits
// and radii alone do not fix them.

#include "clackers/methods/testing/one_step.hpp"

namespace clackers::methods {
namespace {

using checks::OneStep;

constexpr double h = 0.1;
constexpr double rounding = 1e-13;  // some ten of numbers below 4, divided by h

TEST(Collocation, BalancesAtTheEndOfTheWideStep) {
  for (const auto& [name, theta, beta] :
       {std::tuple("wilson-theta", 1.4, 1.0 / 6), std::tuple("collocation", 1.1, 0.24)}) {
    const OneStep s(name, h);
    const double u0 = s.x0.u[0], v0 = s.x0.v[0], a0 = s.a(s.x0), wide = theta * h;
    const double a1 = 2.0 * (s.x1.v[0] - v0) / h - a0, a = a0 + theta * (a1 - a0);
    EXPECT_NEAR(s.x1.u[0], u0 + h * v0 + h * h * ((0.5 - beta) * a0 + beta * a1), rounding);
    const double u = u0 + wide * v0 + wide * wide * ((0.5 - beta) * a0 + beta * a),
                 v = v0 + 0.5 * wide * (a0 + a);
    const double load = (1.0 - theta) * s.load(s.x0.t) + theta * s.load(s.x0.t + h);
    EXPECT_NEAR(s.m * a + s.c * v + s.k * u, load, 100 * rounding) << name;
  }
}

// Roots of the characteristic polynomial, by Durand and Kerner's iteration in another program.
TEST(Collocation, HasTheSpectralRadiusOfItsStep) {
  const auto radius = [](const char* text) { return integrator(text)->facts().radius_at_infinity; };
  EXPECT_NEAR(radius("wilson-theta:theta=1.42"), 0.56428, 5e-6);
  EXPECT_NEAR(radius("wilson-theta:theta=2"), 0.63431, 5e-6);
  EXPECT_NEAR(radius("wilson-theta:theta=1.3661"), 0.99955, 5e-6);
  EXPECT_NEAR(radius("collocation:theta=1.1,beta=0.24"), 0.97765, 5e-6);
}

TEST(VelocityVerlet, PredictsTheVelocityOfDamping) {
  const OneStep s("velocity-verlet", h);
  const double a0 = s.a(s.x0), u1 = s.x0.u[0] + h * s.x0.v[0] + 0.5 * h * h * a0;
  EXPECT_NEAR(s.x1.u[0], u1, rounding);
  EXPECT_NEAR(s.x1.v[0], s.x0.v[0] + 0.5 * h * (a0 + s.a(s.x0.t + h, u1, s.x0.v[0] + h * a0)),
              rounding);
}

TEST(ExplicitGeneralizedAlpha, BalancesAtTheStart) {
  const double rho = 0.6, am = (2 * rho - 1) / (1 + rho), gamma = 1.5 - am,
               beta = (5 - 3 * rho) / ((1 + rho) * (1 + rho) * (2 - rho));
  const OneStep s("explicit-generalized-alpha:rho=0.6", h, 2);
  double a = s.a(s.x0);
  for (int i = 0; i < 2; ++i) {
    const auto &x = s.path[std::size_t(i)], &y = s.path[std::size_t(i) + 1];
    const double next = (s.a(x) - am * a) / (1 - am);
    EXPECT_NEAR(y.u[0], x.u[0] + h * x.v[0] + h * h * ((0.5 - beta) * a + beta * next), rounding);
    EXPECT_NEAR(y.v[0], x.v[0] + h * ((1 - gamma) * a + gamma * next), rounding);
    a = next;
  }
}

TEST(TchamwaWielgosz, StepsByItsFormula) {
  const OneStep s("tchamwa-wielgosz:phi=1.2", h, 2);
  for (int i = 0; i < 2; ++i) {
    const auto &x = s.path[std::size_t(i)], &y = s.path[std::size_t(i) + 1];
    EXPECT_NEAR(y.u[0], x.u[0] + h * x.v[0] + 1.2 * h * h * s.a(x), rounding);
    EXPECT_NEAR(y.v[0], x.v[0] + h * s.a(x), rounding);
  }
}

TEST(NohBathe, StepsByItsFormula) {
  const double p = 0.54, r = 1 - p, q1 = (1 - 2 * p) / (2 * p * r), q2 = 0.5 - p * q1,
               q0 = 0.5 - q1 - q2;
  const OneStep s("noh-bathe", h);
  const double u0 = s.x0.u[0], v0 = s.x0.v[0], t0 = s.x0.t, a0 = s.a(s.x0);
  const double up = u0 + p * h * v0 + 0.5 * p * p * h * h * a0,
               ap = s.a(t0 + p * h, up, v0 + p * h * a0), vp = v0 + 0.5 * p * h * (a0 + ap),
               u1 = up + r * h * vp + 0.5 * r * r * h * h * ap,
               a1 = s.a(t0 + h, u1, vp + r * h * ap);
  EXPECT_NEAR(s.x1.u[0], u1, rounding);
  EXPECT_NEAR(s.x1.v[0], vp + r * h * (q0 * a0 + (0.5 + q1) * ap + q2 * a1), rounding);
}

TEST(Chang, StepsByItsFormula) {
  const OneStep s("chang", h);
  const double a0 = s.a(s.x0), d = s.m + 0.5 * h * s.c + 0.25 * h * h * s.k;
  EXPECT_NEAR(s.x1.u[0],
              s.x0.u[0] + ((s.m + 0.5 * h * s.c) * h * s.x0.v[0] + 0.5 * h * h * s.m * a0) / d,
              rounding);
  EXPECT_NEAR(s.x1.v[0], s.x0.v[0] + 0.5 * h * (a0 + s.a(s.x1)), rounding);
}

TEST(KrAlpha, StepsByItsFormula) {
  const double rho = 0.5, am = 0.0, af = 1.0 / 3, gamma = 0.5 - am + af, beta = 1 / (1.5 * 1.5);
  const OneStep s("kr-alpha", h, 2);
  ASSERT_EQ(rho, 0.5);
  const double damping = gamma * h * s.c, stiffness = beta * h * h * s.k,
               d = s.m + damping + stiffness, a3 = (am * s.m + af * (damping + stiffness)) / d;
  double a = s.a(s.x0);
  for (int i = 0; i < 2; ++i) {
    const auto &x = s.path[std::size_t(i)], &y = s.path[std::size_t(i) + 1];
    EXPECT_NEAR(y.v[0], x.v[0] + h * s.m / d * a, rounding);
    EXPECT_NEAR(y.u[0], x.u[0] + h * x.v[0] + h * h * (0.5 + gamma) * s.m / d * a, rounding);
    const double balance =
        s.a(x.t + (1 - af) * h, (1 - af) * y.u[0] + af * x.u[0], (1 - af) * y.v[0] + af * x.v[0]);
    a = (balance - a3 * a) / (1 - a3);
  }
}

TEST(Cr, IsKrAlphaWithoutDissipation) {
  const OneStep one("cr", h, 5), other("kr-alpha:rho=1", h, 5);
  EXPECT_EQ(one.path.back().u, other.path.back().u);
  EXPECT_EQ(one.path.back().v, other.path.back().v);
}

TEST(Multistep, DifferentiatesItsHistory) {
  const auto by = [](const std::vector<double>& weights, const auto& path, auto&& entry) {
    double sum = 0.0;
    for (std::size_t j = 0; j < weights.size(); ++j)
      sum += weights[j] * entry(path[path.size() - 1 - j]);
    return sum;
  };
  const auto u = [](const auto& x) { return x.u[0]; };
  const auto v = [](const auto& x) { return x.v[0]; };
  const OneStep houbolt("houbolt", h, 5);
  const auto& end = houbolt.path.back();
  EXPECT_NEAR(by({11. / 6, -3, 1.5, -1. / 3}, houbolt.path, u) / h, end.v[0], 10 * rounding);
  EXPECT_NEAR(by({2, -5, 4, -1}, houbolt.path, u) / (h * h), houbolt.a(end), 1000 * rounding);
  for (const auto& [name, weights] :
       {std::pair("park", std::vector<double>{10. / 6, -2.5, 1, -1. / 6}),
        std::pair("bdf2", std::vector<double>{1.5, -2, 0.5}),
        std::pair("bdf4", std::vector<double>{25. / 12, -4, 3, -4. / 3, 0.25})}) {
    const OneStep s(name, h, 6);
    EXPECT_NEAR(by(weights, s.path, u) / h, s.path.back().v[0], 10 * rounding) << name;
    EXPECT_NEAR(by(weights, s.path, v) / h, s.a(s.path.back()), 100 * rounding) << name;
  }
}

}  // namespace
}  // namespace clackers::methods
