#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/exact/testing/taylor_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Side;
using testing_oracle::Box;
using testing_oracle::Real;
using testing_oracle::TaylorSimulator;
using testing_oracle::trials;

// Springs in a row, perhaps with consistent masses, under weight; elastic stops at the ends and neighbours that stick.
model::ImpactProblem<> random_springs(Box& box) {
  const auto n = Eigen::Index(box.uniform(9.0, 12.0));
  model::ImpactProblem<> problem;
  auto &mass = problem.system.mass, &damping = problem.system.damping,
       &stiffness = problem.system.stiffness;
  mass = damping = stiffness = MatrixXd::Zero(n, n);
  const bool is_spread = box.one_in(2), is_free = box.one_in(2);
  for (Eigen::Index i = 0; i < n; ++i) {
    mass(i, i) = box.uniform(0.7, 1.4);
    // Sums of these are exact, so that a free row has a rigid motion.
    const double k = std::floor(box.uniform(64.0, 192.0)) / 64.0;
    if (i + 1 == n && is_free) break;
    stiffness(i, i) += k;
    if (i + 1 == n) break;
    stiffness(i + 1, i + 1) += k;
    stiffness(i, i + 1) = stiffness(i + 1, i) = -k;
    if (is_spread) mass(i, i + 1) = mass(i + 1, i) = box.uniform(0.0, 0.2);
  }
  problem.start = {0.0, VectorXd::Zero(n), VectorXd::Zero(n)};
  for (auto& v : problem.start.v) v = box.uniform(-2.0, 2.0);
  problem.contacts.push_back({VectorXd::Unit(n, 0), box.uniform(-0.6, -0.1), 1.0});
  problem.contacts.push_back({-VectorXd::Unit(n, n - 1), box.uniform(-0.6, -0.1), 1.0});
  auto between = model::contact_between(n, 4, 5, 0.0);
  between.gap = box.uniform(-0.3, -0.1);
  problem.contacts.push_back(between);
  if (box.one_in(2))
    problem.system.add_load = model::HarmonicLoad({{0, -0.3, 0.0, 0.0}, {3, -0.1, 0.0, 0.0}});
  problem.end = 36.0;
  return problem;
}

// Impacts enlarge errors until doubles no longer show where the next one is; what is carried in double-double does not show it.
TEST(FlightStates, OfManyMassesAreTheSimulationToARounding) {
  Box box(71);
  int members = 0, impacts = 0, held = 0;
  double worst = 0.0, widest = 0.0, widest_in_doubles = 0.0;
  for (int trial = 0; members < trials(4) && trial < 400; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 71, trial " << trial);
    auto problem = random_springs(box);
    // Held with other factors the modes are of doubles, and so is the state from then on.
    const bool is_precise = members != 2;
    if (!is_precise) problem.contacts.back().direction[4] = 2.0;
    if (test::refusal_of([&] { PiecewiseMotion{problem}; }) != "accepted") continue;
    ++members;
    const PiecewiseMotion motion(problem);
    held += int(motion.closed_contacts().size());
    TaylorSimulator simulator(problem);
    for (int i = 1; i <= 10; ++i) {
      const double t = 3.6 * i;
      while (simulator.next(t)) ++impacts;
      const auto x = simulator.at(t);
      const auto state = motion.at(t, Side::right), bound = motion.error_bound(t);
      for (Eigen::Index j = 0; j < problem.dof(); ++j) {
        const auto share = [&](const Real& is, double found, double allowed) {
          worst = std::max(worst, double(abs(is - Real(found))) / (allowed + 1e-40));
        };
        share(x.u[j], state.u[j], bound.u[j]);
        share(x.v[j], state.v[j], bound.v[j]);
        // A double is no nearer than its own rounding.
        ASSERT_GE(bound.u[j], 0x1p-53 * std::abs(state.u[j]));
        (is_precise ? widest : widest_in_doubles) =
            std::max(is_precise ? widest : widest_in_doubles, bound.u[j]);
      }
      ASSERT_LE(worst, 1.0) << t;
    }
  }
  EXPECT_EQ(members, trials(4));
  EXPECT_GT(impacts, 20 * members);
  EXPECT_GT(held, 2 * members);
  // Of 3e-9 with states in doubles.
  EXPECT_LT(widest, 1e-12);
  EXPECT_GT(widest_in_doubles, widest);
}

}  // namespace
}  // namespace clackers::exact
