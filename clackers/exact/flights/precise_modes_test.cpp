#include <gtest/gtest.h>

#include <cmath>

#include "clackers/exact/flights/forced_modes.hpp"
#include "clackers/exact/testing/taylor_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::exact {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using numerics::DoubleDouble;
using testing_oracle::Box;
using testing_oracle::Real;
using testing_oracle::TaylorSimulator;
using testing_oracle::trials;

Real real(const DoubleDouble& x) { return Real(x.hi) + Real(x.lo); }

ForcedModes::Numbers wide(const VectorXd& x) {
  ForcedModes::Numbers numbers;
  for (const double value : x) numbers.push_back({value, 0.0});
  return numbers;
}

// A row of springs under constant forces, of which the first mass may be held at 1/4.
TEST(PreciseModes, MoveAsTheTaylorSeriesSaysToThirtyDigits) {
  Box box(72);
  double worst = 0.0, largest = 0.0;
  for (int trial = 0; trial < trials(20); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 72, trial " << trial);
    const Index n = Index(box.uniform(2.0, 7.0)), held = Index(box.one_in(2));
    model::ImpactProblem<> whole, free;
    auto &mass = whole.system.mass, &stiffness = whole.system.stiffness;
    mass = stiffness = whole.system.damping = MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
      mass(i, i) = box.uniform(0.7, 1.4);
      if (i + 1 == n) break;
      mass(i, i + 1) = mass(i + 1, i) = box.uniform(0.0, 0.2);
      // Products and sums of these are exact.
      const double k = std::floor(box.uniform(64.0, 192.0)) / 64.0;
      stiffness(i, i) += k;
      stiffness(i + 1, i + 1) += k;
      stiffness(i, i + 1) = stiffness(i + 1, i) = -k;
    }
    whole.start = {0.0, VectorXd::Zero(n), VectorXd::Zero(n)};
    std::vector<model::HarmonicForce> forces, all;
    ForcedModes::Rest rest{MatrixXd::Zero(n, n), VectorXd::Zero(n)};
    for (Index i = held; i < n; ++i) {
      whole.start.u[i] = box.uniform(-1.0, 1.0);
      whole.start.v[i] = box.uniform(-1.0, 1.0);
      forces.push_back({int(i), box.uniform(-1.0, 1.0), 0.0, 0.0});
      rest.force[i] = forces.back().amplitude * box.uniform(-1.0, 1.0) * 0x1p-53;
      all.push_back({int(i - held), forces.back().amplitude, 0.0, 0.0});
      all.push_back({int(i - held), rest.force[i], 0.0, 0.0});
    }
    const double place = held == 1 ? 0.25 : 0.0;
    if (held == 1) all.push_back({0, -place * stiffness(1, 0), 0.0, 0.0});
    whole.start.u[0] += place;
    whole.system.add_load = model::HarmonicLoad(forces);
    const Index m = n - held;
    free.system.mass = mass.bottomRightCorner(m, m);
    free.system.stiffness = stiffness.bottomRightCorner(m, m);
    free.system.damping = MatrixXd::Zero(m, m);
    free.system.add_load = model::HarmonicLoad(all);
    free.start = {0.0, whole.start.u.tail(m), whole.start.v.tail(m)};
    const ForcedModes modes(whole, "row", MatrixXd::Identity(n, n).rightCols(m),
                            place * VectorXd::Unit(n, 0), rest, true);
    ASSERT_TRUE(modes.is_precise());
    const double s = box.uniform(0.5, 8.0);
    TaylorSimulator simulator(free);
    simulator.next(s);
    const auto known = simulator.at(s);
    const auto start = modes.precise_state(wide(whole.start.u), wide(whole.start.v));
    const auto z = modes.precise_advanced(start, {s, 0.0});
    const auto [u, v] = modes.precise_motion(z);
    const VectorXd at_start = modes.state(whole.start.u, whole.start.v),
                   errors = modes.precise_change_errors(at_start) +
                            modes.local_errors(at_start - modes.steady(0.0), 0.0, s, true),
                   none = VectorXd::Zero(n);
    // The errors of a mode turn into each other.
    VectorXd bound = errors;
    for (Index j = 0; j < m; ++j) {
      const double omega = modes.system().modes()[std::size_t(j)].omega;
      bound[j] += errors[m + j] * (omega > 0.0 ? 1.0 / omega : s);
      bound[m + j] += omega * errors[j];
    }
    const auto share = [&](const Real& difference, double allowed) {
      worst = std::max(worst, double(abs(difference)) / allowed);
      largest = std::max(largest, allowed);
    };
    for (Index i = held; i < n; ++i) {
      const auto seen = modes.observe(VectorXd::Unit(n, i), none, none, none, -place);
      const double at_z = seen.precise_constant_error;
      const VectorXd found = modes.advanced(at_start, s).cwiseAbs();
      const auto allowed = [&](Index first) {
        return at_z + seen.precise_errors.dot(found.segment(first, m)) +
               modes.system().shapes().row(i).cwiseAbs().dot(bound.segment(first, m));
      };
      share(real(u[std::size_t(i)]) - known.u[i - held], allowed(0));
      share(real(v[std::size_t(i)]) - known.v[i - held], allowed(m));
      share(real(ForcedModes::precise_value(seen, z)) - known.u[i - held] + place, allowed(0));
      share(real(ForcedModes::precise_slope(seen, z)) - known.v[i - held], allowed(m));
    }
    if (held == 0) continue;
    // The force that holds the first mass.
    const VectorXd row = VectorXd::Unit(n, 0);
    const auto force = modes.observe(stiffness * row, none, mass * row, -row, 0.0);
    const Real is =
        mass(0, 1) * known.a[0] + stiffness(0, 1) * known.u[0] + Real(stiffness(0, 0) * place);
    share(real(ForcedModes::precise_value(force, z)) - is, 1e-27);
  }
  EXPECT_LE(worst, 1.0);
  EXPECT_LT(largest, 1e-24);
  RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace clackers::exact
