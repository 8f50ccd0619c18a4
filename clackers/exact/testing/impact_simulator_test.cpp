#include "clackers/exact/testing/impact_simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace clackers::exact::testing_oracle {
namespace {

// No common frequency, no common damping, nothing at equilibrium.
RawPair ordinary() {
  return {.m1 = 2,
          .m2 = 0.75,
          .k1 = 3,
          .k2 = 40,
          .c1 = 0.25,
          .c2 = 0.125,
          .eta = 0.625,
          .gap = 0.0625,
          .u10 = 0.5,
          .u20 = -0.25,
          .v10 = -1,
          .v20 = 0.5};
}

TEST(ImpactSimulator, FlightsObeyTheEquationOfMotion) {
  const auto p = ordinary();
  ImpactSimulator simulator(p);
  const auto start = simulator.at(0);
  EXPECT_TRUE(start.u[0] == p.u10 && start.u[1] == p.u20);
  EXPECT_LT(abs(start.v[0] - p.v10) + abs(start.v[1] - p.v20), Real(1e-80));
  // Central differences with h = 1e-20: h^2 of truncation, 1e-88 / h of rounding.
  const Real h("1e-20"), t = 0.03125;
  const auto before = simulator.at(t - h), now = simulator.at(t), after = simulator.at(t + h);
  const Real m[] = {p.m1, p.m2}, c[] = {p.c1, p.c2}, k[] = {p.k1, p.k2};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(abs((after.u[i] - before.u[i]) / (2 * h) - now.v[i]), Real(1e-36));
    EXPECT_LT(abs((after.v[i] - before.v[i]) / (2 * h) - now.a[i]), Real(1e-36));
    EXPECT_LT(abs(m[i] * now.a[i] + c[i] * now.v[i] + k[i] * now.u[i]), Real(1e-80));
  }
}

TEST(ImpactSimulator, ImpactsObeyNewtonsLawAndConserveMomentum) {
  const auto p = ordinary();
  ImpactSimulator simulator(p);
  Real last = 0;
  for (int k = 0; k < 8; ++k) {
    const auto hit = simulator.next(1000).value();
    EXPECT_GT(hit.before.t, last);
    last = hit.before.t;
    EXPECT_EQ(hit.after.t, last);
    EXPECT_EQ(simulator.flight_start(), last);
    const auto &a = hit.before, &b = hit.after;
    EXPECT_LT(abs(a.u[0] - a.u[1] + p.gap), Real(1e-75));
    EXPECT_LT(a.v[0], a.v[1]);
    EXPECT_LT(abs((b.v[0] - b.v[1]) + p.eta * (a.v[0] - a.v[1])), Real(1e-80));
    EXPECT_LT(abs(p.m1 * (b.v[0] - a.v[0]) - hit.impulse), Real(1e-80));
    EXPECT_LT(abs(p.m2 * (b.v[1] - a.v[1]) + hit.impulse), Real(1e-80));
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(abs(a.u[i] - b.u[i]), Real(1e-85));
    // Newton's law takes (1 - eta^2)/2 of the reduced mass times the closing speed squared.
    const Real reduced = p.m1 * p.m2 / (p.m1 + p.m2), closing = a.v[0] - a.v[1];
    EXPECT_LT(abs(hit.energy_before - hit.energy_after -
                  (1 - p.eta * p.eta) * reduced * closing * closing / 2),
              Real(1e-80));
  }
}

// One mass in double precision, its own way: complex exponentials of the state.
struct Wave {
  double sigma, w, p, q;
  double at(double t) const {
    return std::exp(-sigma * t) * (p * std::cos(w * t) + q * std::sin(w * t));
  }
};

TEST(ImpactSimulator, FindsTheContactThatAWalkInTinyStepsFinds) {
  constexpr unsigned seed = 20260401;
  std::mt19937_64 random(seed);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int contacts = 0;
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << trial);
    Wave one{uniform(0, 0.2), uniform(0.5, 8), uniform(0, 1), uniform(-1, 1)};
    Wave two{uniform(0, 0.2), uniform(0.5, 8), uniform(-1, 0), uniform(-1, 1)};
    const double gap = trial % 3 == 0 ? 0.0 : uniform(-0.02, 0.4);
    if (one.p - two.p + gap <= 0.0) continue;
    const auto square = [](const Wave& x) { return Real(x.w) * x.w + Real(x.sigma) * x.sigma; };
    const auto speed = [](const Wave& x) { return Real(x.q) * x.w - Real(x.sigma) * x.p; };
    ImpactSimulator simulator({.m1 = 1,
                               .m2 = 2,
                               .k1 = square(one),
                               .k2 = 2 * square(two),
                               .c1 = 2 * Real(one.sigma),
                               .c2 = 4 * Real(two.sigma),
                               .eta = 1,
                               .gap = gap,
                               .u10 = one.p,
                               .u20 = two.p,
                               .v10 = speed(one),
                               .v20 = speed(two)});
    // The opening's second derivative is below 2 * 1.5 * 64: between two points 1e-4 apart it can
    // dip by at most 2.4e-7, and neither resolves what dips that little below 0.
    constexpr double step = 1e-4, end = 12.0;
    const auto opening = [&](double t) { return one.at(t) - two.at(t) + gap; };
    double walked = step, lowest = 1.0;
    for (int i = 1; walked < end && opening(walked) > 0.0; walked = ++i * step)
      lowest = std::min(lowest, opening(walked));
    if (walked >= end && lowest < 1e-6) continue;
    const auto hit = simulator.next(end);
    ASSERT_EQ(hit.has_value(), walked < end);
    if (!hit) continue;
    ++contacts;
    const double t = double(hit->before.t);
    EXPECT_LE(t, walked + 1e-12);
    // Where the walk came close before, the contact may be an earlier dip that it did not see.
    if (lowest > 1e-6) {
      EXPECT_GE(t, walked - step - 1e-12);
    }
  }
  EXPECT_GE(contacts, 25);
}

TEST(ImpactSimulator, SeesDipsOfAnyShortness) {
  // Two undamped masses at rest apart, cos t and d - c - cos(1000 t)/1000 with the fast one's crest
  // at 2 pi j/1000. By c the crest just reaches the slow mass or just fails to.
  const auto with = [](const Real& lift) {
    const Real top("1e-3");
    return RawPair{.m1 = 1,
                   .m2 = 1,
                   .k1 = 1,
                   .k2 = 1000000,
                   .c1 = 0,
                   .c2 = 0,
                   .eta = 1,
                   .gap = top + 1 + lift,
                   .u10 = 1,
                   .u20 = top,
                   .v10 = 0,
                   .v20 = 0};
  };
  // Near t = pi the slow mass is at -1 and a crest (t = 2 pi 500/1000 = pi) at 1/1000 meets it.
  const Real pi = 2 * asin(Real(1)), small("1e-20");
  ImpactSimulator apart(with(small));
  EXPECT_FALSE(apart.next(Real(3.2)));
  ImpactSimulator meets(with(-small));
  const auto hit = meets.next(Real(3.2));
  ASSERT_TRUE(hit);
  // u1 - u2 + gap is -small + (x^2/2) (1 + 1000) to leading order in x = t - pi.
  EXPECT_LT(abs((pi - hit->before.t) / sqrt(2 * small / 1001) - 1), Real(1e-12));
  ImpactSimulator graze(with(0));
  EXPECT_THROW(graze.next(Real(3.2)), std::domain_error);
}

TEST(ImpactSimulator, ContactsAreLookedForUpToTheGivenTimeOnly) {
  const auto p = ordinary();
  ImpactSimulator simulator(p);
  const Real t = ImpactSimulator(p).next(1000)->before.t;
  EXPECT_FALSE(simulator.next(t - Real(1e-50)));
  EXPECT_EQ(simulator.flight_start(), 0);
  EXPECT_TRUE(simulator.next(t + Real(1e-50)));
}

TEST(ImpactSimulator, StatesAtTimesAreThoseOfTheFlightsTheyFallInto) {
  const auto p = ordinary();
  ImpactSimulator simulator(p);
  const auto one = simulator.next(1000).value(), two = simulator.next(1000).value();
  const Real between = (one.after.t + two.before.t) / 2;
  const Real times[] = {0, one.before.t / 2, between, two.before.t + Real(1e-3)};
  const auto states = simulate(p, times);
  ASSERT_EQ(states.size(), 4U);
  EXPECT_EQ(states[1].u[0], ImpactSimulator(p).at(times[1]).u[0]);
  ImpactSimulator middle(p);
  middle.next(between);
  EXPECT_EQ(states[2].v[1], middle.at(between).v[1]);
  EXPECT_EQ(states[3].a[1], simulator.at(times[3]).a[1]);
  EXPECT_EQ(states[3].t, times[3]);
}

TEST(ImpactSimulator, RefusesWhatItDoesNotSimulate) {
  auto overlap = ordinary();
  overlap.u20 = 0.75;
  EXPECT_THROW(ImpactSimulator{overlap}, std::domain_error);
  auto overdamped = ordinary();
  overdamped.c2 = 11;
  EXPECT_THROW(ImpactSimulator{overdamped}, std::domain_error);
  auto plastic = ordinary();
  plastic.eta = 0;
  ImpactSimulator simulator(plastic);
  ASSERT_TRUE(simulator.next(1000));
  EXPECT_THROW(simulator.next(1000), std::domain_error);
}

}  // namespace
}  // namespace clackers::exact::testing_oracle
