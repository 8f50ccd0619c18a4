#include "clackers/methods/contact/constrained_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

constexpr std::array<std::size_t, 1> first{0};

// Two masses on springs of their own, a load on each, contact u1 - u2 >= 0.3. Held together they
// are one mass on both springs.
template <int Dof>
model::ImpactProblem<Dof> two_masses() {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector2d(2.0, 3.0).asDiagonal();
  p.system.damping = Eigen::Vector2d(0.1, 0.2).asDiagonal();
  p.system.stiffness = Eigen::Vector2d(4.0, 5.0).asDiagonal();
  p.system.add_load = [](double t, std::span<double> f) {
    f[0] += std::sin(t);
    f[1] -= 2.0 * t;
  };
  p.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.3, 0.0}};
  p.start = {1.0, Eigen::Vector2d(0.7, 0.4), Eigen::Vector2d(-0.5, -0.5)};
  p.end = 3.0;
  return model::with_dof<Dof>(p);
}

template <int Dof>
void moves_as_one_mass() {
  const auto problem = two_masses<Dof>();
  ContactSet<Dof> contacts(problem);
  ConstrainedSystem<Dof> constrained(problem.system, contacts);
  EXPECT_FALSE(constrained.is_any_active());
  constrained.activate(first, problem.start.u);
  EXPECT_TRUE(constrained.is_active(0) && constrained.is_any_active());

  using Number = model::Matrix<1>;
  const model::SmoothSystem<1> one{Number(5.0), Number(0.3), Number(9.0),
                                   [](double t, std::span<double> f) {
                                     f[0] += std::sin(t) - 2.0 * t - 4.0 * 0.3;  // k1 (u2 + gap)
                                   }};
  auto now = problem.start;
  model::State<1> other{1.0, model::Vector<1>(0.4), model::Vector<1>(-0.5)};
  checks::SingleSteps<Dof> stepper("rk4", constrained.system(), 0.01, now);
  checks::SingleSteps<1> reference("rk4", one, 0.01, other);
  for (int i = 0; i < 200; ++i) {
    stepper.step(now);
    reference.step(other);
  }
  // 200 steps of some ten roundings of numbers below 4.
  EXPECT_NEAR(now.u[0] - now.u[1], 0.3, 1e-13);
  EXPECT_NEAR(now.u[1], other.u[0], 1e-13);
  EXPECT_NEAR(now.v[1], other.v[0], 1e-13);

  // The force is what mass 1 needs to accelerate with the other.
  const double a = (std::sin(3.0) - 6.0 - 1.2 - 0.3 * now.v[1] - 9.0 * now.u[1]) / 5.0;
  EXPECT_NEAR(constrained.contact_forces(now)[0],
              2.0 * a + 0.1 * now.v[0] + 4.0 * now.u[0] - std::sin(3.0), 1e-11);
  constrained.activate({}, now.u);
  EXPECT_FALSE(constrained.is_any_active());
}

TEST(ConstrainedSystem, MovesTwoMassesAsOne) {
  moves_as_one_mass<2>();
  moves_as_one_mass<model::any_dof>();
}

// Three masses that hold together: one mass on all springs. Their rows are coupled.
TEST(ConstrainedSystem, MovesThreeMassesAsOne) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector3d(2.0, 3.0, 0.5).asDiagonal();
  p.system.damping = 0.1 * Eigen::Matrix3d::Identity();
  p.system.stiffness = Eigen::Vector3d(4.0, 5.0, 6.0).asDiagonal();
  p.system.add_load = [](double t, std::span<double> f) { f[2] -= std::sin(t); };
  p.contacts = {{Eigen::Vector3d(1, -1, 0), 0.3, 0.0}, {Eigen::Vector3d(0, 1, -1), 0.0, 0.0}};
  p.start = {1.0, Eigen::Vector3d(0.7, 0.4, 0.4), Eigen::Vector3d(-0.5, -0.5, -0.5)};
  p.end = 3.0;
  ContactSet<model::any_dof> contacts(p);
  ConstrainedSystem<model::any_dof> constrained(p.system, contacts);
  constrained.activate(std::array<std::size_t, 2>{0, 1}, p.start.u);
  using Number = model::Matrix<1>;
  const model::SmoothSystem<1> one{
      Number(5.5), Number(0.3), Number(15.0),
      [](double t, std::span<double> f) { f[0] -= std::sin(t) + 4.0 * 0.3; }};
  auto now = p.start;
  model::State<1> other{1.0, model::Vector<1>(0.4), model::Vector<1>(-0.5)};
  checks::SingleSteps<model::any_dof> stepper("rk4", constrained.system(), 0.01, now);
  checks::SingleSteps<1> reference("rk4", one, 0.01, other);
  for (int i = 0; i < 200; ++i) {
    stepper.step(now);
    reference.step(other);
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(now.u[i], other.u[0] + (i == 0 ? 0.3 : 0.0), 1e-13);
    EXPECT_NEAR(now.v[i], other.v[0], 1e-13);
  }
  // Each force is what the masses above it need to accelerate with the others.
  const double u = other.u[0], v = other.v[0];
  const double a = (-std::sin(3.0) - 1.2 - 0.3 * v - 15.0 * u) / 5.5;
  const double first_force = 2.0 * a + 0.1 * v + 4.0 * (u + 0.3);
  const auto forces = constrained.contact_forces(now);
  EXPECT_NEAR(forces[0], first_force, 1e-11);
  EXPECT_NEAR(forces[1], first_force + 3.0 * a + 0.1 * v + 5.0 * u, 1e-11);
  // The margin of a release is the force and some roundings.
  for (std::size_t i = 0; i < 2; ++i) {
    const double margin = constrained.release_margin(i, now) - forces[Eigen::Index(i)];
    EXPECT_GT(margin, 1e-15);
    EXPECT_LT(margin, 1e-12);
  }
}

// Three touching masses at rest, pushed by constant forces: those contacts are active whose forces
// press, and the accelerations of the others open them. Every sign of the forces is tried.
TEST(ConstrainedSystem, DecidesWhichContactsStayClosed) {
  for (int signs = 0; signs < 27; ++signs) {
    const Eigen::Vector3d push(signs % 3 - 1, signs / 3 % 3 - 1, signs / 9 - 1);
    SCOPED_TRACE(testing::Message() << push.transpose());
    model::ImpactProblem<> p;
    p.system.mass = Eigen::Vector3d(1.0, 2.0, 4.0).asDiagonal();
    p.system.damping = p.system.stiffness = Eigen::Matrix3d::Zero();
    p.system.add_load = [push](double, std::span<double> f) {
      for (std::size_t i = 0; i < 3; ++i) f[i] += push[Eigen::Index(i)];
    };
    p.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, 1.0}, {Eigen::Vector3d(0, 1, -1), 0.0, 1.0}};
    p.start = {0.0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    ContactSet<model::any_dof> contacts(p);
    ConstrainedSystem<model::any_dof> constrained(p.system, contacts);
    ASSERT_FALSE(constrained.decide(std::array<std::size_t, 2>{0, 1}, p.start, p.start));
    const auto forces = constrained.contact_forces(p.start);
    Eigen::Vector3d a = push + contacts.row(0) * forces[0] + contacts.row(1) * forces[1];
    a = p.system.mass.inverse() * a;
    for (std::size_t i = 0; i < 2; ++i) {
      const double acceleration = contacts.gap_rate(i, a);
      EXPECT_GE(forces[Eigen::Index(i)], -1e-15);
      EXPECT_GE(acceleration, -1e-15);
      EXPECT_EQ(constrained.is_active(i), acceleration < 1e-15) << i;
    }
  }
}

// Both forces vanish at t = 0 and the masses are pulled from then on with forces that grow like t.
TEST(ConstrainedSystem, DecidesVanishingForcesByTheirTrend) {
  for (int signs = 0; signs < 8; ++signs) {
    const Eigen::Vector3d push(signs % 2 == 0 ? 1 : -1, signs / 2 % 2 == 0 ? 1 : -1,
                               signs / 4 == 0 ? 1 : -1);
    SCOPED_TRACE(testing::Message() << push.transpose());
    model::ImpactProblem<> p;
    p.system.mass = Eigen::Vector3d(1.0, 2.0, 4.0).asDiagonal();
    p.system.damping = p.system.stiffness = Eigen::Matrix3d::Zero();
    p.system.add_load = [push](double t, std::span<double> f) {
      for (std::size_t i = 0; i < 3; ++i) f[i] += push[Eigen::Index(i)] * t;
    };
    p.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, 1.0}, {Eigen::Vector3d(0, 1, -1), 0.0, 1.0}};
    p.start = {0.0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    ContactSet<model::any_dof> contacts(p);
    ConstrainedSystem<model::any_dof> constrained(p.system, contacts), later(p.system, contacts);
    auto end = p.start;
    end.t = 0.01;
    const std::array<std::size_t, 2> both{0, 1};
    ASSERT_FALSE(constrained.decide(both, p.start, p.start));
    EXPECT_TRUE(constrained.is_active(0) && constrained.is_active(1));
    ASSERT_FALSE(constrained.decide(both, p.start, end));
    ASSERT_FALSE(later.decide(both, end, end));
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(constrained.is_active(i), later.is_active(i));
  }
}

struct Spring : model::NonlinearForce<model::any_dof> {
  using Vector = model::Vector<model::any_dof>;
  using Matrix = model::Matrix<model::any_dof>;
  void add(const Vector& u, const Vector&, Vector& p) const override {
    p[0] += std::pow(u[0], 3);
    p[1] += 2.0 * std::pow(u[1], 3);
  }
  void add_tangent(const Vector& u, const Vector&, Matrix& du, Matrix&) const override {
    du(0, 0) += 3.0 * u[0] * u[0];
    du(1, 1) += 6.0 * u[1] * u[1];
  }
};

TEST(ConstrainedSystem, ProjectsANonlinearForceToo) {
  auto problem = two_masses<model::any_dof>();
  problem.system.nonlinear = std::make_shared<Spring>();
  ContactSet<model::any_dof> contacts(problem);
  ConstrainedSystem<model::any_dof> constrained(problem.system, contacts);
  constrained.activate(first, problem.start.u);
  const auto& s = constrained.system();
  const auto& now = problem.start;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2), p = f, q = f;
  s.add_load(now.t, {f.data(), 2});
  s.nonlinear->add(now.u, now.v, p);
  const Eigen::VectorXd a = s.mass.inverse() * (f - s.damping * now.v - s.stiffness * now.u - p);
  EXPECT_NEAR(a[0], a[1], 1e-14);
  const double force = std::sin(1.0) - 2.0 - 0.3 * -0.5 - 4.0 * 0.7 - 5.0 * 0.4 - std::pow(0.7, 3) -
                       2.0 * std::pow(0.4, 3);
  EXPECT_NEAR(a[0], force / 5.0, 1e-14);
  // Its tangent is its derivative.
  Eigen::MatrixXd du = Eigen::MatrixXd::Zero(2, 2), dv = du;
  s.nonlinear->add_tangent(now.u, now.v, du, dv);
  const Eigen::VectorXd shift = 1e-6 * Eigen::Vector2d(1.0, -2.0);
  s.nonlinear->add(now.u + shift, now.v, q);
  EXPECT_LT((q - p - du * shift).norm(), 2e-11);  // 3 |u| |shift|^2
}

}  // namespace
}  // namespace clackers::methods
