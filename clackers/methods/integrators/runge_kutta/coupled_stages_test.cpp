// What the facts of methods with coupled stages, and of the energy-momentum method, do not state.

#include "clackers/methods/testing/one_step.hpp"

namespace clackers::methods {
namespace {

using checks::OneStep;

TEST(Radau, CollocatesAtItsStages) {
  // Two stages: v_i = v0 + h A_ij a_j; the last one is the end of the step.
  const double h = 0.2;
  const OneStep s("radau-iia-3", h);
  const double t0 = s.x0.t, u0 = s.x0.u[0], v0 = s.x0.v[0], a2 = s.a(s.x1);
  const double a1 = (4.0 * (s.x1.v[0] - v0) / h - a2) / 3.0;
  const double v1 = v0 + h * (5.0 * a1 - a2) / 12.0;
  const double u1 = u0 + h * (5.0 * v1 - s.x1.v[0]) / 12.0;
  EXPECT_NEAR(s.a(t0 + h / 3.0, u1, v1), a1, 1e-12);
  EXPECT_NEAR(s.x1.u[0], u0 + h * (3.0 * v1 + s.x1.v[0]) / 4.0, 1e-14);
}

// With p = 0 as a force that the compiler does not see, Newton's iteration gives the linear step.
struct NoForce : model::NonlinearForce<1> {
  using V = model::Vector<1>;
  using M = model::Matrix<1>;
  void add(const V&, const V&, V&) const override {}
  void add_tangent(const V&, const V&, M&, M&) const override {}
};

TEST(Radau, StepsAlikeByTheMapAndByNewton) {
  checks::Ramps<1> problem(1, 0.3);
  for (const auto* name : {"radau-iia-3", "radau-iia-5"}) {
    auto one = problem.exact(1.0), other = one;
    problem.system.nonlinear = nullptr;
    checks::SingleSteps<1>(name, problem.system, 0.3, one).step(one);
    problem.system.nonlinear = std::make_shared<NoForce>();
    checks::SingleSteps<1>(name, problem.system, 0.3, other).step(other);
    EXPECT_NEAR(one.u[0], other.u[0], 1e-14) << name;
    EXPECT_NEAR(one.v[0], other.v[0], 1e-14) << name;
  }
}

// u = exp(-c t/2) (...) of a free mass of any stiffness, whatever the step; at rest and drifting too.
TEST(ExactFlow, IsExactForFreeMotionWithAnyStep) {
  using Number = model::Matrix<1>;
  for (const auto* name : {"precise-integration", "exponential"})
    for (const double k : {0.0, 1.0, 1e4})
      for (const double h : {0.01, 0.7, 25.0}) {
        const double c = 0.1, s = -0.5 * c, w = std::sqrt(std::abs(k - 0.25 * c * c));
        const model::SmoothSystem<1> system{Number(2.0), Number(2.0 * c), Number(2.0 * k)};
        model::State<1> x{0.0, model::Vector<1>(0.4), model::Vector<1>(-0.3)};
        checks::SingleSteps<1>(name, system, h, x).step(x);
        const double u =
            k > 0.0
                ? std::exp(s * h) * (0.4 * std::cos(w * h) + (-0.3 - 0.4 * s) / w * std::sin(w * h))
                : 0.4 - 0.3 / c * (1.0 - std::exp(-c * h));
        EXPECT_NEAR(x.u[0], u, 1e-14 * (1.0 + w * h)) << name << ", k = " << k << ", h = " << h;
      }
}

TEST(ExactFlow, IsExactUnderALoadThatIsALineByTheLineAlone) {
  const checks::Ramps<2> problem(2, 0.3);
  const auto error = [&](const char* name) {
    auto x = problem.exact(1.0);
    checks::SingleSteps<2>(name, problem.system, 2.0, x).step(x);
    return (x.u - problem.exact(3.0).u).norm();
  };
  EXPECT_LT(error("exponential"), 1e-14);
  EXPECT_GT(error("precise-integration"), 1e-4);
}

// G = u^4/4: Gauss' four points are exact for p = u^3.
struct Quartic : model::NonlinearForce<1> {
  using V = model::Vector<1>;
  using M = model::Matrix<1>;
  void add(const V& u, const V&, V& p) const override { p += u.cwiseProduct(u).cwiseProduct(u); }
  void add_tangent(const V& u, const V&, M& du, M&) const override {
    du(0, 0) += 3.0 * u[0] * u[0];
  }
};

double energy_change(const std::string& name, const model::SmoothSystem<1>& system, double h,
                     double potential(double)) {
  model::State<1> x{0.0, model::Vector<1>(1.5), model::Vector<1>(0.0)};
  checks::SingleSteps<1> stepper(name, system, h, x);
  const auto energy = [&] {
    return 0.5 * x.v.squaredNorm() + 0.5 * system.stiffness(0, 0) * x.u.squaredNorm() +
           potential(x.u[0]);
  };
  const double before = energy();
  double worst = 0.0;
  for (int i = 0; i < 500; ++i) {
    stepper.step(x);
    worst = std::max(worst, std::abs(energy() - before));
  }
  EXPECT_FALSE(stepper->failed());
  return worst / before;
}

TEST(EnergyMomentum, ConservesTheEnergyOfAPolynomialForce) {
  auto system = checks::oscillator();
  system.nonlinear = std::make_shared<Quartic>();
  const auto quartic = [](double u) { return 0.25 * u * u * u * u; };
  EXPECT_LT(energy_change("energy-momentum", system, 0.5, quartic), 1e-12);
  EXPECT_GT(energy_change("average-acceleration", system, 0.5, quartic), 1e-3);
}

struct Pendulum : Quartic {
  void add(const V& u, const V&, V& p) const override { p[0] += std::sin(u[0]); }
  void add_tangent(const V& u, const V&, M& du, M&) const override { du(0, 0) += std::cos(u[0]); }
};

TEST(EnergyMomentum, ConservesTheEnergyOfAPendulumToTheOrderOfItsQuadrature) {
  auto system = checks::oscillator();
  system.stiffness(0, 0) = 0.0;
  system.nonlinear = std::make_shared<Pendulum>();
  const auto potential = [](double u) { return 1.0 - std::cos(u); };
  EXPECT_LT(energy_change("energy-momentum", system, 0.1, potential), 1e-12);
  const double coarse = energy_change("energy-momentum", system, 1.6, potential),
               fine = energy_change("energy-momentum", system, 0.8, potential);
  EXPECT_NEAR(std::log2(coarse / fine), 8.0, 2.0);
}

TEST(EnergyMomentum, IsAverageAccelerationInLinearMotion) {
  const OneStep one("energy-momentum", 0.2, 10), other("average-acceleration", 0.2, 10);
  EXPECT_NEAR(one.path.back().u[0], other.path.back().u[0], 1e-14);
  EXPECT_NEAR(one.path.back().v[0], other.path.back().v[0], 1e-14);
}

}  // namespace
}  // namespace clackers::methods
