// The second way: the closed form against a simulation with 90 digits that knows nothing of it
// (impact_simulator.hpp), over the whole box of parameters and its corners.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/testing/impact_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using testing_oracle::Box;
using testing_oracle::ImpactSimulator;
using testing_oracle::RawPair;
using testing_oracle::RawState;
using testing_oracle::Real;
using testing_oracle::trials;

RawPair raw(const PairParameters& p) {
  // Eq. (12), (13), (15), (17) with the ratio as mass 2 over mass 1.
  const double odd = p.X >= 1.0 ? p.X : std::round(1.0 / p.X);
  const Real X = p.X >= 1.0 ? Real(odd) : 1 / Real(odd);
  const int s = std::fmod(odd, 4.0) == 1.0 ? 1 : -1;
  const Real xi1 = p.xi1, omega1 = sqrt(Real(p.k1) / p.m1);
  const Real rest = (1 - xi1) * (1 + xi1) * X * X + xi1 * xi1;
  const Real omega2 = omega1 * sqrt(rest), xi2 = xi1 / sqrt(rest);
  RawPair pair;
  pair.m1 = p.m1;
  pair.m2 = Real(p.m1) / p.r;
  pair.k1 = p.k1;
  pair.k2 = pair.m2 * omega2 * omega2;
  pair.c1 = 2 * pair.m1 * xi1 * omega1;
  pair.c2 = 2 * pair.m2 * xi2 * omega2;
  pair.eta = p.eta;
  pair.gap = 0;
  pair.u10 = p.X < 1.0 ? s * Real(p.A) : Real(p.A);
  pair.u20 = -pair.u10 * s * p.r / X;
  pair.v10 = -xi1 * omega1 * pair.u10;
  pair.v20 = -xi2 * omega2 * pair.u20;
  return pair;
}

// The doubles that a method receives, as they stand.
RawPair raw(const model::ImpactProblem<>& problem) {
  const auto& s = problem.system;
  RawPair pair;
  pair.m1 = s.mass(0, 0);
  pair.m2 = s.mass(1, 1);
  pair.k1 = s.stiffness(0, 0);
  pair.k2 = s.stiffness(1, 1);
  pair.c1 = s.damping(0, 0);
  pair.c2 = s.damping(1, 1);
  pair.eta = problem.contacts.at(0).restitution;
  pair.gap = problem.contacts.at(0).gap;
  pair.u10 = problem.start.u[0];
  pair.u20 = problem.start.u[1];
  pair.v10 = problem.start.v[0];
  pair.v20 = problem.start.v[1];
  return pair;
}

// The simulation loses 1e-85 of the first amplitudes, eta^-k of that relative to the later ones:
// below 1e-40 for the members that follow, and nothing beside the bound of a double.
void expect_state(const ClosedForm& motion, const RawState& reference, double t) {
  const auto state = motion.at(t, Side::right);
  const auto bound = motion.error_bound(t);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    EXPECT_LE(abs(reference.u[i] - Real(state.u[m])), Real(bound.u[m]))
        << "u" << i + 1 << " t " << t;
    EXPECT_LE(abs(reference.v[i] - Real(state.v[m])), Real(bound.v[m]))
        << "v" << i + 1 << " t " << t;
    EXPECT_LE(abs(reference.a[i] - Real(state.a[m])), Real(bound.a[m]))
        << "a" << i + 1 << " t " << t;
  }
}

// 0.51 units of 2^-52 of each value itself, and one subnormal spacing. What is 0 in reference is only
// small in the simulation: `scale` says beside what.
void expect_value(const Real& reference, double value, const Real& scale, const char* what) {
  const Real bound = ldexp(abs(reference) * Real(0.51), -52) + Real(4.95e-324);
  if (value == 0.0)
    EXPECT_LE(abs(reference), abs(scale) * Real("1e-60") + bound) << what;
  else
    EXPECT_LE(abs(reference - Real(value)), bound) << what << " = " << value;
}

void expect_limit(const RawState& reference, const model::Kinematics& limit,
                  const RawState& scale) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    EXPECT_EQ(limit.u[m], 0.0);
    EXPECT_LE(abs(reference.u[i]), abs(scale.u[i]) * Real("1e-60"));
    expect_value(reference.v[i], limit.v[m], scale.v[i], "v");
    expect_value(reference.a[i], limit.a[m], scale.a[i], "a");
  }
}

// Flights, impact times, both limits, impulses and energies of the first `impacts` impacts.
void expect_simulated(const ClosedForm& motion, const RawPair& pair, long long impacts) {
  ImpactSimulator simulator(pair);
  const auto first = simulator.at(0);
  impacts = std::min(impacts, motion.impact_count(motion.end()));
  for (long long k = 1; k <= impacts; ++k) {
    SCOPED_TRACE(testing::Message() << "flight to impact " << k);
    const auto before = simulator;
    const auto found = simulator.next(Real(motion.end()));
    ASSERT_TRUE(found);
    const Real flight = found->before.t - before.flight_start();
    for (const double part : {0.31, 0.87}) {
      const double t = double(before.flight_start() + part * flight);
      expect_state(motion, before.at(t), t);
    }
    const auto hit = motion.impact(k);
    EXPECT_TRUE(Real(hit.when.lo) < found->before.t && found->before.t < Real(hit.when.hi));
    RawState scale = first;
    scale.v = found->before.v;
    expect_limit(found->before, hit.before, scale);
    expect_limit(found->after, hit.after, scale);
    expect_value(found->impulse, hit.impulse, 0, "impulse");
    expect_value(found->energy_before, hit.energy_before, simulator.energy(first), "energy before");
    expect_value(found->energy_after, hit.energy_after, found->energy_before, "energy after");
  }
}

// Long enough for a few impacts of the slow mass.
PairParameters with_end(PairParameters p, double half_periods) {
  const double damped = std::sqrt(p.k1 / p.m1) * std::sqrt((1.0 - p.xi1) * (1.0 + p.xi1));
  p.t_end = half_periods * M_PI / (p.X < 1.0 ? damped * p.X : damped);
  return p;
}

TEST(Simulation, AgreesWithTheClosedFormOfRandomPairs) {
  constexpr unsigned seed = 20260201;
  Box box(seed);
  for (int i = 0; i < trials(280); ++i) {
    const double most = box.one_in(4) ? 60.0 : 6.0;
    const double odd = 2.0 * std::floor(box.uniform(0.0, most)) + 1.0;
    PairParameters p{.m1 = box.decades(-8.0, 8.0),
                     .k1 = box.decades(-8.0, 8.0),
                     .xi1 = box.damping_ratio(),
                     .A = box.decades(-8.0, 8.0),
                     .X = odd,
                     .r = box.decades(-3.0, 3.0)};
    // Up to the very limit, where the masses nearly graze in every flight.
    if (odd > 1.0)
      p.r =
          r_star(odd) * (box.one_in(3) ? 1.0 - box.decades(-12.0, -1.0) : box.uniform(0.01, 0.99));
    // After an impact with a tiny eta the simulation has lost that many digits.
    if (!box.one_in(3)) p.eta = box.one_in(4) ? box.decades(-12.0, 0.0) : box.uniform(0.1, 1.0);
    if (box.one_in(8)) p.eta = 0.0;
    if (odd > 1.0 && box.one_in(3)) {
      p.X = 1.0 / odd;
      p.r = 1.0 / p.r;
    }
    const int impacts = p.eta >= 0.1 && box.one_in(10) ? 8 : 2;
    p = with_end(p, impacts + 1.0);
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " X = " << p.X
                                    << " r = " << p.r << " eta = " << p.eta << " xi1 = " << p.xi1);
    expect_simulated(SynchronizedPair(p), raw(p), impacts);
  }
}

TEST(Simulation, AgreesWithTheClosedFormInTheCornersOfTheBox) {
  constexpr double nearly_critical = 1.0 - 0x1p-53, hardly_damped = 1e-14;
  for (const double X : {1.0, 3.0, 9.0, 1.0 / 3.0, 1.0 / 9.0, 1001.0})
    for (const double xi1 : {0.0, hardly_damped, 0.05, nearly_critical})
      for (const double eta : {0.0, 0.5, 1.0}) {
        const double limit = X == 1.0 ? 1e4 : r_star(X < 1.0 ? std::round(1.0 / X) : X);
        const double r = std::nextafter(limit, 0.0);
        // The doubles of 1/r* and 1/9 are rounded: a little more module is left.
        const PairParameters p =
            with_end({.xi1 = xi1, .X = X, .r = X < 1.0 ? 1.000001 / r : r, .eta = eta}, 2.5);
        SCOPED_TRACE(testing::Message() << "X = " << X << " xi1 = " << xi1 << " eta = " << eta);
        expect_simulated(SynchronizedPair(p), raw(p), X == 1001.0 ? 1 : 2);
      }
  const auto fast = with_end({.xi1 = 0.01, .X = 40001.0, .r = 4.5, .eta = 0.9}, 1.5);
  expect_simulated(SynchronizedPair(fast), raw(fast), 1);
}

TEST(Simulation, OfTheModelInputsAgreesWithExactDataAsTheyStand) {
  // Every number of the problem is exact here, so the doubles that a method receives are simulated.
  constexpr unsigned seed = 20260202;
  Box box(seed);
  for (int i = 0; i < trials(20); ++i) {
    const auto dyadic = [&](double low, double high, double grain) {
      return std::round(box.uniform(low, high) / grain) * grain;
    };
    const ExactDataParameters p{.m2 = dyadic(0.5, 8.0, 0.25),
                                .Omega = dyadic(0.5, 4.0, 0.0625),
                                .sigma = box.one_in(3) ? 0.0 : dyadic(0.0, 0.5, 0x1p-7),
                                .A_over_X = dyadic(0.125, 2.0, 0.125),
                                .X = dyadic(0.0, 20.0, 1.0) * 2.0 + 5.0,
                                .r = dyadic(0.125, 3.875, 0.125),
                                .eta = dyadic(0.25, 1.0, 0x1p-10),
                                .t_end = 30.0};
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " X = " << p.X);
    const ExactDataPair motion(p);
    expect_simulated(motion, raw(motion.problem()), 3);
  }
}

TEST(Simulation, ContactHappensWhereARefusedMassRatioSaysItWould) {
  // The first contact is then before T/2 and away from equilibrium; close above r* it is a dip of
  // 1e-9 of the amplitude.
  const double limit = r_star(9.0);
  for (const auto& p : {PairParameters{.r = limit * (1.0 + 1e-9)}, PairParameters{.r = 4.42},
                        PairParameters{.r = 5.0}, PairParameters{.r = 8.0},
                        PairParameters{.X = 1.0 / 9.0, .r = 0.2}}) {
    const auto hit = ImpactSimulator(raw(p)).next(20).value();
    std::string message;
    try {
      SynchronizedPair refused(p);
    } catch (const InputError& error) {
      message = error.what();
    }
    const auto expect_told = [&](const std::string& words, const Real& value) {
      const auto at = message.find(words);
      ASSERT_NE(at, std::string::npos) << message;
      // Six digits are printed.
      const double reference = double(value);
      EXPECT_NEAR(std::stod(message.substr(at + words.size())), reference,
                  1e-5 * std::abs(reference))
          << message;
    };
    expect_told("at t = ", hit.before.t);
    expect_told("u1 = u2 = ", hit.before.u[0]);
    expect_told("The value is ", p.r / (p.X < 1.0 ? 1.0 / limit : limit));
  }
}

}  // namespace
}  // namespace clackers::exact
