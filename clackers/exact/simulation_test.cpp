// The second way: an event-driven simulation in MPFR with 90 digits that knows nothing of the
// closed form. It starts from masses, stiffnesses, dampings and the initial state, follows each
// mass in free flight from one impact to the next, finds the contact by scanning the gap, bisecting
// and Newton steps, and applies Newton's law with conserved momentum.
#include <gtest/gtest.h>

#include <string>

#include "clackers/base/error.hpp"
#include "clackers/exact/test_oracle.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using testing_oracle::Box;
using testing_oracle::Real;
using testing_oracle::trials;

struct Body {
  Real m, c, k, u, v;

  // Free damped vibration over dt from the state (u, v), for c^2 < 4 m k.
  void fly(const Real& dt) {
    const Real s = c / (2 * m), w = sqrt(k / m - s * s);
    const Real e = exp(-s * dt), x = cos(w * dt), y = sin(w * dt);
    const Real u1 = e * (u * x + (v + s * u) / w * y);
    v = e * (v * x - (s * v + k / m * u) / w * y);
    u = u1;
  }
  Real energy() const { return (m * v * v + k * u * u) / 2; }
};

struct Pair {
  Body one, two;
  Real eta;

  Real gap(const Real& dt) const {
    Body a = one, b = two;
    a.fly(dt);
    b.fly(dt);
    return a.u - b.u;
  }

  // Time to the next contact after dt > 0, scanned with the given step.
  Real next_contact(const Real& step) const {
    // Just after an impact the gap is zero to rounding and opening.
    Real from = step;
    if (gap(from) <= 0) return -1;
    for (int i = 0; gap(from + step) > 0; ++i) {
      from += step;
      if (i > 100000) return -1;
    }
    // Bisection until Newton's step cannot leave the neighbourhood, then 2^-20 squared five times.
    Real to = from + step;
    for (int i = 0; i < 20; ++i) {
      const Real middle = (from + to) / 2;
      (gap(middle) > 0 ? from : to) = middle;
    }
    for (int i = 0; i < 5; ++i) {
      Body a = one, b = two;
      a.fly(to);
      b.fly(to);
      to -= (a.u - b.u) / (a.v - b.v);
    }
    return to;
  }

  Real impact() {
    const Real closing = one.v - two.v, reduced = one.m * two.m / (one.m + two.m);
    const Real impulse = -(1 + eta) * reduced * closing;
    one.v += impulse / one.m;
    two.v -= impulse / two.m;
    return impulse;
  }
};

Pair start_of(const PairParameters& p) {
  // Eq. (12), (13), (15), (17) with the ratio as mass 2 over mass 1.
  const Real X = p.X >= 1.0 ? Real(p.X) : 1 / Real(std::round(1.0 / p.X));
  const double odd = p.X >= 1.0 ? p.X : std::round(1.0 / p.X);
  const int s = std::fmod(odd, 4.0) == 1.0 ? 1 : -1;
  const Real xi1 = p.xi1, omega1 = sqrt(Real(p.k1) / p.m1);
  const Real xi2 = xi1 / sqrt(X * X - xi1 * xi1 * X * X + xi1 * xi1);
  const Real omega2 = omega1 * sqrt((1 - xi1 * xi1) * X * X + xi1 * xi1);
  const Real m2 = Real(p.m1) / p.r;
  const Real u1 = p.X < 1.0 ? s * Real(p.A) : Real(p.A);
  const Real u2 = -u1 * s * p.r / X;
  Pair pair;
  pair.eta = p.eta;
  pair.one = {p.m1, 2 * p.m1 * xi1 * omega1, p.k1, u1, -xi1 * omega1 * u1};
  pair.two = {m2, 2 * m2 * xi2 * omega2, m2 * omega2 * omega2, u2, -xi2 * omega2 * u2};
  return pair;
}

Pair start_of(const model::ImpactProblem<>& problem) {
  const auto body = [&](Eigen::Index i) {
    return Body{problem.system.mass(i, i), problem.system.damping(i, i),
                problem.system.stiffness(i, i), problem.start.u[i], problem.start.v[i]};
  };
  return {body(0), body(1), problem.contacts.at(0).restitution};
}

// Half an ulp of the value, and what the simulation has lost: its 1e-88 grows at most e^lambda a
// collision (mathematics.md, section 3; lambda < 8 for the ratios below), 12 collisions long.
void expect_near(const Real& truth, double value, const Real& scale) {
  EXPECT_LE(abs(truth - Real(value)), ldexp(abs(scale) * Real(0.51), -52) + Real(1e-322));
}

void expect_simulated(const ClosedForm& motion, Pair pair, double X, int impacts) {
  const Real fastest = sqrt(std::max(Real(pair.one.k / pair.one.m), Real(pair.two.k / pair.two.m)));
  const Real step = Real(0.1) / fastest;
  Real now = 0;
  for (int k = 1; k <= impacts; ++k) {
    const Real flight = pair.next_contact(step);
    ASSERT_GT(flight, 0) << "impact " << k;
    // Inside the flight, at times that are doubles.
    for (const double part : {0.31, 0.87}) {
      const double t = (now + flight * part).convert_to<double>();
      Pair there = pair;
      there.one.fly(Real(t) - now);
      there.two.fly(Real(t) - now);
      const auto state = motion.at(t, Side::right);
      const auto envelope = motion.envelope(t);
      int i = 0;
      for (const auto& body : {there.one, there.two}) {
        const Real a = -(body.c * body.v + body.k * body.u) / body.m;
        expect_near(body.u, state.u[i], envelope.u[i]);
        expect_near(body.v, state.v[i], envelope.v[i]);
        expect_near(a, state.a[i], envelope.a[i]);
        ++i;
      }
    }
    pair.one.fly(flight);
    pair.two.fly(flight);
    now += flight;
    const auto hit = motion.impact(k);
    EXPECT_TRUE(Real(hit.when.lo) < now && now < Real(hit.when.hi)) << k << " X " << X;
    EXPECT_LT(abs(pair.one.u), Real(1e-60));
    expect_near(pair.one.v, hit.before.v[0], pair.one.v);
    expect_near(pair.two.v, hit.before.v[1], pair.two.v);
    expect_near(pair.one.energy() + pair.two.energy(), hit.energy_before, hit.energy_before);
    const Real impulse = pair.impact();
    expect_near(impulse, hit.impulse, impulse);
    expect_near(pair.one.v, hit.after.v[0], hit.after.v[0] == 0.0 ? Real(1e-40) : pair.one.v);
    expect_near(pair.two.v, hit.after.v[1], hit.after.v[1] == 0.0 ? Real(1e-40) : pair.two.v);
    expect_near(pair.one.energy() + pair.two.energy(), hit.energy_after,
                hit.energy_after == 0.0 ? Real(1e-80) : Real(hit.energy_after));
  }
}

TEST(Simulation, AgreesWithTheClosedFormOfChosenPairs) {
  for (const auto& p :
       {PairParameters{}, PairParameters{.xi1 = 0.0, .X = 1.0, .r = 1.0},
        PairParameters{.m1 = 3.0, .k1 = 40.0, .xi1 = 0.3, .A = 0.7, .X = 3.0, .r = 2.9},
        PairParameters{.X = 7.0, .r = 0.25, .eta = 0.5},
        PairParameters{.X = 21.0, .r = 4.5, .eta = 0.9},
        PairParameters{.X = 1.0 / 5.0, .r = 0.5, .eta = 0.8, .t_end = 100.0},
        PairParameters{.X = 1.0 / 7.0, .r = 4.0, .t_end = 150.0}}) {
    SCOPED_TRACE(testing::Message() << "X = " << p.X << " r = " << p.r << " eta = " << p.eta);
    const SynchronizedPair motion(p);
    expect_simulated(motion, start_of(p), p.X,
                     static_cast<int>(std::min(6LL, motion.impact_count(p.t_end))));
  }
}

TEST(Simulation, AgreesWithTheClosedFormOfRandomPairs) {
  constexpr unsigned seed = 20260201;
  Box box(seed);
  for (int i = 0; i < trials(6); ++i) {
    const double odd = 2.0 * std::floor(box.uniform(0.0, 6.0)) + 1.0;
    PairParameters p{.m1 = box.decades(-3.0, 3.0),
                     .k1 = box.decades(-3.0, 3.0),
                     .xi1 = box.uniform(0.0, 0.6),
                     .A = box.decades(-2.0, 2.0),
                     .X = odd,
                     .r = box.uniform(0.1, 2.99),
                     .eta = box.uniform(0.3, 1.0)};
    if (box.one_in(2)) {
      p.X = 1.0 / odd;
      p.r = 1.0 / p.r;
    }
    p.t_end = 30.0 * odd / std::sqrt(p.k1 / p.m1);
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " X = " << p.X);
    expect_simulated(SynchronizedPair(p), start_of(p), p.X, 3);
  }
}

TEST(Simulation, OfTheModelInputsAgreesWithTheExactDataPairAsItStands) {
  // Every number of the problem is exact here, so the doubles that a method receives are simulated.
  const ExactDataPair motion({});
  expect_simulated(motion, start_of(motion.problem()), 9.0, 6);
  const ExactDataPair other({.m2 = 0.75,
                             .Omega = 1.25,
                             .sigma = 0.125,
                             .A_over_X = 0.5,
                             .X = 7.0,
                             .r = 3.5,
                             .eta = 0.625});
  expect_simulated(other, start_of(other.problem()), 7.0, 6);
}

TEST(Simulation, ContactHappensWhereARefusedMassRatioSaysItWould) {
  // r* is 4.4136... for X = 9; the first contact is then before T/2 and away from equilibrium.
  const double limit = 4.413677811747;
  for (const auto& p : {PairParameters{.r = 4.42}, PairParameters{.r = 5.0},
                        PairParameters{.r = 8.0}, PairParameters{.X = 1.0 / 9.0, .r = 0.2}}) {
    const Pair pair = start_of(p);
    const Real t = pair.next_contact(Real(0.0005));
    Body there = pair.one;
    there.fly(t);
    std::string message;
    try {
      SynchronizedPair refused(p);
    } catch (const InputError& error) {
      message = error.what();
    }
    const auto expect_told = [&](const std::string& words, double truth) {
      const auto at = message.find(words);
      ASSERT_NE(at, std::string::npos) << message;
      // Six digits are printed.
      EXPECT_NEAR(std::stod(message.substr(at + words.size())), truth, 1e-5 * std::abs(truth))
          << message;
    };
    expect_told("at t = ", t.convert_to<double>());
    expect_told("u1 = u2 = ", there.u.convert_to<double>());
    expect_told("The value is ", p.r / (p.X < 1.0 ? 1.0 / limit : limit));
  }
}

}  // namespace
}  // namespace clackers::exact
