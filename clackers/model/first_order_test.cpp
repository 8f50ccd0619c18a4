#include "clackers/model/first_order.hpp"

#include <gtest/gtest.h>

#include <array>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::model {
namespace {

using Values = std::array<double, 4>;

// p = 3 u^3 of each mass.
struct Cubic : NonlinearForce<any_dof> {
  using Vector = model::Vector<any_dof>;
  void add(const Vector& u, const Vector&, Vector& p) const override {
    p.array() += 3.0 * u.array().cube();
  }
  void add_tangent(const Vector&, const Vector&, Matrix<any_dof>&,
                   Matrix<any_dof>&) const override {}
};

ImpactProblem<> coupled() {
  ImpactProblem<> p;
  p.system.mass = Eigen::MatrixXd(2, 2);
  p.system.mass << 2.0, 0.5, 0.5, 1.0;
  p.system.damping = Eigen::MatrixXd(2, 2);
  p.system.damping << 0.5, -0.25, -0.25, 1.0;
  p.system.stiffness = Eigen::MatrixXd(2, 2);
  p.system.stiffness << 4.0, -1.0, -1.0, 3.0;
  p.contacts = {{Eigen::Vector2d(1.0, -1.0), -0.25, 0.5}, {Eigen::Vector2d(0.0, 2.0), -3.0, 0.0}};
  p.start = {0.0, Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 0.0)};
  p.end = 1.0;
  return p;
}

constexpr Values state{1.0, -2.0, 3.0, -1.0};  // u1 u2 v1 v2

// M a + C v + K u + p - f, which rate() must make zero.
Eigen::Vector2d residual(const ImpactProblem<>& p, double t, const Values& y) {
  Values rate;
  FirstOrder(p).rate(t, y, rate);
  const Eigen::Vector2d u(y[0], y[1]), v(y[2], y[3]), a(rate[2], rate[3]);
  EXPECT_EQ(rate[0], y[2]);
  EXPECT_EQ(rate[1], y[3]);
  Eigen::VectorXd rest = p.system.mass * a + p.system.damping * v + p.system.stiffness * u;
  std::array<double, 2> load{0.0, 0.0};
  if (p.system.add_load) p.system.add_load(t, load);
  if (p.system.nonlinear) p.system.nonlinear->add(u, v, rest);
  return rest - Eigen::Vector2d(load[0], load[1]);
}

TEST(FirstOrder, RateFulfilsTheEquationOfMotion) {
  auto p = coupled();
  // Terms up to 24 N, about ten roundings: 24 x 10 x 1.1e-16 = 3e-14.
  EXPECT_LT(residual(p, 0.5, state).norm(), 3e-14);
  p.system.add_load = [](double t, std::span<double> f) { f[0] += 7.0 * t, f[1] += 5.0; };
  EXPECT_LT(residual(p, 0.5, state).norm(), 3e-14);
  p.system.nonlinear = std::make_shared<Cubic>();
  EXPECT_LT(residual(p, 0.5, state).norm(), 3e-14);
}

TEST(FirstOrder, GapIsThatOfTheContact) {
  const auto p = coupled();
  EXPECT_EQ(FirstOrder(p).gap(state, 0), 3.25);
  EXPECT_EQ(FirstOrder(p).gap(state, 1), -1.0);
}

TEST(FirstOrder, ImpactFollowsNewtonsLawAndNeedsAnImpulseAlongTheContact) {
  const auto p = coupled();
  const Values closing{1.0, 1.25, -1.0, 2.0};
  Values after;
  FirstOrder(p).impact(closing, 0, after);
  EXPECT_EQ(after[0], closing[0]);
  EXPECT_EQ(after[1], closing[1]);
  EXPECT_NEAR(after[2] - after[3], -0.5 * (closing[2] - closing[3]), 1e-15);
  const Eigen::Vector2d impulse =
      p.system.mass * Eigen::Vector2d(after[2] - closing[2], after[3] - closing[3]);
  EXPECT_NEAR(impulse[0], -impulse[1], 1e-15);
  EXPECT_GT(impulse[0], 1.0);
}

TEST(FirstOrder, ImpactWithoutANumberIsAtTheNearestContact) {
  const auto p = coupled();
  const Values at_second{5.0, -1.5, 1.0, -1.0};
  Values after;
  FirstOrder(p).impact(at_second, std::nullopt, after);
  EXPECT_NEAR(after[3], 0.0, 1e-15);  // restitution 0
  const Values at_first{-3.0, -2.75, -1.0, 1.0};
  FirstOrder(p).impact(at_first, std::nullopt, after);
  EXPECT_NEAR(after[2] - after[3], 1.0, 1e-15);
}

TEST(FirstOrder, ImpactAtRestChangesNothing) {
  const auto p = coupled();
  const Values rest{1.0, 1.25, 1.0, 1.0};
  Values after;
  FirstOrder(p).impact(rest, 0, after);
  EXPECT_EQ(after, rest);
}

TEST(FirstOrder, RefusesAContactThatOpensOrIsNotThere) {
  auto p = coupled();
  Values after;
  EXPECT_REFUSED(FirstOrder(p).impact(state, 0, after), "out-of-range", "b . v = 4");
  EXPECT_REFUSED(FirstOrder(p).gap(state, 2), "out-of-range", "contact = 2", "contact <= 1");
  p.contacts.clear();
  EXPECT_REFUSED(FirstOrder(p).impact(state, std::nullopt, after), "out-of-range", "no contact");
}

TEST(FirstOrder, RefusesTheRateOfDryFriction) {
  auto p = coupled();
  p.frictions = {{Eigen::Vector2d(1.0, 0.0), 1.0, 0.5, 0.0}};
  Values rate;
  EXPECT_REFUSED(FirstOrder(p).rate(0.0, state, rate), "linear-only", "dry friction");
  EXPECT_EQ(FirstOrder(p).gap(state, 0), 3.25);
}

}  // namespace
}  // namespace clackers::model
