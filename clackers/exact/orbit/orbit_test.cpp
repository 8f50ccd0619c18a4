// Cradle and forced orbits against the simulation with 90 digits, which is given masses, springs,
// dashpots and forces by the formulas of the literature, and knows no orbit.
#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/orbit/cradle.hpp"
#include "clackers/exact/orbit/forced_pair.hpp"
#include "clackers/exact/testing/impact_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using testing_oracle::Box;
using testing_oracle::ImpactSimulator;
using testing_oracle::pi;
using testing_oracle::RawForce;
using testing_oracle::RawPair;
using testing_oracle::RawState;
using testing_oracle::Real;
using testing_oracle::trials;

void expect_state(const model::Motion& motion, const RawState& reference, double t) {
  const auto state = motion.at(t, Side::right);
  const auto bound = motion.error_bound(t);
  // A resting mass is 0 in the one, and the rounding of 90 digits in the other.
  const auto size = motion.envelope(t);
  const Real noise = Real("1e-60") * size.a.maxCoeff();
  const double fastest = std::sqrt((size.a.array() / size.u.array()).maxCoeff());
  for (std::size_t i = 0; i < 2; ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    EXPECT_LE(abs(reference.u[i] - Real(state.u[m])), Real(bound.u[m]) + noise)
        << "u" << i + 1 << " " << t;
    EXPECT_LE(abs(reference.v[i] - Real(state.v[m])), Real(bound.v[m]) + noise)
        << "v" << i + 1 << " " << t;
    EXPECT_LE(abs(reference.a[i] - Real(state.a[m])), Real(bound.a[m]) + noise)
        << "a" << i + 1 << " " << t;
    // Two-sided: units of the result and of the constants, and the phase, hide no error of formulas.
    EXPECT_LE(bound.u[m], (0x1p-47 + 0x1p-58 * fastest * (t + 1.0 / fastest)) * size.u[m]);
  }
}

void expect_simulated(const model::Motion& motion, const RawPair& pair, long long impacts) {
  ImpactSimulator simulator(pair);
  impacts = std::min(impacts, motion.impact_count(motion.end()));
  ASSERT_GT(impacts, 0);
  for (long long k = 1; k <= impacts; ++k) {
    SCOPED_TRACE(testing::Message() << "flight to impact " << k);
    const auto before = simulator;
    const auto found = simulator.next(Real(motion.end()));
    ASSERT_TRUE(found);
    const Real flight = found->before.t - before.flight_start();
    for (const double part : {0.31, 0.87}) {
      const double t = double(before.flight_start() + part * flight);
      if (t >= 0.0) expect_state(motion, before.at(t), t);
    }
    const auto hit = motion.impact(k);
    EXPECT_TRUE(Real(hit.when.lo) <= found->before.t && found->before.t <= Real(hit.when.hi));
    const auto size = motion.envelope(hit.t);
    const double unit = 4.0 * 0x1p-53;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto m = static_cast<Eigen::Index>(i);
      EXPECT_NEAR(hit.before.u[m], double(found->before.u[i]), unit * size.u[m]);
      EXPECT_NEAR(hit.before.v[m], double(found->before.v[i]), unit * size.v[m]);
      EXPECT_NEAR(hit.after.v[m], double(found->after.v[i]), unit * size.v[m]);
      EXPECT_NEAR(hit.before.a[m], double(found->before.a[i]), unit * size.a[m]);
      EXPECT_NEAR(hit.after.a[m], double(found->after.a[i]), unit * size.a[m]);
    }
    EXPECT_NEAR(hit.impulse, double(found->impulse), unit * hit.impulse);
    EXPECT_NEAR(hit.energy_before, double(found->energy_before), 8.0 * unit * hit.energy_before);
    EXPECT_NEAR(hit.energy_after, double(found->energy_after), 8.0 * unit * hit.energy_before);
  }
}

RawPair raw(const CradleParameters& p) {
  const Real w1 = p.omega1, w2 = p.omega2, x1 = p.xi1, x2 = p.xi2;
  return {1, 1, w1 * w1, w2 * w2, 2 * x1 * w1, 2 * x2 * w2, 1, 0, 1, 0, -x1 * w1, 0};
}

TEST(Cradle, IsTheSimulationWithNinetyDigits) {
  Box box(14);
  for (int trial = 0; trial < trials(25); ++trial) {
    CradleParameters p{box.decades(-3.0, 3.0), box.decades(-3.0, 3.0), box.uniform(0.0, 0.5),
                       box.one_in(3) ? 0.0 : box.uniform(0.0, 0.5)};
    if (trial == 0) p = {};
    p.t_end = 40.0 / std::min(p.omega1, p.omega2);
    SCOPED_TRACE(testing::Message() << "seed 14, trial " << trial);
    expect_simulated(Cradle(p), raw(p), 6);
  }
}

TEST(Cradle, PerturbationsOfTheRestingMassGrowAsInTheSimulation) {
  const auto growth_of = [](const CradleParameters& p) {
    const double T1 = Cradle(p).flight_time(0), T2 = Cradle(p).flight_time(1);
    const Real small("1e-40"), cycle = Real(T1) + T2;
    // The state after two impacts, mass 2 resting again.
    const auto mapped = [&](const Real& u, const Real& v) {
      auto pair = raw(p);
      pair.u20 = u;
      pair.v20 = v;
      ImpactSimulator simulator(pair);
      simulator.next(cycle);
      simulator.next(cycle);
      const auto x = simulator.at(cycle);
      return std::array{double(x.u[1] / small), double(x.v[1] / small)};
    };
    const auto u = mapped(small, 0), v = mapped(0, small);
    Eigen::MatrixXd map(2, 2);
    map << u[0], v[0], u[1], v[1];
    const double decay = p.xi1 * p.omega1 * T1 + p.xi2 * p.omega2 * T2;
    return std::sqrt(
        std::max(1.0, numerics::eigenvalues(map).cwiseAbs().maxCoeff() * std::exp(decay)));
  };
  for (const CradleParameters& p :
       {CradleParameters{}, CradleParameters{1.0, 3.0, 0.3, 0.02, 60.0},
        CradleParameters{1.0, 1.4, 0.0, 0.0, 60.0}, CradleParameters{1.0, 2.5, 0.0, 0.0, 60.0}})
    EXPECT_NEAR(Cradle(p).perturbation_growth(), growth_of(p), 1e-9) << p.omega2;
  EXPECT_GT(Cradle({1.0, 2.5, 0.0, 0.0, 60.0}).perturbation_growth(), 1.5);
  EXPECT_NEAR(Cradle({1.0, 1.4, 0.0, 0.0, 60.0}).perturbation_growth(), 1.0, 1e-15);
}

TEST(Cradle, ParametersOutsideTheirRangesAreRefused) {
  EXPECT_REFUSED(Cradle({0.0, 1.0, 0.0, 0.0, 20.0}), "out-of-range", "cradle: omega1 = 0");
  EXPECT_REFUSED(Cradle({1.0, 1.0, 0.0, 1.0, 20.0}), "out-of-range", "xi2 = 1",
                 "does not come back");
  EXPECT_REFUSED(Cradle({1.0, 1.0, -0.1, 0.0, 20.0}), "out-of-range", "xi1 = -0.1",
                 "feed energy in");
  EXPECT_REFUSED(Cradle({1.0, 1.0, 0.0, 0.0, 1e13}), "out-of-range", "t_end = 10000000000000");
  EXPECT_REFUSED(Cradle(CradleParameters{}).at(21.0, Side::left), "time-outside", "t = 21");
  EXPECT_REFUSED(Cradle(CradleParameters{}).impact(100), "beyond-last-impact", "impact 100");
}

// Section by section as in the literature: particular solution at the impact, its slope, the force.
RawForce force_of(const Real& m, const Real& w, const Real& sigma, const Real& eta, const Real& T,
                  const Real& nu, const Real& D, const Real& V) {
  const Real e = exp(-sigma * T), c = cos(w * T), n = sin(w * T), h = (1 / e + e) / 2;
  const Real p = D - V * (1 + eta) * n / (2 * eta * w * (h - c));
  const Real slope = -(p - D) * (sigma + w * ((1 - eta) * c - 1 / e + eta * e) / ((1 + eta) * n));
  const Real square = w * w + sigma * sigma;
  const Real cosine = m * ((square - nu * nu) * p + 2 * sigma * slope);
  const Real sine = -m * ((square - nu * nu) * slope / nu - 2 * sigma * nu * p);
  // cos(nu (t - T/2) + phi): the impact is half a period T after t = 0.
  return {sqrt(cosine * cosine + sine * sine), nu, atan2(sine, cosine) - nu * T / 2};
}

RawPair raw(const ForcedPairParameters& p) {
  const Real T = p.T, nu = 2 * pi() * p.n / T, V2 = -Real(p.m1) * p.V1 / p.m2;
  RawPair pair{p.m1,
               p.m2,
               Real(p.m1) * (Real(p.omega1) * p.omega1 + Real(p.sigma1) * p.sigma1),
               Real(p.m2) * (Real(p.omega2) * p.omega2 + Real(p.sigma2) * p.sigma2),
               2 * Real(p.m1) * p.sigma1,
               2 * Real(p.m2) * p.sigma2,
               p.eta,
               Real(p.D2) - p.D1,
               0,
               0,
               0,
               0};
  pair.force1 = force_of(p.m1, p.omega1, p.sigma1, p.eta, T, nu, p.D1, p.V1);
  pair.force2 = force_of(p.m2, p.omega2, p.sigma2, p.eta, T, nu, p.D2, V2);
  // Started just after an impact, half a period earlier, it is at t = 0 what the simulation is there.
  auto early = pair;
  early.force1.phase += nu * T / 2;
  early.force2.phase += nu * T / 2;
  early.u10 = p.D1;
  early.u20 = p.D2;
  early.v10 = p.V1;
  early.v20 = V2;
  const auto middle = ImpactSimulator(early).at(T / 2);
  pair.u10 = middle.u[0];
  pair.u20 = middle.u[1];
  pair.v10 = middle.v[0];
  pair.v20 = middle.v[1];
  return pair;
}

ForcedPairParameters random_orbit(Box& box) {
  ForcedPairParameters p;
  p.m1 = box.decades(-1.0, 1.0);
  p.m2 = box.decades(-1.0, 1.0);
  p.omega1 = box.uniform(0.3, 2.5);
  p.omega2 = box.uniform(0.3, 3.5);
  p.sigma1 = box.one_in(4) ? 0.0 : box.uniform(0.0, 0.2);
  p.sigma2 = box.one_in(4) ? 0.0 : box.uniform(0.0, 0.2);
  p.eta = box.one_in(4) ? 1.0 : box.uniform(0.5, 1.0);
  p.T = box.uniform(1.5, 6.0);
  p.n = std::floor(box.uniform(1.0, 4.0));
  p.D1 = box.one_in(4) ? 0.0 : box.uniform(-0.5, 0.3);
  p.D2 = box.one_in(4) ? 0.0 : box.uniform(-0.3, 0.5);
  p.V1 = box.decades(-0.5, 0.5);
  p.t_end = 6.0 * p.T;
  return p;
}

TEST(ForcedPair, IsTheSimulationWithNinetyDigits) {
  Box box(15);
  int members = 0, stable = 0;
  for (int trial = 0; members < trials(15) && trial < 4000; ++trial) {
    auto p = random_orbit(box);
    if (trial == 0) p = {};
    SCOPED_TRACE(testing::Message() << "seed 15, trial " << trial);
    const auto text = test::refusal_of([&] { ForcedPair{p}; });
    if (text != "accepted") {
      EXPECT_TRUE(test::is_refusal(text, "not-admissible", {"forced-pair"})) << text;
      continue;
    }
    ++members;
    const ForcedPair orbit(p);
    if (std::abs(orbit.floquet_multipliers()[0]) < 1.0) ++stable;
    expect_simulated(orbit, raw(p), 3);
  }
  EXPECT_GE(members, trials(15));
  EXPECT_GT(stable, 0);
  EXPECT_LT(stable, members);
}

// Refused orbits touch early in the simulation too, accepted ones do not: both sides of the limit.
TEST(ForcedPair, IsRefusedWhereTheGapClosesEarly) {
  ForcedPairParameters p{.omega1 = 1.5, .omega2 = 0.8, .T = 5.0, .n = 1.0, .D1 = 0.25, .D2 = 0.0};
  p.V1 = 1.0;
  p.m2 = 0.5;
  const auto opens = [&](double m2) {
    auto other = p;
    other.m2 = m2;
    return test::refusal_of([&] { ForcedPair{other}; }) == "accepted";
  };
  ASSERT_TRUE(opens(0.5));
  ASSERT_FALSE(opens(10.0));
  double open = 0.5, closed = 10.0;
  for (int i = 0; i < 30; ++i)
    (opens(0.5 * (open + closed)) ? open : closed) = 0.5 * (open + closed);
  const auto first_impact = [&](double m2) {
    auto pair = p;
    pair.m2 = m2;
    const auto at_middle = raw(pair);
    ImpactSimulator simulator(at_middle);
    return double(simulator.next(Real(20))->before.t);
  };
  EXPECT_NEAR(first_impact(open), 2.5, 1e-12);
  p.m2 = closed * (1.0 + 1e-9);
  EXPECT_REFUSED(ForcedPair{p}, "not-admissible", "forced-pair: the masses meet",
                 "instead of T = 5 s", "overlap", "With ");
}

TEST(ForcedPair, MultipliersAreThoseOfTheSimulatedReturnMap) {
  for (const double eta : {0.8, 1.0}) {
    ForcedPairParameters p;
    p.eta = eta;
    const ForcedPair orbit(p);
    const Real T = p.T, small("1e-30");
    auto pair = raw(p);
    // From the middle of a flight to the middle of the next, which has the same multipliers.
    const auto mapped = [&](int entry, const Real& by) {
      auto start = pair;
      (entry == 0 ? start.u10 : entry == 1 ? start.u20 : entry == 2 ? start.v10 : start.v20) += by;
      ImpactSimulator simulator(start);
      simulator.next(T);
      const auto x = simulator.at(T);
      return std::array<Real, 4>{x.u[0], x.u[1], x.v[0], x.v[1]};
    };
    Eigen::MatrixXd map(4, 4);
    for (int j = 0; j < 4; ++j) {
      const auto plus = mapped(j, small), minus = mapped(j, -small);
      for (std::size_t i = 0; i < 4; ++i)
        map(Eigen::Index(i), j) = double((plus[i] - minus[i]) / (2 * small));
    }
    const Eigen::VectorXcd values = numerics::eigenvalues(map);
    for (const auto& multiplier : orbit.floquet_multipliers())
      EXPECT_LT((values.array() - multiplier).abs().minCoeff(), 1e-12);
  }
}

TEST(ForcedPair, EquationOfMotionHoldsWithTheProblemsOwnNumbers) {
  const ForcedPair orbit{ForcedPairParameters{}};
  const auto& s = orbit.problem().system;
  const auto* load = s.add_load.target<model::HarmonicLoad>();
  ASSERT_NE(load, nullptr);
  Box box(16);
  for (int i = 0; i < 200; ++i) {
    const double t = box.uniform(0.0, 40.0);
    const auto x = orbit.at(t, Side::right);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(2);
    s.add_load(t, {f.data(), 2});
    const Eigen::VectorXd rest = s.mass * x.a + s.damping * x.v + s.stiffness * x.u - f;
    // The phase of the load, 2.5 rad/s for 40 s, and 16 roundings of terms up to 2 N.
    EXPECT_LT(rest.cwiseAbs().maxCoeff(), (100.0 + 16.0) * 2.0 * 0x1p-53 * 2.0);
    // Periodic.
    if (t < 30.0 && std::abs(std::remainder(t - 2.5, 5.0)) > 1e-6) {
      const auto later = orbit.at(t + 5.0, Side::right);
      EXPECT_LT((later.u - x.u).cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

TEST(ForcedPair, WorkOfTheForcesIsWhatImpactsAndDashpotsTake) {
  const ForcedPair orbit{ForcedPairParameters{}};
  const auto& s = orbit.problem().system;
  // Simpson's rule over the flight between the first two impacts.
  const auto one = orbit.impact(1), two = orbit.impact(2);
  constexpr int n = 4000;
  double work = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double t = one.t + (two.t - one.t) * i / n;
    const auto v = orbit.at(t, i == 0 ? Side::right : Side::left).v;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(2);
    s.add_load(t, {f.data(), 2});
    work += (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * (f - s.damping * v).dot(v);
  }
  work *= (two.t - one.t) / n / 3.0;
  EXPECT_NEAR(work, two.energy_before - one.energy_after, 1e-11);
  // Newton's law and momentum.
  EXPECT_NEAR(one.after.v[0] - one.after.v[1], -0.8 * (one.before.v[0] - one.before.v[1]), 1e-15);
  EXPECT_NEAR((s.mass * (one.after.v - one.before.v)).sum(), 0.0, 1e-15);
}

TEST(BaseExcitedPair, IsTheSimulationWithNinetyDigits) {
  Box box(17);
  int members = 0;
  for (int trial = 0; members < trials(10) && trial < 4000; ++trial) {
    BaseExcitedParameters p{box.decades(-1.0, 1.0),
                            box.uniform(0.3, 3.0),
                            box.uniform(0.3, 3.0),
                            box.uniform(1.0, 5.0),
                            std::floor(box.uniform(1.0, 3.0)),
                            box.one_in(2) ? -1.0 : 1.0};
    if (trial == 0) p = {};
    p.t_end = 6.0 * p.T;
    SCOPED_TRACE(testing::Message() << "seed 17, trial " << trial);
    if (test::refusal_of([&] { ForcedPair{p}; }) != "accepted") continue;
    ++members;
    const Real T = p.T, nu = 2 * pi() * p.n / T, A = p.A_g;
    const auto velocity = [&](double w) {
      return A * w * tan(w * T / 2) / (Real(w) * w - nu * nu);
    };
    const Real m2 = -p.m1 * velocity(p.omega1) / velocity(p.omega2);
    RawPair pair{p.m1,
                 m2,
                 Real(p.m1) * p.omega1 * p.omega1,
                 m2 * p.omega2 * p.omega2,
                 0,
                 0,
                 1,
                 0,
                 0,
                 0,
                 velocity(p.omega1),
                 velocity(p.omega2)};
    pair.force1 = {-p.m1 * A, nu, 0};
    pair.force2 = {-m2 * A, nu, 0};
    const auto middle = ImpactSimulator(pair).at(T / 2);
    pair.u10 = middle.u[0];
    pair.u20 = middle.u[1];
    pair.v10 = middle.v[0];
    pair.v20 = middle.v[1];
    pair.force1.phase = pair.force2.phase = -nu * T / 2;
    expect_simulated(ForcedPair(p), pair, 3);
  }
  EXPECT_GE(members, trials(10));
}

// Resonance is a multiple of pi, not a phase that is large.
TEST(BaseExcitedPair, IsRefusedAsResonanceOnlyNearIt) {
  Box box(18);
  int refused = 0;
  for (int trial = 0; trial < 40; ++trial) {
    BaseExcitedParameters p;
    p.omega2 = box.uniform(0.5, 15.0);
    p.T = box.uniform(1.0, 8.0);
    if (trial % 4 == 0) p.omega2 = std::round(2.0 + p.omega2) * 3.14159265358979323846 / p.T;
    const auto text = test::refusal_of([&] { ForcedPair{p}; });
    const bool is_resonance = text.find("away from resonance") != std::string::npos;
    const double turns = p.omega2 * p.T / 3.14159265358979323846;
    EXPECT_EQ(is_resonance, std::abs(turns - std::round(turns)) < 1e-5) << p.omega2 << ' ' << p.T;
    refused += is_resonance ? 1 : 0;
  }
  EXPECT_EQ(refused, 10);
}

TEST(BaseExcitedPair, IsRefusedWithASentence) {
  BaseExcitedParameters p;
  p.A_g = 1.0;
  EXPECT_REFUSED(ForcedPair{p}, "not-admissible",
                 "base-excited-pair: after an impact mass 1 would have", "above 0 and below 0",
                 "With A_g = ");
  p.n = 1.5;
  EXPECT_REFUSED(ForcedPair{p}, "not-whole", "n = 1.5", "whole periods");
  p = {};
  p.A_g = 0.0;
  EXPECT_REFUSED(ForcedPair{p}, "out-of-range", "A_g = 0");
}

TEST(ForcedPair, ParametersOutsideTheirRangesAreRefused) {
  const auto with = [](auto change) {
    ForcedPairParameters p;
    change(p);
    return p;
  };
  using P = ForcedPairParameters;
  EXPECT_REFUSED(ForcedPair{with([](P& p) { p.eta = 0.0; })}, "out-of-range", "eta = 0", "plastic");
  EXPECT_REFUSED(ForcedPair{with([](P& p) { p.V1 = -1.0; })}, "out-of-range", "V1 = -1");
  EXPECT_REFUSED(ForcedPair{with([](P& p) { p.n = 0.0; })}, "out-of-range", "n = 0");
  EXPECT_REFUSED(ForcedPair{with([](P& p) { p.sigma1 = -1.0; })}, "out-of-range", "sigma1 = -1");
  EXPECT_REFUSED(ForcedPair{with([](P& p) { p.D1 = NAN; })}, "not-a-number", "D1 = nan");
  EXPECT_REFUSED(ForcedPair{with([](P& p) { p.t_end = 1e15; })}, "out-of-range", "t_end");
  // Undamped, with whole oscillations between impacts.
  EXPECT_REFUSED(ForcedPair{with([](P& p) {
                   p.sigma2 = 0.0;
                   p.omega2 = 4.0 * 3.14159265358979323846 / p.T;
                 })},
                 "not-admissible", "omega2 T = 4 pi", "away from resonance", "change T or omega2");
}

}  // namespace
}  // namespace clackers::exact
