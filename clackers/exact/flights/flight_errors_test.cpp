#include "clackers/exact/flights/flight_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::exact {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing_oracle::Box;
using testing_oracle::trials;

// A chain with a contact at each end, free to move in some, and the regimes in which both contacts are closed
// springs, or held.
struct Chain {
  explicit Chain(Box& box, Index n) : directions{VectorXd::Unit(n, 0), VectorXd::Unit(n, n - 1)} {
    problem.system.mass = problem.system.stiffness = problem.system.damping = MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) problem.system.mass(i, i) = box.decades(-1.0, 1.0);
    const bool is_free = box.one_in(2);
    for (Index i = 0; i <= n; ++i) {
      if (is_free && (i == 0 || i == n)) continue;
      VectorXd stretch = VectorXd::Zero(n);
      if (i < n) stretch[i] = 1.0;
      if (i > 0) stretch[i - 1] = -1.0;
      problem.system.stiffness += box.decades(-1.0, 2.0) * stretch * stretch.transpose();
    }
    if (box.one_in(3)) problem.system.damping = 0.02 * problem.system.stiffness;
    auto closed = problem;
    for (const auto& b : directions)
      closed.system.stiffness += box.decades(-1.0, 3.0) * b * b.transpose();
    const MatrixXd basis = MatrixXd::Identity(n, n).middleCols(1, n - 2);
    regimes.emplace_back(problem, "chain");
    regimes.emplace_back(closed, "chain");
    regimes.emplace_back(problem, "chain", basis, VectorXd::Zero(n));
  }
  // The gap of a contact, or the force of a held one.
  VectorXd watched(std::size_t regime, const VectorXd& b) const {
    const auto& modes = regimes[regime];
    const VectorXd none = VectorXd::Zero(b.size());
    if (regime < 2) return modes.observe(b, none, none, none, 0.0).by_state.col(0);
    return modes.observe(modes.stiffness() * b, modes.damping() * b, modes.mass() * b, none, 0.0)
        .by_state.col(0);
  }

  std::vector<VectorXd> directions;
  model::ImpactProblem<> problem;
  std::vector<ForcedModes> regimes;
};

// One error of many that may be: each event adds one within what is told of it, at an extreme or anywhere.
TEST(FlightErrors, HoldWhatSequencesOfEventsMakeOfAnyErrorInThem) {
  Box box(61);
  double closest = 0.0;
  for (int trial = 0; trial < trials(300); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 61, trial " << trial);
    const Index n = Index(box.uniform(3.0, 8.0));
    const Chain chain(box, n);
    const double seconds = box.decades(-1.0, 1.5);
    std::size_t regime = 0;
    FlightErrors errors(chain.regimes[0], seconds, box.one_in(2) ? 0 : 64);
    VectorXd z = VectorXd::Zero(2 * n);
    double largest = 0.0;
    const auto share = [&] {
      return box.one_in(2) ? (box.one_in(2) ? 1.0 : -1.0) : box.uniform(-1.0, 1.0);
    };
    for (int event = 0; event < 12; ++event) {
      const auto& modes = chain.regimes[regime];
      const double s = seconds / 12.0;
      const VectorXd seen = chain.watched(regime, chain.directions[0]);
      const double until = errors.bounds_until(modes, seen.transpose(), s)[0];
      const double then = errors.bounds(modes, seen.transpose(), s)[0];
      for (const double x : {0.3 * s, s})
        EXPECT_LE(std::abs(seen.dot(modes.advanced(z, x, 0.0))), until * (1.0 + 1e-10));
      errors.carry(modes, s);
      z = modes.advanced(z, s, 0.0);
      EXPECT_LE(std::abs(seen.dot(z)), then * (1.0 + 1e-10));
      largest = std::max({largest, then, z.cwiseAbs().maxCoeff()});
      EXPECT_NEAR(errors.bounds(modes, seen.transpose())[0], then, 1e-8 * then + 1e-10 * largest);
      VectorXd sizes(2 * modes.dof());
      for (double& size : sizes) size = event % 3 == 1 ? 0.0 : box.decades(-3.0, 0.0);
      errors.add(modes, sizes);
      for (Index j = 0; j < z.size(); ++j) z[j] += share() * sizes[j];
      if (box.one_in(2)) {
        FlightErrors::Impact impact;
        impact.impulses = modes.impulse(chain.directions[0]);
        const VectorXd none = VectorXd::Zero(n);
        impact.rates =
            1.7 * modes.observe(none, chain.directions[0], none, none, 0.0).by_state.col(0);
        const double mass = impact.rates.col(0).dot(impact.impulses.col(0)) / 1.7;
        if (mass > 0.0) impact.rates /= mass;
        impact.jumps = MatrixXd::Random(z.size(), 1);
        impact.gaps = box.uniform(-1.0, 1.0) * seen;
        impact.rounding = box.decades(-4.0, -1.0);
        errors.pass(modes, impact);
        z += impact.jumps * (impact.gaps.transpose() * z) +
             share() * impact.rounding * impact.jumps -
             impact.impulses * (impact.rates.transpose() * z);
      } else {
        const auto next = std::size_t(box.uniform(0.0, 3.0));
        if (next != regime && (next == 0 || regime == 0)) {
          const auto& to = chain.regimes[next];
          std::vector<VectorXd> opened;
          for (const auto& b : chain.directions)
            if (next == 0) opened.push_back(chain.watched(regime, b));
          errors.change(modes, to, opened);
          z = to.change(modes.derived_states(0, z), modes.derived_states(1, z));
          regime = next;
        }
      }
      const auto& now = chain.regimes[regime];
      if (event % 4 == 2) {
        const MatrixXd row = chain.watched(regime, chain.directions[0]).transpose();
        const double before = errors.bounds(now, row)[0];
        errors.enlarge(1.5);
        z *= 1.5;
        EXPECT_NEAR(std::pow(errors.bounds(now, row)[0], 2), std::pow(1.5 * before, 2),
                    1e-3 * before * before + 1e-9 * largest * largest);
      }
      if (box.one_in(6) && !now.system().is_coupled()) {
        errors.collapse(now);
        EXPECT_EQ(errors.bytes(), 0.0);
      }
      for (int order = 0; order <= 2; ++order) {
        const VectorXd bound = errors.bounds(now, now.system().derivative(order));
        const VectorXd u = now.derived_states(order, z).cwiseAbs();
        for (Index i = 0; i < n; ++i) {
          EXPECT_LE(u[i], bound[i] * (1.0 + 1e-9) + 1e-13 * largest) << order << " " << i;
          if (bound[i] > 0.0) closest = std::max(closest, u[i] / bound[i]);
        }
      }
    }
  }
  EXPECT_GT(closest, 0.5);
}

// Errors of a mesh that bounces stay what an event adds: its modes' errors do not grow into each other.
TEST(FlightErrors, OfManyMassesCostNoMoreThanTheirEvents) {
  constexpr Index n = 200;
  model::ImpactProblem<> problem;
  problem.system.mass = MatrixXd::Identity(n, n);
  problem.system.damping = MatrixXd::Zero(n, n);
  problem.system.stiffness = 2.0 * MatrixXd::Identity(n, n);
  problem.system.stiffness.diagonal(1).setConstant(-1.0);
  problem.system.stiffness.diagonal(-1).setConstant(-1.0);
  const ForcedModes modes(problem, "chain");
  FlightErrors errors(modes, 10.0);
  for (int flight = 0; flight < 5; ++flight) {
    errors.add(modes, VectorXd::Constant(2 * n, 1e-15));
    errors.carry(modes, 1.0);
    FlightErrors::Impact impact{modes.impulse(VectorXd::Unit(n, 0)), MatrixXd::Zero(2 * n, 1),
                                VectorXd::Ones(2 * n), MatrixXd::Zero(2 * n, 1), 1e-15};
    errors.pass(modes, impact);
  }
  EXPECT_LE(errors.bytes(), 8.0 * double(2 * n * 2 * 5));
}

}  // namespace
}  // namespace clackers::exact
