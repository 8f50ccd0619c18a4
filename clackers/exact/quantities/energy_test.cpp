#include "clackers/exact/quantities/energy.hpp"

#include <gtest/gtest.h>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_members.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using namespace testing_oracle;

constexpr double unit = 0x1p-52;

void expect_relative(const Real& reference, double value, double units, const char* what) {
  EXPECT_LE(abs(reference - Real(value)), units * unit * abs(reference)) << what << " = " << value;
}

struct TrueSplit {
  Real kinetic, potential, dissipated, lost, momentum;
};

// Follows the simulation; times must rise.
class Follower {
 public:
  explicit Follower(const RawPair& raw) : raw_(raw), simulator_(raw) {
    start_ = mechanical(simulator_.at(0));
  }
  TrueSplit at(const Real& t) {
    while (const auto hit = simulator_.next(t)) lost_ += hit->energy_before - hit->energy_after;
    const auto x = simulator_.at(t);
    TrueSplit s;
    s.kinetic = (raw_.m1 * x.v[0] * x.v[0] + raw_.m2 * x.v[1] * x.v[1]) / 2;
    s.potential = mechanical(x) - s.kinetic;
    s.lost = lost_;
    s.dissipated = start_ - mechanical(x) - lost_;
    s.momentum = raw_.m1 * x.v[0] + raw_.m2 * x.v[1];
    return s;
  }
  Real start() const { return start_; }

 private:
  Real mechanical(const RawState& x) const {
    return (raw_.m1 * x.v[0] * x.v[0] + raw_.m2 * x.v[1] * x.v[1] + raw_.k1 * x.u[0] * x.u[0] +
            raw_.k2 * x.u[1] * x.u[1]) /
           2;
  }
  RawPair raw_;
  ImpactSimulator simulator_;
  Real start_, lost_ = 0;
};

void expect_split(const SynchronizedPair& motion, Follower& reference, double t) {
  SCOPED_TRACE(testing::Message() << "t = " << t);
  const EnergyAccount account(motion);
  const auto found = account.at(t, Side::right);
  const auto expected = reference.at(t);
  const auto envelope = motion.envelope(t);
  const auto& problem = motion.problem();
  double kinetic = 0.0, potential = 0.0, momentum = 0.0;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double m = problem.system.mass(i, i), v = envelope.v[i], u = envelope.u[i];
    kinetic += 0.5 * m * v * v;
    potential += 0.5 * problem.system.stiffness(i, i) * u * u;
    momentum += m * v;
  }
  EXPECT_LE(abs(expected.kinetic - Real(found.kinetic)), 8 * unit * kinetic);
  EXPECT_LE(abs(expected.potential - Real(found.potential)), 8 * unit * potential);
  EXPECT_LE(abs(expected.momentum - Real(account.momentum(t, Side::right))), 4 * unit * momentum);
  // The simulation's own difference of energies carries 1e-85 of the start.
  if (expected.dissipated > Real("1e-60") * reference.start())
    expect_relative(expected.dissipated, found.dissipated, 64, "dissipated");
  else
    EXPECT_EQ(found.dissipated, 0.0);
  if (expected.lost > Real("1e-60") * reference.start())
    expect_relative(expected.lost, found.lost, 64, "lost");
  else
    EXPECT_EQ(found.lost, 0.0);
  expect_relative(reference.start(), found.total(), 64, "total");
  expect_relative(reference.start(), account.initial(), 64, "initial");
}

TEST(Energy, IsSplitAsASimulationSplitsIt) {
  constexpr unsigned seed = 20260401;
  Box box(seed);
  for (int i = 0; i < trials(25); ++i) {
    const auto p = simple_pair(box);
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " xi1 " << p.xi1
                                    << " X " << p.X << " r " << p.r << " eta " << p.eta);
    const SynchronizedPair motion(p);
    Follower reference(raw_of(wide(p)));
    // Little has been dissipated at the first three; energies would have to be subtracted.
    for (const double part : {1e-7, 1e-3, 0.05, 0.0999, 0.3, 0.9, 1.2, 2.01, 2.5, 2.9, 4.1, 4.89})
      expect_split(motion, reference, p.t_end * part / 4.9);
    if (HasFailure()) return;
  }
}

TEST(Energy, IsSplitAtBothEndsOfDampingToo) {
  for (const double xi1 : {0.0, 1e-12, 0.9, 0.99999, 1.0 - 0x1p-53}) {
    const PairParameters p{.xi1 = xi1, .X = 5.0, .r = 2.0, .eta = 0.75, .t_end = 3e8};
    const SynchronizedPair motion(p);
    Follower reference(raw_of(wide(p)));
    SCOPED_TRACE(xi1);
    for (const double t : {1e-9, 0.01, 0.1, 0.4, 0.7, 1.2, 20.0})
      expect_split(motion, reference, t);
  }
}

TEST(Energy, IsCompleteAfterManyImpacts) {
  for (const double eta : {1.0, 1.0 - 1e-9, 0.5})
    for (const double xi1 : {0.0, 1e-10, 0.05}) {
      const SynchronizedPair motion({.xi1 = xi1, .eta = eta, .t_end = 1e9});
      const EnergyAccount account(motion);
      for (const double t : {1e3, 1e6, 1e9}) {
        const auto split = account.at(t, Side::right);
        EXPECT_NEAR(split.total() / account.initial(), 1.0, 64 * unit) << eta << " " << xi1;
        EXPECT_EQ(split.lost == 0.0, eta == 1.0);
        EXPECT_EQ(split.dissipated == 0.0, xi1 == 0.0);
      }
    }
}

TEST(Energy, JumpsAtAnImpactByWhatTheImpactTakes) {
  for (const double eta : {0.0, 0.3, 1.0}) {
    const SynchronizedPair motion({.X = 5.0, .eta = eta});
    const EnergyAccount account(motion);
    for (long long k = 1; k <= motion.impact_count(20.0); ++k) {
      const auto hit = motion.impact(k);
      const auto before = account.at(hit.t, Side::left), after = account.at(hit.t, Side::right);
      // The impact is within half an ulp of hit.t, where energies change by less than ulps.
      const double slack = 64 * unit * account.initial();
      EXPECT_NEAR(after.lost - before.lost, hit.energy_before - hit.energy_after, slack);
      EXPECT_NEAR(after.dissipated, before.dissipated, slack);
      EXPECT_NEAR(before.kinetic + before.potential, hit.energy_before, slack);
      EXPECT_NEAR(after.kinetic + after.potential, hit.energy_after, slack);
    }
    EXPECT_NEAR(account.at(20.0, Side::right).total(), account.initial(),
                64 * unit * account.initial());
  }
}

TEST(Energy, OfAFreeMassIsNeverLostAtImpacts) {
  const FreeMass motion({.xi1 = 0.02, .t_end = 300.0});
  const EnergyAccount account(motion);
  EXPECT_EQ(account.initial(), 0.5 * (1.0 + 0.02 * 0.02));
  for (const double t : {0.0, 0.3, 1.0, 4.0, 77.7, 300.0}) {
    const auto split = account.at(t, Side::right);
    EXPECT_EQ(split.lost, 0.0);
    EXPECT_NEAR(split.total(), account.initial(), 64 * unit);
    EXPECT_EQ(account.momentum(t, Side::right), motion.at(t, Side::right).v[0]);
  }
}

TEST(Energy, OfAMassAtAStopIsAccountedFor) {
  const RigidStop motion({.xi1 = 0.1, .eta = 0.7});
  const EnergyAccount account(motion);
  for (const double t : {0.5, 2.0, 5.0, 19.0}) {
    const auto split = account.at(t, Side::right);
    EXPECT_NEAR(split.total(), account.initial(), 64 * unit);
    EXPECT_EQ(split.lost > 0.0, t > 1.6);
  }
}

TEST(Energy, RefusesTimesOutsideTheMotion) {
  const FreeMass motion({});
  EXPECT_THROW(EnergyAccount(motion).at(-1.0, Side::left), InputError);
  EXPECT_THROW(EnergyAccount(motion).momentum(21.0, Side::left), InputError);
}

}  // namespace
}  // namespace clackers::exact
