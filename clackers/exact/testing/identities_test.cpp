// What must hold of any motion of two masses that collide, whatever its formula: balances of
// momentum and energy over pieces of flights and across impacts, the impact law, symmetry, and
// the limits of the parameters. Only what sample(), impact() and problem() return is used.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using testing_oracle::Box;
using testing_oracle::trials;

constexpr double ulp = 0x1p-52;

PairParameters member(Box& box) {
  const double odd = 2.0 * std::floor(box.uniform(0.0, 11.0)) + 1.0;
  const bool exchanged = odd > 1.0 && box.one_in(3);
  const double r = odd == 1.0 ? box.decades(-2.0, 2.0) : box.uniform(0.1, 2.99);
  PairParameters p{.m1 = box.decades(-3.0, 3.0),
                   .k1 = box.decades(-3.0, 3.0),
                   .xi1 = box.one_in(4) ? 0.0 : box.uniform(0.0, exchanged ? 0.5 / odd : 0.5),
                   .A = box.decades(-3.0, 3.0),
                   .X = exchanged ? 1.0 / odd : odd,
                   .r = exchanged ? 1.0 / r : r,
                   .eta = box.one_in(4) ? 1.0 : box.uniform(0.3, 1.0)};
  // Six impacts of the slow mass.
  p.t_end = 6.2 * M_PI / std::sqrt(p.k1 / p.m1) * (exchanged ? odd : 1.0);
  return p;
}

// What a piece [a, b] of one flight adds up to: of each mass the integrals of u, v, a and v^2.
struct Sums {
  Eigen::Array2d u = Eigen::Array2d::Zero(), v = u, a = u, v_squared = u;
};

// Gauss's rule of 30 nodes on a piece of at most one radian is exact to rounding: its error is that
// of a Taylor series from the 60th term on. Ends within half a unit of an instant of impact
// belong to the flight between.
Sums integrals(const ClosedForm& motion, double a, double b, double fastest) {
  Sums sums;
  const auto pieces = std::ceil((b - a) * fastest);
  using Rule = boost::math::quadrature::gauss<double, 30>;
  for (double piece = 0.0; piece < pieces; ++piece) {
    const double half = (b - a) / pieces / 2.0, middle = a + half * (2.0 * piece + 1.0);
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
      for (const double sign : {-1.0, 1.0}) {
        const auto now = motion.at(middle + sign * half * Rule::abscissa()[i], Side::right);
        const double weight = half * Rule::weights()[i];
        sums.u += weight * now.u.array();
        sums.v += weight * now.v.array();
        sums.a += weight * now.a.array();
        sums.v_squared += weight * now.v.array().square();
      }
  }
  return sums;
}

double fastest_of(const SynchronizedPair& motion) {
  return std::max(motion.constants().omega1, motion.constants().omega2);
}

TEST(Identities, VelocityIsTheIntegralOfAccelerationAndDisplacementThatOfVelocity) {
  constexpr unsigned seed = 20260601;
  Box box(seed);
  for (int i = 0; i < trials(60); ++i) {
    const SynchronizedPair motion(member(box));
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i);
    const double fastest = fastest_of(motion), T = motion.constants().period;
    // Anywhere in the first flights, away from impacts.
    const double a = T * (std::floor(box.uniform(0.0, 5.0)) + box.uniform(0.51, 1.2));
    const double b = a + box.uniform(0.05, 1.0) * std::min(2.0 / fastest, 0.25 * T);
    const auto sums = integrals(motion, a, b, fastest);
    const auto from = motion.at(a, Side::right), to = motion.at(b, Side::right);
    const auto e = motion.envelope(a);
    for (Eigen::Index m = 0; m < 2; ++m) {
      // Rounding of 60 products of the integrand and of the times, t ulp/2, at which it is taken.
      const auto bound = [&](double ends, double integrand, double slope) {
        return ulp * (2.0 * ends + integrand * (60.0 * (b - a) + b) + slope * (b - a) * b);
      };
      EXPECT_NEAR(to.u[m] - from.u[m], sums.v[m], bound(e.u[m], e.v[m], e.a[m]));
      const double third = e.a[m] * fastest;
      EXPECT_NEAR(to.v[m] - from.v[m], sums.a[m], bound(e.v[m], e.a[m], third));
    }
  }
}

TEST(Identities, MomentumAndEnergyBalanceAcrossImpacts) {
  constexpr unsigned seed = 20260602;
  Box box(seed);
  for (int i = 0; i < trials(12); ++i) {
    const auto p = member(box);
    const SynchronizedPair motion(p);
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " X = " << p.X);
    const auto problem = motion.problem();
    const double fastest = fastest_of(motion), T = motion.constants().period;
    const double a = box.uniform(0.0, 0.4) * T, b = box.uniform(2.6, 5.4) * T;
    Sums whole;
    double impulses = 0.0, lost = 0.0, from_t = a;
    const auto last = motion.impact_count(b);
    for (long long k = 1; k <= last + 1; ++k) {
      const double to_t = k > last ? b : motion.impact(k).t;
      const auto sums = integrals(motion, from_t, to_t, fastest);
      whole.u += sums.u;
      whole.v_squared += sums.v_squared;
      from_t = to_t;
      if (k > last) break;
      const auto hit = motion.impact(k);
      impulses += hit.impulse;
      lost += hit.energy_before - hit.energy_after;
    }
    ASSERT_GE(last, 2);
    const auto from = motion.at(a, Side::right), to = motion.at(b, Side::right);
    const auto e = motion.envelope(a);
    const auto diagonal = [](const auto& matrix) { return Eigen::Array2d(matrix.diagonal()); };
    const Eigen::Array2d m = diagonal(problem.system.mass), c = diagonal(problem.system.damping),
                         k = diagonal(problem.system.stiffness);
    double energy = 0.0, energy_scale = 0.0;
    for (Eigen::Index j = 0; j < 2; ++j) {
      const double change =
          m[j] * (to.v[j] - from.v[j]) + c[j] * (to.u[j] - from.u[j]) + k[j] * whole.u[j];
      // Rounding of the times, t ulp/2 of the slope, and of the sums: pieces times 60 products.
      const double steps = 60.0 + b * fastest;
      EXPECT_NEAR(change, j == 0 ? impulses : -impulses,
                  ulp * steps * (4.0 * m[j] * e.v[j] + k[j] * e.u[j] * b));
      energy += (m[j] * (to.v[j] * to.v[j] - from.v[j] * from.v[j]) +
                 k[j] * (to.u[j] * to.u[j] - from.u[j] * from.u[j])) /
                    2.0 +
                c[j] * whole.v_squared[j];
      energy_scale += ulp * steps * (4.0 * k[j] * e.u[j] * e.u[j] + c[j] * e.v[j] * e.v[j] * b);
    }
    EXPECT_NEAR(energy, -lost, energy_scale);
  }
}

TEST(Identities, EveryImpactObeysNewtonsLawAndConservesMomentum) {
  constexpr unsigned seed = 20260603;
  Box box(seed);
  for (int i = 0; i < trials(200); ++i) {
    auto p = member(box);
    if (box.one_in(8)) p.eta = 0.0;
    const SynchronizedPair motion(p);
    const auto problem = motion.problem();
    const double m1 = problem.system.mass(0, 0), m2 = problem.system.mass(1, 1);
    for (long long k = 1; k <= motion.impact_count(p.t_end); ++k) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " k " << k);
      const auto hit = motion.impact(k);
      const auto &u = hit.before.v, &w = hit.after.v;
      const double closing = u[0] - u[1];
      EXPECT_LT(closing, 0.0);
      // Two values and their difference, each rounded; eta times one of them.
      EXPECT_NEAR(w[0] - w[1], -p.eta * closing, 3.0 * ulp * -closing);
      EXPECT_NEAR(m1 * u[0] + m2 * u[1], 0.0, 3.0 * ulp * m1 * std::abs(u[0]));
      EXPECT_NEAR(m1 * w[0] + m2 * w[1], 0.0, 3.0 * ulp * m1 * std::abs(u[0]));
      EXPECT_NEAR(m1 * (w[0] - u[0]), hit.impulse, 3.0 * ulp * hit.impulse);
      EXPECT_NEAR(m2 * (w[1] - u[1]), -hit.impulse, 4.0 * ulp * hit.impulse);
      EXPECT_NEAR((m1 * u[0] * u[0] + m2 * u[1] * u[1]) / 2.0, hit.energy_before,
                  4.0 * ulp * hit.energy_before);
      EXPECT_NEAR((m1 * w[0] * w[0] + m2 * w[1] * w[1]) / 2.0, hit.energy_after,
                  4.0 * ulp * hit.energy_after);
    }
  }
}

TEST(Identities, ExchangedRolesGiveTheSameMotionUpsideDown) {
  // (u1, u2) -> (-u2, -u1) with masses swapped. Without damping and with dyadic numbers the
  // parameters of the swapped pair are doubles: k2 = k1 X^2/r, A' = |u2(0)| = r A/X.
  for (const double X : {3.0, 5.0, 7.0, 21.0})
    for (const double eta : {1.0, 0.625}) {
      SCOPED_TRACE(testing::Message() << "X = " << X << " eta = " << eta);
      const double r = 0.25, m1 = 2.0, k1 = 0.5, A = X;
      const SynchronizedPair one({m1, k1, 0.0, A, X, r, eta, 60.0});
      const SynchronizedPair other(
          {m1 / r, k1 * X * X / r, 0.0, r * A / X, 1.0 / X, 1.0 / r, eta, 60.0});
      ASSERT_EQ(one.impact_count(60.0), other.impact_count(60.0));
      // mass 2 of the one starts below for X = 4N + 1; the other's mass 1 is then above.
      for (const double t : {0.0, 0.3, 10.0, one.impact(4).when.lo, one.impact(4).when.hi, 59.9})
        for (const auto side : {Side::left, Side::right}) {
          const auto a = one.at(t, side), b = other.at(t, side);
          const auto e = one.envelope(t);
          for (Eigen::Index m = 0; m < 2; ++m) {
            EXPECT_NEAR(a.u[m], -b.u[1 - m], 1.02 * ulp * e.u[m]);
            EXPECT_NEAR(a.v[m], -b.v[1 - m], 1.02 * ulp * e.v[m]);
            EXPECT_NEAR(a.a[m], -b.a[1 - m], 1.02 * ulp * e.a[m]);
          }
        }
      for (const long long k : {1LL, 5LL}) {
        const auto a = one.impact(k), b = other.impact(k);
        EXPECT_EQ(a.t, b.t);
        EXPECT_DOUBLE_EQ(a.impulse, b.impulse);
        EXPECT_DOUBLE_EQ(a.before.v[0], -b.before.v[1]);
        EXPECT_DOUBLE_EQ(a.after.v[1], -b.after.v[0]);
        EXPECT_DOUBLE_EQ(a.energy_after, b.energy_after);
      }
    }
}

TEST(Identities, ElasticImpactsTurnTheVelocitiesAboutToTheLastBit) {
  constexpr unsigned seed = 20260604;
  Box box(seed);
  for (int i = 0; i < trials(50); ++i) {
    auto p = member(box);
    p.eta = 1.0;
    const auto hit = SynchronizedPair(p).impact(3);
    EXPECT_EQ(hit.after.v, -hit.before.v);
    EXPECT_EQ(hit.energy_after, hit.energy_before);
  }
}

TEST(Identities, WithoutDampingAndLossEnergyIsThatOfTheStart) {
  constexpr unsigned seed = 20260605;
  Box box(seed);
  for (int i = 0; i < trials(50); ++i) {
    auto p = member(box);
    p.eta = 1.0;
    p.xi1 = 0.0;
    const SynchronizedPair motion(p);
    const auto problem = motion.problem();
    const auto energy = [&](const model::Kinematics& x) {
      return (x.v.dot(problem.system.mass * x.v) + x.u.dot(problem.system.stiffness * x.u)) / 2.0;
    };
    const double start = energy(motion.at(0.0, Side::right));
    const double t = box.uniform(0.0, p.t_end);
    // Squares double the relative errors of values (1/2), mass and stiffness add theirs.
    EXPECT_NEAR(energy(motion.at(t, Side::right)), start, 6.0 * ulp * start)
        << "seed " << seed << " trial " << i;
    EXPECT_NEAR(motion.impact(2).energy_after, start, 6.0 * ulp * start);
  }
}

TEST(Identities, LimitsOfTheParametersAreReachedContinuously) {
  constexpr unsigned seed = 20260606;
  Box box(seed);
  for (int i = 0; i < trials(50); ++i) {
    auto p = member(box);
    const double t = box.uniform(0.0, p.t_end);
    const auto near = [&](const PairParameters& one, const PairParameters& other, double change) {
      const SynchronizedPair a(one), b(other);
      const auto x = a.at(t, Side::right), y = b.at(t, Side::right);
      const auto e = a.envelope(t);
      for (Eigen::Index m = 0; m < 2; ++m) {
        EXPECT_NEAR(x.u[m], y.u[m], (change + 1.02 * ulp) * e.u[m]);
        EXPECT_NEAR(x.v[m], y.v[m], (change + 1.02 * ulp) * e.v[m]);
      }
    };
    // eta = 1 - 2^-53 takes k 2^-53 off after k <= 6 impacts; more than six times do not fit.
    auto elastic = p, nearly = p;
    elastic.eta = 1.0;
    nearly.eta = 1.0 - 0x1p-53;
    near(elastic, nearly, 7.0 * 0x1p-53);
    // xi1 = 1e-60 changes nothing that a double could show.
    auto undamped = p, hardly = p;
    undamped.xi1 = 0.0;
    hardly.xi1 = 1e-60;
    near(undamped, hardly, 0.0);
    // eta -> 0: what is left after the first impact is eta of it.
    auto plastic = p, soft = p;
    plastic.eta = 0.0;
    soft.eta = 1e-300;
    const SynchronizedPair rests(plastic), crawls(soft);
    EXPECT_EQ(rests.impact(1).before.v, crawls.impact(1).before.v);
    EXPECT_EQ(rests.impact(1).energy_before, crawls.impact(1).energy_before);
    const double later = 1.7 * rests.constants().period;
    EXPECT_EQ(rests.at(later, Side::right).u.norm(), 0.0);
    EXPECT_LE(crawls.envelope(later).u.maxCoeff(), 1e-290);
  }
}

}  // namespace
}  // namespace clackers::exact
