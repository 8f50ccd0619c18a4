#include "clackers/measure/metrics/definitions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

const ToyMotion structure_reference;

struct Load : model::NonlinearForce<model::any_dof> {
  using Vector = model::Vector<model::any_dof>;
  using Matrix = model::Matrix<model::any_dof>;
  void add(const Vector&, const Vector&, Vector&) const override {}
  void add_tangent(const Vector&, const Vector&, Matrix&, Matrix&) const override {}
};

// Masses 1 and 2, stiffnesses 1 and 2, u* = (1, -1/2) and v* = 0 at t = 0: the energy is 3/4.
TEST(EnergyError, SplitsIntoKineticAndPotential) {
  const auto problem = toy_problem();
  for (const double u1 : {1.2, 0.8}) {
    auto history = history_of(structure_reference, {0.0, 1.0});
    history.u[0] = u1;
    history.v[1] = 0.3;
    const double potential = 0.5 * (u1 * u1 - 1.0), kinetic = 0.09;
    const Comparison comparison(history, structure_reference, problem);
    EXPECT_NEAR(energy_error(comparison, Energy::potential).value, std::abs(potential) / 0.75,
                1e-15);
    EXPECT_NEAR(energy_error(comparison, Energy::kinetic).value, kinetic / 0.75, 1e-15);
    EXPECT_NEAR(energy_error(comparison, Energy::total).value, std::abs(potential + kinetic) / 0.75,
                1e-15);
    EXPECT_TRUE(energy_error(comparison, Energy::total).masses.empty());
  }
}

TEST(EnergyError, IsTheWorstOfAllTimes) {
  auto history = history_of(structure_reference, {0.0, 1.0, 2.0});
  history.v[2] = 0.0;  // sin(1)^2 / 2 missing
  EXPECT_NEAR(energy_error({history, structure_reference, toy_problem()}, Energy::total).value,
              0.5 * std::pow(std::sin(1.0), 2) / 0.75, 1e-15);
}

TEST(EnergyError, SaysWhyItIsNotMeasured) {
  auto history = history_of(structure_reference, {0.0, 1.0});
  history.v.clear();
  auto problem = toy_problem();
  const Comparison comparison(history, structure_reference, problem);
  EXPECT_EQ(energy_error(comparison, Energy::potential).value, 0.0);
  for (const auto part : {Energy::kinetic, Energy::total})
    EXPECT_EQ(energy_error(comparison, part).reason, "The history has no velocities.");
  problem.system.nonlinear = std::make_shared<Load>();
  EXPECT_NE(energy_error(comparison, Energy::potential).reason.find("nonlinear"),
            std::string::npos);
  auto empty = toy_problem();
  empty.system.stiffness.setZero();
  empty.system.mass.setZero();
  EXPECT_NE(energy_error({history, structure_reference, empty}, Energy::potential)
                .reason.find("has no energy"),
            std::string::npos);
}

TEST(MechanicalEnergy, TakesFullMatrices) {
  auto system = toy_problem().system;
  system.mass << 2.0, 0.5, 0.5, 1.0;
  system.stiffness << 3.0, -1.0, -1.0, 4.0;
  const MechanicalEnergy energy(system);
  const double x[] = {1.0, 2.0};
  EXPECT_EQ(energy.kinetic(x), 4.0);
  EXPECT_EQ(energy.potential(x), 7.5);
  EXPECT_EQ(energy.total(x, x), 11.5);
}

// 0.3 m1 - 0.05 m2 = 0.2 of m1 V1 + m2 V2 = 1 + 2 / 2.
TEST(MomentumError, IsThatOfTheSumOfAllMasses) {
  auto history = history_of(structure_reference, {0.0, 1.0});
  history.v[2] -= 0.3;
  history.v[3] += 0.05;
  auto problem = toy_problem();
  EXPECT_NEAR(momentum_error({history, structure_reference, problem}).value, 0.1, 1e-15);
  problem.system.mass << 1.0, 0.5, 0.5, 2.0;
  EXPECT_NEAR(momentum_error({history, structure_reference, problem}).value, (0.45 - 0.125) / 2.75,
              1e-15);
  history.v.clear();
  EXPECT_EQ(momentum_error({history, structure_reference, problem}).reason,
            "The history has no velocities.");
}

TEST(Penetration, IsTheDeepestOfAllContactsAndTimes) {
  auto history = history_of(structure_reference, {0.0, 1.0, 1.2});
  auto problem = toy_problem();
  EXPECT_EQ(penetration({history, structure_reference, problem}).value, 0.0);
  history.u[2] = -0.1;
  history.u[3] = 0.05;
  EXPECT_NEAR(penetration({history, structure_reference, problem}).value, 0.15, 1e-16);
  problem.contacts[0].gap = 0.02;
  EXPECT_NEAR(penetration({history, structure_reference, problem}).value, 0.17, 1e-16);
  problem.contacts.push_back({Eigen::Vector2d(0.0, -1.0), 0.2, 1.0});
  EXPECT_NEAR(penetration({history, structure_reference, problem}).value, 0.25, 1e-16);
  problem.contacts.clear();
  history.impacts.reset();
  EXPECT_EQ(penetration({history, structure_reference, problem}).reason,
            "The problem has no contact.");
}

// The toy with contact 1 at u1 - u2 = 0.4 closed from 2 to 6 s.
class Resting : public ToyMotion {
 public:
  std::vector<model::ClosedContact> closed_contacts() const override {
    model::ClosedContact closed;
    closed.from = 2.0;
    closed.until = 6.0;
    return {closed};
  }
};

TEST(RestError, IsThatOfTheLaterHalfOfAClosedContact) {
  const Resting reference;
  auto problem = toy_problem();
  problem.contacts[0].gap = 0.4;
  auto history = history_of(reference, {0.0, 3.0, 4.5, 5.5, 7.0});
  for (std::size_t i = 0; i < 5; ++i) {
    history.u[2 * i] = history.u[2 * i + 1] + 0.4;
    history.v[2 * i] = history.v[2 * i + 1];
  }
  const auto both = [&] {
    const Comparison comparison(history, reference, problem);
    return std::pair(rest_error(comparison, Rest::gap).value,
                     rest_error(comparison, Rest::speed).value);
  };
  EXPECT_NEAR(both().first, 0.0, 1e-15);
  for (const std::size_t outside : {0U, 1U, 4U})
    history.u[2 * outside] += 1.0, history.v[2 * outside] += 1.0;
  EXPECT_NEAR(both().first, 0.0, 1e-15);
  EXPECT_NEAR(both().second, 0.0, 1e-15);
  history.u[4] -= 0.125;
  history.v[6] += 0.25;
  EXPECT_NEAR(both().first, 0.125, 1e-15);
  EXPECT_NEAR(both().second, 0.25, 1e-15);
  const Comparison of_none(history, structure_reference, problem);
  EXPECT_EQ(rest_error(of_none, Rest::gap).reason, "No contact stays closed.");
}

}  // namespace
}  // namespace clackers::measure
