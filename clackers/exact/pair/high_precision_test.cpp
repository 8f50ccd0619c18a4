#include "clackers/exact/pair/closed_form.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::exact {
namespace {

using namespace testing_oracle;
using model::Side;

// The message and code of a refusal.
std::string refusal(auto call) {
  try {
    call();
    return "accepted";
  } catch (const InputError& error) {
    return std::string(error.what()) + " [" + std::string(error.code().name()) + "]";
  }
}

void expect_in(const std::string& text, std::string_view part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\n  lacks: " << part;
}

TEST(SynchronizedPair, InputsAreTheNearestDoublesOfTheFormulas) {
  constexpr unsigned seed = 20260301;
  Box box(seed);
  for (int i = 0; i < trials(100); ++i) {
    const auto p = box.pair();
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i);
    const SynchronizedPair pair(p);
    const auto problem = pair.problem();
    const auto o = oracle_of(p);
    ASSERT_EQ(problem.dof(), 2);
    for (int m = 0; m < 2; ++m) {
      const auto& mass = o.mass[m];
      const auto nearest = [](const Real& x) { return double(x); };
      EXPECT_EQ(problem.system.mass(m, m), nearest(mass.mass));
      EXPECT_EQ(problem.system.damping(m, m), nearest(2 * mass.mass * o.sigma));
      EXPECT_EQ(problem.system.stiffness(m, m),
                nearest(mass.mass * (mass.frequency * mass.frequency + o.sigma * o.sigma)));
      EXPECT_EQ(problem.start.u[m], nearest(mass.start));
      EXPECT_EQ(problem.start.v[m], nearest(-o.sigma * mass.start));
      EXPECT_EQ(problem.system.mass(m, 1 - m), 0.0);
      EXPECT_EQ(problem.system.damping(m, 1 - m), 0.0);
      EXPECT_EQ(problem.system.stiffness(m, 1 - m), 0.0);
    }
    // What was given comes back as it was.
    EXPECT_EQ(problem.system.mass(0, 0), p.m1);
    EXPECT_EQ(problem.system.stiffness(0, 0), p.k1);
    EXPECT_EQ(std::abs(problem.start.u[0]), p.A);
    EXPECT_EQ(problem.start.t, 0.0);
    EXPECT_EQ(problem.end, p.t_end);
    ASSERT_EQ(problem.contacts.size(), 1U);
    EXPECT_EQ(problem.contacts[0].direction, (Eigen::Vector2d(1.0, -1.0)));
    EXPECT_EQ(problem.contacts[0].gap, 0.0);
    EXPECT_EQ(problem.contacts[0].restitution, p.eta);
    EXPECT_FALSE(problem.system.add_load);
    EXPECT_GT(problem.contacts[0].gap_at(problem.start.u), 0.0);
    EXPECT_NO_THROW(model::validate(problem));
  }
}

TEST(SynchronizedPair, DerivedConstantsAreThoseOfThePaper) {
  const SynchronizedPair pair({.xi1 = 0.05, .X = 9.0, .r = 3.0});
  const auto& c = pair.constants();
  // Eq. (19) with N = 2, to the rounding of these expressions.
  EXPECT_DOUBLE_EQ(c.m2, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(c.k2, (0.9975 * 81.0 + 0.0025) / 3.0);
  EXPECT_DOUBLE_EQ(c.xi2, 0.05 / std::sqrt(0.9975 * 81.0 + 0.0025));
  EXPECT_DOUBLE_EQ(c.u2, -1.0 / 3.0);
  EXPECT_DOUBLE_EQ(c.v2, 0.05 / 3.0);
  EXPECT_DOUBLE_EQ(c.v1, -0.05);
  EXPECT_DOUBLE_EQ(c.omega1, 1.0);
  EXPECT_DOUBLE_EQ(c.omega2, std::sqrt(0.9975 * 81.0 + 0.0025));
  EXPECT_DOUBLE_EQ(c.omega_D1, std::sqrt(0.9975));
  EXPECT_DOUBLE_EQ(c.omega_D2, 9.0 * std::sqrt(0.9975));
  EXPECT_DOUBLE_EQ(c.c1, 0.1);
  EXPECT_DOUBLE_EQ(c.c2, 0.1 / 3.0);
  EXPECT_EQ(c.sigma, 0.05);
  EXPECT_EQ(c.xi1, 0.05);
  EXPECT_EQ(c.m1, 1.0);
  EXPECT_EQ(c.k1, 1.0);
  EXPECT_EQ(c.u1, 1.0);
  EXPECT_DOUBLE_EQ(c.period, M_PI / std::sqrt(0.9975));
  EXPECT_DOUBLE_EQ(c.first_impact, M_PI / std::sqrt(0.9975) / 2.0);
  EXPECT_NEAR(c.r_star, 4.4136778, 1e-7);
  EXPECT_DOUBLE_EQ(c.margin, 1.0 - 3.0 / c.r_star);
  EXPECT_EQ(pair.constants().r, 3.0);
}

TEST(SynchronizedPair, ExchangedRolesAreTheSamePairUpsideDown) {
  // Seen from above, mass 2 is the slow one: m1' = m2, amplitude |u2(0)| and so on. X = 8 halves of
  // powers of two keep every number exact but 1/X.
  for (const double odd : {5.0, 7.0}) {
    const PairParameters fast_above{.m1 = 2.0,
                                    .k1 = 2.0,
                                    .xi1 = 0.0,
                                    .A = 0.25,
                                    .X = 1.0 / odd,
                                    .r = 0.5,
                                    .eta = 0.5,
                                    .t_end = 100.0};
    const SynchronizedPair pair(fast_above);
    const auto& c = pair.constants();
    EXPECT_DOUBLE_EQ(c.m2, 4.0);
    EXPECT_DOUBLE_EQ(c.omega_D2, c.omega_D1 / odd);
    EXPECT_DOUBLE_EQ(c.u2, -0.25 * 0.5 * odd);
    EXPECT_EQ(c.u1, odd == 5.0 ? 0.25 : -0.25);
    // Momentum at impact is zero, mass 1 comes down.
    const auto hit = pair.impact(2);
    EXPECT_NEAR(2.0 * hit.before.v[0] + 4.0 * hit.before.v[1], 0.0, 4e-16);
    EXPECT_LT(hit.before.v[0], 0.0);
    EXPECT_DOUBLE_EQ(hit.impulse, 1.5 * 2.0 * -hit.before.v[0]);
  }
}

TEST(SynchronizedPair, EquationOfMotionHoldsInFlight) {
  constexpr unsigned seed = 20260302;
  Box box(seed);
  for (int i = 0; i < trials(50); ++i) {
    const auto p = box.pair(3.0);
    const SynchronizedPair pair(p);
    const auto problem = pair.problem();
    const double t = box.uniform(0.0, std::min(p.t_end, 50.0 / pair.constants().omega_D1));
    const auto now = pair.at(t, Side::left);
    const auto envelope = pair.envelope(t);
    for (int m = 0; m < 2; ++m) {
      const double mass = problem.system.mass(m, m), c = problem.system.damping(m, m),
                   k = problem.system.stiffness(m, m);
      // Every term is below 2 k |b| E; each of the three and its coefficient is rounded twice.
      EXPECT_NEAR(mass * now.a[m] + c * now.v[m] + k * now.u[m], 0.0,
                  std::ldexp(12.0 * k * envelope.u[m], -53) + 1e-300)
          << "seed " << seed << " trial " << i << " mass " << m + 1;
    }
  }
}

TEST(SynchronizedPair, RefusesEachParameterOutsideItsRangeInWords) {
  const auto of = [](const PairParameters& p) {
    return refusal([&] { SynchronizedPair pair(p); });
  };
  for (const double bad : {0.0, -1.0, 1e-61, 2e60, double(NAN), double(INFINITY)}) {
    expect_in(of({.m1 = bad}), "synchronized-pair: m1 = ");
    expect_in(of({.k1 = bad}), "synchronized-pair: k1 = ");
    expect_in(of({.A = bad}), "synchronized-pair: A = ");
    expect_in(of({.X = 1.0, .r = bad}), "synchronized-pair: r = ");
    expect_in(of({.m1 = bad}), "1e-60 <= m1 <= 1e+60");
  }
  expect_in(of({.m1 = NAN}), "[not-a-number]");
  expect_in(of({.m1 = INFINITY}), "[not-finite]");
  expect_in(of({.m1 = -1.0}), "It must be positive. [out-of-range]");
  expect_in(of({.m1 = 1e61}), "Choose other units");
  for (const double bad : {-0.1, 1.0, 1.5, 1e-61, double(NAN)})
    expect_in(of({.xi1 = bad}), "allowed: 0 or 1e-60 <= xi1 < 1");
  expect_in(of({.xi1 = 1.0}), "does not oscillate");
  expect_in(of({.xi1 = -0.1}), "feed energy");
  expect_in(of({.xi1 = 1e-61}), "Below 1e-60 use 0");
  for (const double bad : {-0.1, std::nextafter(1.0, 2.0), double(NAN)})
    expect_in(of({.eta = bad}), "0 <= eta <= 1");
  for (const double bad : {0.0, -20.0, double(NAN), double(INFINITY)})
    expect_in(of({.t_end = bad}), "t_end");
  expect_in(of({.t_end = -20.0}), "[out-of-range]");
  expect_in(of({.xi1 = 0.0, .t_end = 4e15}),
            "0 < t_end <= 3537118876014219.5 s, which is 2^50 half periods");
  EXPECT_EQ(of({.xi1 = 0.0, .t_end = 3537118876014219.5}), "accepted");
  for (const double good : {1e-60, 1e60}) EXPECT_EQ(of({.m1 = good, .t_end = 1e-16}), "accepted");
  expect_in(refusal([] { SynchronizedPair pair({.eta = 2.0}, "three-parameter"); }),
            "three-parameter: eta = 2");
}

TEST(SynchronizedPair, TakesOddRatiosAndOneOverOddOnly) {
  const auto of = [](double X) {
    return refusal([&] { SynchronizedPair pair({.X = X, .r = X < 1.0 ? 1.0 : 0.5}); });
  };
  for (const double good :
       {1.0, 3.0, 400001.0, 999999999.0, 1.0 / 3.0, 1.0 / 49.0, 1.0 / 400001.0, 1.0 / 999999999.0})
    EXPECT_EQ(of(good), "accepted");
  for (const double bad : {2.0, 8.0, 9.5, 0.5, 0.11, 0.3333, 1.0 / 8.0})
    expect_in(of(bad), "[not-odd]");
  for (const double bad : {0.0, -3.0, 1e9 + 1.0, 1e-10}) expect_in(of(bad), "[out-of-range]");
  expect_in(of(NAN), "[not-a-number]");
  expect_in(of(INFINITY), "[not-finite]");
  expect_in(of(8.0), "Nearest: 7 or 9.");
  expect_in(of(9.5), "Nearest: 9 or 11.");
  expect_in(of(std::nextafter(9.0, 0.0)), "Nearest: 7 or 9.");
  expect_in(of(0.5), "Nearest: 1 over 1 or 3");
  expect_in(of(0.11), "Nearest: 1 over 9 or 11");
  expect_in(of(0.3333), "0.3333333333333333");
}

TEST(ExactDataPair, GivesAMethodTheTrueSystem) {
  for (const auto& p : {ExactDataParameters{}, ExactDataParameters{.m2 = 0.75,
                                               .Omega = 1.25,
                                               .sigma = 0.125,
                                               .A_over_X = 0.5,
                                               .X = 400001.0,
                                               .r = 1.5,
                                               .eta = 0.9,
                                               .t_end = 1e6}}) {
    const ExactDataPair pair(p);
    const auto problem = pair.problem();
    const auto o = oracle_of(p);
    for (int m = 0; m < 2; ++m) {
      const auto& mass = o.mass[m];
      EXPECT_TRUE(Real(problem.system.mass(m, m)) == mass.mass);
      EXPECT_TRUE(Real(problem.system.damping(m, m)) == 2 * mass.mass * o.sigma);
      EXPECT_TRUE(Real(problem.system.stiffness(m, m)) ==
                  mass.mass * (mass.frequency * mass.frequency + o.sigma * o.sigma));
      EXPECT_TRUE(Real(problem.start.u[m]) == mass.start);
      EXPECT_TRUE(Real(problem.start.v[m]) == -o.sigma * mass.start);
    }
    EXPECT_EQ(problem.end, p.t_end);
    EXPECT_EQ(problem.contacts.at(0).restitution, p.eta);
    EXPECT_EQ(pair.constants().omega_D1, p.Omega);
    EXPECT_EQ(std::get<ExactDataParameters>(pair.parameters()).X, p.X);
  }
}

TEST(ExactDataPair, MovesAsTheFormulaSays) {
  const ExactDataParameters undamped{.sigma = 0.0, .X = 399999.0, .r = 1.25, .t_end = 1e9};
  const ExactDataParameters damped{
      .sigma = 0x1p-7, .X = 399999.0, .r = 1.25, .eta = 0.75, .t_end = 1e9};
  for (const auto& p : {undamped, damped}) {
    const ExactDataPair pair(p);
    const auto o = oracle_of(p);
    for (const double t : {0.0, 1.0, 100.0, 1e3 / 3.0, p.sigma == 0.0 ? 1e9 : 1e3}) {
      const auto state = pair.at(t, Side::right);
      const auto reference = o.state(t, Side::right);
      for (int m = 0; m < 2; ++m) {
        EXPECT_LE(abs(reference.u[m] - Real(state.u[m])),
                  ldexp(reference.u_env[m] * Real(0.51), -52));
        EXPECT_LE(abs(reference.v[m] - Real(state.v[m])),
                  ldexp(reference.v_env[m] * Real(0.51), -52));
        EXPECT_LE(abs(reference.a[m] - Real(state.a[m])),
                  ldexp(reference.a_env[m] * Real(0.51), -52));
      }
    }
  }
}

TEST(ExactDataPair, RefusesDataThatDoublesCannotHold) {
  const auto of = [](const ExactDataParameters& p) {
    return refusal([&] { ExactDataPair pair(p); });
  };
  // One too long product or sum each.
  expect_in(of({.m2 = 1.1, .r = 1.1}), "m1 = r m2 = 1.21");
  expect_in(of({.sigma = 0.1, .r = 0.75}), "c1 = 2 m1 sigma");
  expect_in(of({.sigma = 0.1}), "k1 = m1 (Omega^2 + sigma^2)");
  expect_in(of({.Omega = 1.0 / 1024, .sigma = 0x1p-36, .X = 4097.0}),
            "k2 = m2 (X^2 Omega^2 + sigma^2)");
  expect_in(of({.A_over_X = 0.1}), "u1(0) = X (A/X)");
  expect_in(of({.A_over_X = 1.0 - 0x1p-45, .X = 1.0, .r = 1.0 + 0x1p-10}), "|u2(0)| = r (A/X)");
  expect_in(of({.sigma = 1.0 + 0x1p-15, .A_over_X = 1.0 - 0x1p-40, .X = 1.0}),
            "|v1(0)| = sigma u1(0)");
  expect_in(of({.sigma = 1.0 + 0x1p-10, .A_over_X = 1.0 - 0x1p-40, .X = 1.0, .r = 1.0 + 0x1p-5}),
            "|v2(0)| = sigma |u2(0)|");
  expect_in(of({.sigma = 0.1}), "[not-exact-data]");
  expect_in(of({.sigma = 0.1}), "0.0625");
  // And the ordinary ranges.
  expect_in(of({.m2 = -1.0}), "m2 = -1");
  expect_in(of({.Omega = 0.0}), "Omega = 0");
  expect_in(of({.sigma = -0.5}), "sigma = -0.5");
  expect_in(of({.A_over_X = NAN}), "[not-a-number]");
  expect_in(of({.X = 1.0 / 3.0}), "swap the masses");
  expect_in(of({.X = 4.0}), "[not-odd]");
  expect_in(of({.r = 1e31}), "r = 1e+31");
  expect_in(of({.eta = 1.5}), "eta = 1.5");
  expect_in(of({.t_end = 0.0}), "t_end = 0");
  EXPECT_EQ(of({.sigma = 0.0}), "accepted");
  EXPECT_EQ(of({.eta = 0.1, .t_end = 0.3}), "accepted");  // these need not be short
}

TEST(SingleMass, ProblemsAreThoseOfEquations3And5) {
  const FreeMass free({.xi1 = 0.25, .t_end = 7.0});
  const RigidStop stop({.xi1 = 0.25, .eta = 0.5, .t_end = 7.0});
  for (const auto& problem : {free.problem(), stop.problem()}) {
    ASSERT_EQ(problem.dof(), 1);
    EXPECT_EQ(problem.system.mass(0, 0), 1.0);
    EXPECT_EQ(problem.system.damping(0, 0), 0.5);
    EXPECT_EQ(problem.system.stiffness(0, 0), 1.0);
    EXPECT_EQ(problem.start.u[0], 1.0);
    EXPECT_EQ(problem.start.v[0], -0.25);
    EXPECT_EQ(problem.end, 7.0);
  }
  EXPECT_TRUE(free.problem().contacts.empty());
  ASSERT_EQ(stop.problem().contacts.size(), 1U);
  EXPECT_EQ(stop.problem().contacts[0].direction[0], 1.0);
  EXPECT_EQ(stop.problem().contacts[0].restitution, 0.5);
  EXPECT_EQ(stop.problem().contacts[0].gap, 0.0);
  EXPECT_FALSE(std::signbit(FreeMass({.xi1 = 0.0}).problem().start.v[0]));
  EXPECT_EQ(std::get<FreeMassParameters>(free.parameters()).xi1, 0.25);
  EXPECT_EQ(std::get<RigidStopParameters>(stop.parameters()).eta, 0.5);
}

TEST(SingleMass, RefusesWhatThePairRefuses) {
  expect_in(refusal([] { FreeMass mass({.xi1 = 1.0}); }), "sdof: xi1 = 1");
  expect_in(refusal([] { FreeMass mass({.t_end = 0.0}); }), "sdof: t_end = 0");
  expect_in(refusal([] { RigidStop mass({.xi1 = -0.5}); }), "stop: xi1 = -0.5");
  expect_in(refusal([] { RigidStop mass({.eta = 1.5}); }), "stop: eta = 1.5");
  expect_in(refusal([] { RigidStop mass({.t_end = INFINITY}); }), "stop: t_end = inf");
}

}  // namespace
}  // namespace clackers::exact
