#include "clackers/exact/bodies/bar_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

// Bars as waves that are followed event by event, against the tables of closed forms, which know no
// events: docs/manual/explanation/derivations/bars.md.
namespace clackers::exact {
namespace {

using model::Side;
using testing_oracle::Box;
using testing_oracle::trials;
using Number = long double;

struct Sizes {
  Number tau, c, z, m;
};
Sizes sizes(const Bar& bar) {
  const Number c = std::sqrt(Number(bar.E) / bar.rho), tau = bar.L / c,
               z = bar.A * std::sqrt(Number(bar.E) * bar.rho);
  return {tau, c, z, z * tau};
}
Bar random_bar(Box& box) {
  return {box.decades(-1.0, 1.0), box.decades(-1.0, 4.0), box.decades(-1.0, 2.0),
          box.decades(-2.0, 1.0)};
}

// Within the bound, and an error of this size of the formula in 64 bits.
void expect(const numerics::Bounded& found, Number known, Number own, const char* what) {
  EXPECT_LE(std::abs(found.value - known), found.error + own * 1e-17L) << what;
  EXPECT_LE(found.error, own * 1e-14L) << what;
}

TEST(BarContact, ABarAtAWallIsSaintVenants) {
  Box box(81);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 81, trial " << trial);
    auto bar = random_bar(box);
    const double V = box.decades(-2.0, 1.0),
                 d = box.one_in(5) ? 0.0 : bar.L * box.decades(-3.0, 0.0);
    bar.v0 = -V;
    const auto [tau, c, z, m] = sizes(bar);
    const Number begin = d / Number(V);
    const double end = double(begin + 4 * tau);
    const BarContact motion({{bar}, d, end}, "bar");
    ASSERT_EQ(motion.events().size(), 1u + (d > 0.0));
    for (int i = 0; i < 10; ++i) {
      const double t = box.uniform(0.0, end), x = bar.L * box.uniform(0.0, 1.0);
      const Number s = t - begin, late = x / c;
      const Number front = tau - std::abs(s - tau);
      const bool behind = s > 0 && s < 2 * tau && late < front;
      const Number u = s < 0         ? -V * Number(t)
                       : s < 2 * tau ? -d - V * std::min(late, front)
                                     : -d + V * (s - 2 * tau),
                   v = behind    ? 0
                       : s < tau ? -V
                                 : V;
      const auto now = motion.at(0, x, t, Side::right);
      const Number size = V * (t + tau) * 20;
      expect(now.u, u, size, "u");
      expect(now.v, v, 20 * V, "v");
      expect(now.stress, behind ? -bar.rho * c * V : 0, 20 * bar.rho * c * V, "stress");
      const bool touches = s > 0 && s < 2 * tau;
      expect(motion.force(t, Side::right), touches ? z * V : 0, 20 * z * V, "force");
      expect(motion.impulse(t, Side::right), z * V * std::clamp(s, Number(0), 2 * tau), 20 * m * V,
             "impulse");
      const auto energy = motion.energy(t);
      expect(energy.kinetic + energy.elastic, m * V * V / 2, 50 * m * V * V, "energy");
      const Number share = touches ? std::max(Number(0), front) / tau : 0;
      expect(energy.elastic, share * m * V * V / 2, 50 * m * V * V * (1 + begin / tau), "elastic");
    }
  }
}

TEST(BarContact, TwoBarsPartWithSaintVenantsRestitution) {
  Box box(82);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 82, trial " << trial);
    auto first = random_bar(box), second = random_bar(box);
    if (trial % 4 == 0) {
      second = first;  // the same section
      second.L *= box.uniform(1.1, 6.0);
    }
    first.v0 = box.uniform(0.0, 2.0);
    second.v0 = first.v0 - box.uniform(0.1, 2.0);
    auto a = sizes(first), b = sizes(second);
    const bool swapped = a.tau > b.tau;
    if (swapped) std::swap(a, b);
    const Number D = Number(first.v0) - second.v0, q = (a.z - b.z) / (a.z + b.z);
    const Number n = std::floor(b.tau / a.tau), f = b.tau / a.tau - n;
    if (n > 8 || f < 1e-6L || f > 1 - 1e-6L) continue;
    const Number J =
        a.z == b.z  ? a.m * D
        : a.z < b.z ? 2 * a.m * b.z / (a.z + b.z) * D
                    : a.m * D * (1 - std::pow(q, n) + f * std::pow(q, n) * 2 * b.z / (a.z + b.z));
    const Number parts = a.z < b.z ? 2 * a.tau : 2 * b.tau;
    const double end = double(1.5L * parts);
    const BarContact motion({{first, second}, 0.0, end}, "bars");
    ASSERT_EQ(motion.events().size(), 1u);
    EXPECT_FALSE(motion.events()[0].closes);
    expect(motion.events()[0].t, parts, 100 * parts, "parts");
    expect(motion.impulse(end, Side::right), J, 1e3L * a.m * D, "impulse");
    for (int i = 0; i < 6; ++i) {
      const double t = box.uniform(0.0, double(parts));
      const Number round = std::floor(t / (2 * a.tau));
      const Number R = a.z * b.z / (a.z + b.z) * std::pow(q, round) * D;
      expect(motion.force(t, Side::right), R, 1e3L * a.z * D, "force");
      const Number common =
          b.z > a.z || b.z < a.z || round == 0
              ? (swapped ? Number(first.v0) - a.z / (a.z + b.z) * std::pow(q, round) * D
                         : second.v0 + a.z / (a.z + b.z) * std::pow(q, round) * D)
              : (swapped ? first.v0 : second.v0);
      for (const std::size_t bar : {0u, 1u})
        expect(motion.at(bar, 0.0, t, Side::right).v, common, 1e3L * (D + 2), "common velocity");
    }
    const auto before = motion.energy(0.0), after = motion.energy(end);
    const Number whole = before.kinetic.value;
    expect(before.kinetic,
           (sizes(first).m * first.v0 * first.v0 + sizes(second).m * second.v0 * second.v0) / 2,
           50 * whole, "energy at the start");
    expect(after.kinetic + after.elastic, whole, 1e4L * whole, "energy at the end");
  }
}

/// The table of Doyen, Ern and Piperno's bouncing bar for whole N.
struct Table {
  Number N, g, tau, c, z, h0, v;
  Table(const Bar& bar, double whole, double gravity) : N(whole), g(gravity) {
    const auto s = sizes(bar);
    tau = s.tau;
    c = s.c;
    z = s.z;
    v = N * g * tau;
    h0 = N * tau * v / 2;
  }
  Number period() const { return 4 * (N + 1) * tau; }
  struct Waves {
    Number a, o, y, A, O;  // A and O: integrals since the start of the period
    bool touches;
  };
  Waves at(Number t) const {
    const Number fall = N * tau;
    if (t < fall)
      return {-g * t, -g * t, h0 - g * t * t / 2, -g * t * t / 2, -g * t * t / 2, false};
    const Number first = -h0, S1 = 2 * v * tau + 2 * g * tau * tau,
                 S3 = 2 * g * tau * tau * (N + 1);
    Number s = t - fall;
    if (s < 2 * tau) {
      const Number sum = v * s + g * s * s / 2;
      return {-v - g * s, v + g * s, 0, first - sum, first + sum, true};
    }
    s -= 2 * tau;
    if (s < 2 * N * tau) {
      const Number k = std::floor(s / (2 * tau)) + 1, x = s - (k - 1) * 2 * tau,
                   y = 2 * tau * (k - 1) * (v + g * tau - g * tau * k) + (v - 2 * g * tau * k) * x +
                       g * x * x / 2,
                   a = v - 2 * g * tau * k + g * x;
      return {a, a, y, first - S1 + y, first + S1 + y, false};
    }
    s -= 2 * N * tau;
    if (s < 2 * tau) {
      const Number a = -g * tau * (N + 2) + g * s, sum = g * tau * (N + 2) * s - g * s * s / 2;
      return {a, -a, 0, first - S1 - sum, first + S1 + sum, true};
    }
    s -= 2 * tau;
    const Number rise = v * s - g * s * s / 2;
    return {v - g * s, v - g * s, rise, first - S1 - S3 + rise, first + S1 + S3 + rise, false};
  }
  // Through any number of periods, each of which adds S1 + S3.
  Waves through(Number t) const {
    const Number k = std::floor(t / period());
    auto w = at(t - k * period());
    const Number S = 2 * v * tau + 2 * g * tau * tau * (N + 2);
    w.A -= k * S;
    w.O += k * S;
    return w;
  }
};

TEST(BarContact, ABouncingBarIsTheTableOfItsPeriod) {
  Box box(83);
  for (int trial = 0; trial < trials(20); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 83, trial " << trial);
    const bool exact = trial % 2 == 0;
    const auto bar = exact ? Bar{} : random_bar(box);
    const double N = 3.0 + std::floor(box.uniform(0.0, 6.0)),
                 g = exact ? 0.125 : box.decades(-1.0, 1.0);
    const Table table(bar, N, g);
    const double end = double((trial % 3 == 0 ? 1e3L : 2.1L) * table.period());
    const BarContact motion({{bar}, 0.0, end, g, N}, "bar");
    EXPECT_EQ(motion.events().size(), 4u);
    for (int i = 0; i < 16; ++i) {
      const double t = box.uniform(0.0, end),
                   x = bar.L * (i % 4 == 0 ? 0.0 : box.uniform(0.0, 1.0));
      const Number late = x / table.c;
      if (t < double(late)) continue;
      const auto out = table.through(t - late), in = table.through(t + late);
      const auto now = motion.at(0, x, t, Side::right);
      const Number off = 40 * table.h0 + 100 * table.v * table.period() * (t / table.period()) +
                         1e3L * g * table.tau * table.tau;
      expect(now.u, (out.O + in.A) / 2 + g * late * late / 2, 60 * off, "u");
      const Number speed = 400 * (table.v + off / table.tau);
      expect(now.v, (out.o + in.a) / 2, speed, "v");
      expect(now.stress, bar.rho * table.c * ((in.a - out.o) / 2 + g * late),
             bar.rho * table.c * speed, "stress");
      const auto end_now = table.through(t);
      expect(motion.gap(t), end_now.y, 60 * off, "gap");
      expect(motion.force(t, Side::right), end_now.touches ? -table.z * end_now.a : 0,
             table.z * speed, "force");
      const auto energy = motion.energy(t);
      const Number whole = table.z * table.tau * table.v * table.v / 2;
      EXPECT_LE(std::abs((energy.kinetic + energy.elastic + energy.potential).value),
                1e-13L * whole);
    }
  }
}

// L = 10, E = 900, rho = 1, g = 10: tau = 1/3.
TEST(BarContact, OtherHeightsHaveTheContactsOfTheSpecification) {
  const Bar bar{10.0, 900.0, 1.0, 1.0};
  const BarContact motion({{bar}, 2.0, 7.0, 10.0}, "bar");
  const double contacts[] = {1.8973666, 4.0,       7.1055728, 9.8973666,
                             13.392319, 15.392319, 18.299361, 19.105573};
  ASSERT_GE(motion.events().size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(double(motion.events()[i].t.value) * 3.0, contacts[i], 6e-7) << i;
  // From heights with a fall of at most 2 tau the first contact ends at 4 tau, without a jump.
  Box box(84);
  for (int trial = 0; trial < trials(30); ++trial) {
    const double fall = box.uniform(0.1, 1.9) / 3.0, h0 = 5.0 * fall * fall;
    const BarContact low({{bar}, h0, 1.4, 10.0}, "bar");
    ASSERT_GE(low.events().size(), 2u);
    EXPECT_NEAR(double(low.events()[0].t.value), fall, 1e-15);
    EXPECT_NEAR(double(low.events()[1].t.value), 4.0 / 3.0, 1e-14);
    for (double t = fall + 0.01; t < 4.0 / 3.0; t += 0.01) {
      const double R = 300.0 * (t < fall + 2.0 / 3.0 ? t : 4.0 / 3.0 - t) / 1.0;
      EXPECT_NEAR(low.force(t, Side::right).nearest(), R, 1e-12 * 300.0) << t;
    }
  }
}

// The law itself: contact pulls nowhere, no gap is negative, energy stays.
TEST(BarContact, AnyHeightKeepsTheLawAndTheEnergy) {
  Box box(85);
  for (int trial = 0; trial < trials(10); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 85, trial " << trial);
    const auto bar = random_bar(box);
    const auto [tau, c, z, m] = sizes(bar);
    const double g = box.decades(-1.0, 1.0), N = box.uniform(0.3, 9.0),
                 h0 = double(N * N * g * tau * tau / 2), end = double(30 * tau);
    const BarContact motion({{bar}, h0, end, g}, "bar");
    for (int i = 0; i < 12; ++i) {
      const double t = box.uniform(0.0, end);
      const auto gap = motion.gap(t), force = motion.force(t, Side::right);
      EXPECT_GE(gap.value, -gap.error);
      EXPECT_GE(force.value, -force.error);
      EXPECT_EQ(gap.value * force.value, 0.0L);
      const auto energy = motion.energy(t);
      const auto sum = energy.kinetic + energy.elastic + energy.potential;
      EXPECT_LE(std::abs(sum.value), 1e-12L * m * g * (h0 + g * tau * tau)) << t;
      // The end stands on the wall or above it.
      const auto ends = motion.at(0, 0.0, t, Side::right);
      EXPECT_LE(std::abs((ends.u + numerics::Bounded(h0) - gap).value),
                1e-13L * (h0 + g * tau * tau));
    }
  }
}

// The table of whole N is that of N >= 3; N = 1 is a height as any other.
TEST(BarContact, TheLowestWholeNumberHasNoPeriod) {
  const BarContact by_number({{Bar{}}, 0.0, 31.0, 0.125, 1.0}, "bar"),
      by_height({{Bar{}}, 0.0625, 31.0, 0.125}, "bar");
  EXPECT_EQ(by_number.period().nearest(), 0.0);
  for (double t = 0.25; t < 31.0; t += 0.5)
    EXPECT_NEAR(by_number.at(0, 0.25, t, Side::right).u.nearest(),
                by_height.at(0, 0.25, t, Side::right).u.nearest(), 1e-15)
        << t;
}

TEST(BarContact, ASoftTouchIsRefused) {
  // N = 2: the gap closes with velocity 0.
  EXPECT_REFUSED(BarContact({{Bar{}}, 0.25, 30.0, 0.125}, "bar"), "not-admissible", "so softly");
}

}  // namespace
}  // namespace clackers::exact
