#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/cases/testing/constants.hpp"
#include "clackers/exact/certified/digits.hpp"
#include "clackers/exact/elliptic/swing.hpp"
#include "clackers/exact/testing/real.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/nonlinear_springs.hpp"
#include "clackers/model/problem_file.hpp"

// The nonlinear oscillators, against Taylor series of their equations of motion with impacts found by
// bisection: no elliptic functions.
namespace clackers::cases {
namespace {

using exact::testing_oracle::Box;
using exact::testing_oracle::trials;
using model::Side;
template <class Number>
constexpr int terms = std::numeric_limits<Number>::digits > 64 ? 70 : 30;
template <class Number>
struct Series {
  std::array<Number, std::size_t(terms<Number>)> values{};
  Number& operator[](int n) { return values[std::size_t(n)]; }
  const Number& operator[](int n) const { return values[std::size_t(n)]; }
};

// From u and v the Taylor coefficients of u.
template <class Number>
using Expansion = std::function<Series<Number>(const Number& u, const Number& v)>;

template <class Number>
Expansion<Number> pendulum(Number l, Number g) {
  return [l, g](const Number& u0, const Number& v0) {
    // With x = u/l, s = sin x and c = cos x: s' = c x', c' = -s x'.
    Series<Number> u, s, c;
    u[0] = u0, u[1] = v0;
    s[0] = sin(Number(u0 / l)), c[0] = cos(Number(u0 / l));
    for (int n = 0; n + 2 < terms<Number>; ++n) {
      u[n + 2] = -g * s[n] / ((n + 1) * (n + 2));
      Number ds = 0, dc = 0;
      for (int i = 0; i <= n; ++i) {
        const Number rate = (n - i + 1) * u[n - i + 1] / l;
        ds += c[i] * rate;
        dc -= s[i] * rate;
      }
      s[n + 1] = ds / (n + 1), c[n + 1] = dc / (n + 1);
    }
    return u;
  };
}

template <class Number>
Expansion<Number> duffing(Number w2, Number b) {
  return [w2, b](const Number& u0, const Number& v0) {
    Series<Number> u, square;
    u[0] = u0, u[1] = v0;
    for (int n = 0; n + 2 < terms<Number>; ++n) {
      Number cube = 0;
      for (int i = 0; i <= n; ++i) square[n] += u[i] * u[n - i];
      for (int i = 0; i <= n; ++i) cube += square[i] * u[n - i];
      u[n + 2] = -(w2 * u[n] + b * cube) / ((n + 1) * (n + 2));
    }
    return u;
  };
}

template <class Number>
struct Bouncer {
  Expansion<Number> expansion;
  Number step, eta, t, u, v;
  long long impacts = 0;
  Number first = 0, fastest = 0;

  std::pair<Number, Number> after(const Series<Number>& series, const Number& h) const {
    Number x = 0, rate = 0;
    for (int n = terms<Number>; n-- > 0;) x = x * h + series[n];
    for (int n = terms<Number>; n-- > 1;) rate = rate * h + n * series[n];
    return {x, rate};
  }
  void run_to(const Number& end) {
    while (t < end) {
      const Number h = std::min<Number>(step, end - t);
      const auto series = expansion(u, v);
      const auto next = after(series, h);
      if (next.first >= 0) {
        t += h;
        std::tie(u, v) = next;
        continue;
      }
      Number inside = 0, outside = h;
      for (int i = 0; i < std::numeric_limits<Number>::digits + 6; ++i) {
        const Number middle = (inside + outside) / 2;
        (after(series, middle).first >= 0 && (middle > 0) ? inside : outside) = middle;
      }
      if (impacts++ == 0) first = t + outside, fastest = -after(series, outside).second;
      t += outside;
      v = -eta * after(series, outside).second;
      u = 0;
    }
  }
};

// Mass 1 above the stop, or mass 2 below it, at six times. `condition`: of the instants with the start, which the
// problem has rounded; large beside the motions that never come back.
void expect_states(Box& box, const model::Motion& motion, int mass, Bouncer<long double>& known,
                   double period, double condition) {
  const double sign = mass == 0 ? 1.0 : -1.0;
  const auto size = motion.envelope(0.0);
  for (int i = 1; i <= 6; ++i) {
    const double t = motion.end() * (i - box.uniform(0.0, 1.0)) / 6.0;
    known.run_to(t);
    const auto now = motion.at(t, Side::right), bound = motion.error_bound(t);
    const double own = 4e-16 * condition * (1.0 + t / period);
    EXPECT_NEAR(sign * now.u[mass], double(known.u), bound.u[mass] + own * size.u[mass]) << t;
    EXPECT_NEAR(sign * now.v[mass], double(known.v), bound.v[mass] + own * size.v[mass]) << t;
    EXPECT_LT(bound.u[mass], 1e-12 * condition * size.u[mass]);
    EXPECT_EQ(motion.impact_count(t), known.impacts);
  }
}

void expect_simulated(Box& box, const Case& test_case, const Expansion<long double>& expansion,
                      double eta, double condition) {
  const auto& start = test_case.problem.start;
  const double period = constant(test_case, "T_0");
  Bouncer<long double> known{expansion, static_cast<long double>(period) / 150, eta, 0, start.u[0],
                             0};
  expect_states(box, *test_case.motion, 0, known, period, condition);
  if (known.impacts == 0) return;
  const auto hit = test_case.motion->impact(1);
  EXPECT_NEAR(hit.t, double(known.first), 1e-15 * condition * (period + hit.t));
  EXPECT_NEAR(hit.before.v[0], -double(known.fastest), 1e-15 * double(known.fastest));
  EXPECT_NEAR(hit.after.v[0], eta * double(known.fastest), 1e-15 * double(known.fastest));
  EXPECT_EQ(hit.before.u[0], 0.0);
  // The energy of the start is that at the stop.
  const double stored = test_case.problem.system.nonlinear->potential(start.u) +
                        0.5 * test_case.problem.system.stiffness(0, 0) * start.u[0] * start.u[0];
  EXPECT_NEAR(hit.energy_before, stored, 1e-14 * stored);
  EXPECT_NEAR(hit.energy_after, eta * eta * stored, 1e-14 * stored);
}

TEST(EllipticCases, PendulumsSwingAsTheirTaylorSeries) {
  Box box(111);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 111, trial " << trial);
    const double l = box.decades(-1.0, 1.0), g = box.decades(-1.0, 1.0),
                 theta0 = box.one_in(3) ? box.decades(-3.0, 0.0) : box.uniform(0.1, 3.1),
                 eta = box.one_in(4) ? 1.0 : box.uniform(0.05, 1.0);
    expect_simulated(box,
                     make("pendulum", {{"l", l},
                                       {"g", g},
                                       {"theta0", theta0},
                                       {"eta", eta},
                                       {"t_end", box.uniform(1.0, 30.0) * std::sqrt(l / g)}}),
                     pendulum<long double>(l, g), eta, 4.0 / std::cos(0.5 * theta0));
  }
}

TEST(EllipticCases, DuffingOscillatorsSwingAsTheirTaylorSeries) {
  Box box(112);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 112, trial " << trial);
    const double m = box.decades(-1.0, 1.0), k = box.decades(-1.0, 1.0),
                 u0 = box.decades(-1.0, 1.0),
                 b = k / (u0 * u0) *
                     (box.one_in(2) ? -box.uniform(0.0, 0.99) : box.decades(-3.0, 2.0)),
                 eta = box.one_in(4) ? 1.0 : box.uniform(0.05, 1.0);
    expect_simulated(
        box,
        make("duffing-stop", {{"m", m},
                              {"k", k},
                              {"b", b},
                              {"u0", u0},
                              {"eta", eta},
                              {"t_end", box.uniform(1.0, 30.0) * std::sqrt(m / k)}}),
        duffing<long double>(static_cast<long double>(k) / m, static_cast<long double>(b) / m), eta,
        4.0 / std::min(1.0, 1.0 + b * u0 * u0 / k));
  }
}

// Both pendula by their Taylor series, each above a stop: at impacts of opposite momenta each goes back as it came,
// and what rests stays.
void expect_bob(Box& box, const Case& test_case, int mass, double condition) {
  const auto name = [&](const char* of) {
    return constant(test_case, of + std::to_string(mass + 1));
  };
  const double T = name("T"), l = name("l"), start = std::abs(test_case.problem.start.u[mass]);
  const auto& row = model::nonlinear_springs(test_case.problem)->rows()[std::size_t(mass)];
  Bouncer<long double> known{pendulum<long double>(l, row.stiffness * row.length / name("m")),
                             static_cast<long double>(T) / 75,
                             1,
                             0,
                             start,
                             0};
  expect_states(box, *test_case.motion, mass, known, T, condition);
}

TEST(EllipticCases, TwoPendulaMeetAtTheirLowestPoints) {
  Box box(113);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 113, trial " << trial);
    const double
        l1 = box.decades(-1.0, 1.0),
        g = box.decades(-1.0, 1.0),
        theta1 = box.one_in(3) ? box.decades(-3.0, 0.0) : box.uniform(0.1, 3.1),
        k1 = std::sin(0.5 * theta1),
        // (m1/m2) k1/K(k1) below its limit; K(k1) = pi/(2 AGM(1, k1')), by the library of C++.
        largest = 0.4031 * std::comp_ellint_1(k1) / k1, m2 = box.decades(-1.0, 1.0),
        m1 = m2 * largest * box.uniform(0.01, 0.97);
    const auto test_case =
        make("two-pendula", {{"m1", m1},
                             {"m2", m2},
                             {"l1", l1},
                             {"g", g},
                             {"theta1", theta1},
                             {"t_end", box.uniform(1.0, 30.0) * std::sqrt(l1 / g)}});
    const double condition = 40.0 / std::cos(0.5 * theta1);
    for (const int mass : {0, 1}) expect_bob(box, test_case, mass, condition);
    EXPECT_NEAR(constant(test_case, "T1"), constant(test_case, "T2"),
                1e-15 * condition * constant(test_case, "T1"));
    if (test_case.motion->impact_count(test_case.motion->end()) == 0) continue;
    const auto hit = test_case.motion->impact(1);
    const double p = m1 * hit.before.v[0];
    EXPECT_NEAR(p + m2 * hit.before.v[1], 0.0, 1e-14 * -p);
    EXPECT_NEAR(hit.impulse, -2.0 * p, 1e-14 * -p);
    EXPECT_EQ(hit.after.v, -hit.before.v);
  }
  // Envelopes are the largest sizes, of accelerations beyond a quarter turn that of gravity.
  for (const double theta1 : {0.7, 2.2}) {
    const auto swung = make("two-pendula", {{"m1", 0.8}, {"theta1", theta1}});
    Eigen::MatrixX2d largest = Eigen::MatrixX2d::Zero(3, 2);
    for (int i = 0; i <= 5000; ++i) {
      const auto now = swung.motion->at(i * 0.001, Side::right);
      largest.row(0) = largest.row(0).cwiseMax(now.u.transpose().cwiseAbs());
      largest.row(1) = largest.row(1).cwiseMax(now.v.transpose().cwiseAbs());
      largest.row(2) = largest.row(2).cwiseMax(now.a.transpose().cwiseAbs());
    }
    const auto size = swung.motion->envelope(0.0);
    EXPECT_NEAR((largest.row(0).transpose() - size.u).norm(), 0.0, 1e-4);
    EXPECT_NEAR((largest.row(1).transpose() - size.v).norm(), 0.0, 2e-2);
    EXPECT_NEAR((largest.row(2).transpose() - size.a).norm(), 0.0, 1e-3);
  }
  // Solved with 40 digits.
  const auto expect = [](double theta1, double ratio, double k2, double l2) {
    const auto known = make("two-pendula", {{"m1", ratio}, {"theta1", theta1}});
    EXPECT_NEAR(std::sin(0.5 * constant(known, "theta2")), k2, 4e-16) << theta1;
    EXPECT_NEAR(constant(known, "l2"), l2, 4e-16 * l2) << theta1;
  };
  expect(1.0, 1.3, 0.67752288774038524523, 0.84621572691958399809);
  expect(0.5, 2.0, 0.52759941159677800036, 0.87955839308486215382);
  expect(2.0, 0.5, 0.32553094490481039607, 1.6704510042315846149);
}

TEST(EllipticCases, PendulaOfACradleRestInTurn) {
  Box box(114);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 114, trial " << trial);
    const double l1 = box.decades(-1.0, 1.0), g = box.decades(-1.0, 1.0),
                 theta1 = box.one_in(3) ? box.decades(-3.0, 0.0) : box.uniform(0.1, 3.1),
                 height = l1 * std::pow(std::sin(0.5 * theta1), 2),
                 l2 = height * (1.0 + box.decades(-2.0, 1.0));
    const auto test_case =
        make("pendulum-cradle", {{"l1", l1},
                                 {"l2", l2},
                                 {"g", g},
                                 {"theta1", theta1},
                                 {"t_end", box.uniform(1.0, 30.0) * std::sqrt(l1 / g)}});
    const auto& motion = *test_case.motion;
    const double T[] = {constant(test_case, "T1"), constant(test_case, "T2")};
    const double condition = 40.0 / std::cos(0.5 * theta1) / std::min(1.0, l2 / height - 1.0);
    // Either pendulum by its Taylor series over the time that it swings.
    using Number = long double;
    Bouncer<Number> bobs[] = {
        {pendulum<Number>(l1, g), Number(T[0]) / 75, 1, 0, test_case.problem.start.u[0], 0},
        {pendulum<Number>(l2, g), Number(T[1]) / 75, 1, 0, 0, std::sqrt(4 * Number(g) * height)}};
    Number begun = -Number(T[0]) / 2, swung[] = {-Number(T[0]) / 2, 0};
    for (int flight = 0; begun < motion.end() && flight < 30; ++flight) {
      const int mass = flight % 2;
      const double s = box.uniform(0.05, 0.95) * T[mass], t = double(begun + s);
      if (t > 0 && t < motion.end()) {
        bobs[mass].run_to(swung[mass] + s);
        const auto now = motion.at(t, Side::right), size = motion.envelope(t);
        const double sign = mass == 0 ? 1.0 : -1.0,
                     own = 1e-15 * (condition + (T[0] + T[1]) / T[mass]) * (2 + flight);
        EXPECT_NEAR(sign * now.u[mass], double(bobs[mass].u), own * size.u[mass]);
        EXPECT_NEAR(sign * now.v[mass], double(bobs[mass].v), own * size.v[mass]);
        EXPECT_EQ(now.u[1 - mass], 0.0);
        EXPECT_EQ(now.v[1 - mass], 0.0);
        EXPECT_EQ(motion.impact_count(t), flight);
      }
      begun += T[mass], swung[mass] += T[mass];
    }
    if (motion.impact_count(motion.end()) < 2) continue;
    const auto first = motion.impact(1), second = motion.impact(2);
    EXPECT_NEAR(first.t, 0.5 * T[0], 1e-15 * condition * T[0]);
    EXPECT_NEAR(second.t - first.t, T[1], 1e-15 * condition * (T[0] + T[1]));
    EXPECT_EQ(first.after.v, Eigen::Vector2d(first.before.v.reverse()));
    EXPECT_EQ(second.after.v, Eigen::Vector2d(second.before.v.reverse()));
    EXPECT_NEAR(0.5 * first.impulse * first.impulse, 2.0 * g * height, 1e-14 * g * height);
  }
}

#ifdef CLACKERS_HAS_ARB
using exact::testing_oracle::Real;

// Of mass i at 12 instants, and after the first impact.
void expect_digits(certified::Digits& digits, const model::Motion& motion, std::size_t i,
                   Bouncer<Real>& known) {
  const Real sign = i == 0 ? 1 : -1;
  const auto expect = [&](const std::string& given, const Real& value) {
    EXPECT_LE(abs(Real(sign * Real(given) - value)), Real("1e-60"))
        << "mass " << i + 1 << " at " << known.t;
  };
  for (int k = 1; k <= 12; ++k) {
    const double t = motion.end() * k / 13.0;
    known.run_to(t);
    const auto now = digits.at(t, Side::right);
    expect(now.u[i], known.u);
    expect(now.v[i], known.v);
  }
  ASSERT_GT(known.impacts, 1);
  const auto hit = digits.impact(1);
  EXPECT_LE(abs(Real(Real(hit.t) - known.first)), Real("1e-60"));
  expect(hit.before.v[i], -known.fastest);
  expect(hit.after.v[i], known.eta * known.fastest);
}

// With 90 digits.
TEST(EllipticCases, DigitsAreThoseOfTheirTaylorSeries) {
  const auto expect = [](const Case& test_case, const Expansion<Real>& expansion, double eta) {
    certified::Digits digits(*test_case.motion, 70);
    const Real start(digits.at(0.0, Side::right).u[0]);
    Bouncer<Real> known{expansion, Real(constant(test_case, "T_0")) / 150, eta, 0, start, 0};
    expect_digits(digits, *test_case.motion, 0, known);
  };
  const Settings pendulum_settings{{"l", 1.7}, {"theta0", 2.6}, {"eta", 0.7}};
  expect(make("pendulum", pendulum_settings), pendulum<Real>(1.7, 9.81), 0.7);
  for (const double b : {2.0, -0.6})
    expect(make("duffing-stop", {{"m", 1.3}, {"b", b}, {"eta", 0.9}}),
           duffing<Real>(Real(1.0) / Real(1.3), Real(b) / Real(1.3)), 0.9);
}

// With 90 digits; length and start of pendulum 2 from the digits of its start and of its acceleration there.
TEST(EllipticCases, DigitsOfTwoPendulaAreThoseOfTheirTaylorSeries) {
  for (const double m1 : {1.3, 0.2}) {
    const auto test_case = make("two-pendula", {{"m1", m1}, {"theta1", 0.9}, {"g", 9.5}});
    const auto& motion = *test_case.motion;
    certified::Digits digits(motion, 75);
    const auto start = digits.at(0.0, Side::right);
    // g sin(u2/l2) = a2 by Newton's method.
    const Real u2 = abs(Real(start.u[1])), a2 = abs(Real(start.a[1]));
    Real x = u2 / Real(constant(test_case, "l2"));
    for (int i = 0; i < 8; ++i) x = x - (Real(9.5) * sin(x) - a2) / (Real(9.5) * cos(x));
    for (const std::size_t i : {0U, 1U}) {
      const Real u = abs(Real(start.u[i])), l = i == 0 ? Real(1.0) : Real(u2 / x);
      Bouncer<Real> known{pendulum<Real>(l, 9.5), Real(constant(test_case, "T1")) / 75, 1, 0, u, 0};
      expect_digits(digits, motion, i, known);
    }
    const auto hit = digits.impact(1);
    EXPECT_LE(abs(Real(Real(m1) * Real(hit.before.v[0]) + Real(hit.before.v[1]))), Real("1e-60"));
    EXPECT_LE(abs(Real(Real(hit.energy_before) - Real(hit.energy_after))), Real("1e-60"));
    const Real v1(hit.before.v[0]), v2(hit.before.v[1]);
    EXPECT_LE(abs(Real(Real(hit.energy_before) - (Real(m1) * v1 * v1 + v2 * v2) / 2)),
              Real("1e-60"));
  }
}

// With 90 digits: pendulum 1 until the first impact, pendulum 2 until the second.
TEST(EllipticCases, DigitsOfPendulaInTurnAreThoseOfTheirTaylorSeries) {
  const auto test_case =
      make("pendulum-cradle", {{"l1", 0.9}, {"l2", 0.7}, {"theta1", 1.2}, {"t_end", 1.7}});
  const auto& motion = *test_case.motion;
  certified::Digits digits(motion, 70);
  Bouncer<Real> first{pendulum<Real>(0.9, 9.81),
                      Real(constant(test_case, "T1")) / 75,
                      1,
                      0,
                      Real(0.9) * Real(1.2),
                      0};
  first.run_to(1.0);
  const Real t1 = first.first, tight("1e-60");
  Bouncer<Real> second{
      pendulum<Real>(0.7, 9.81), Real(constant(test_case, "T2")) / 75, 1, t1, 0, first.fastest};
  for (int k = 1; k < 12; ++k) {
    const double t = motion.end() * k / 12.0;
    const auto now = digits.at(t, Side::right);
    if (Real(t) < t1 || second.impacts > 0) continue;
    second.run_to(t);
    if (second.impacts > 0) break;
    EXPECT_LE(abs(Real(Real(now.u[1]) + second.u)), tight) << t;
    EXPECT_LE(abs(Real(Real(now.v[1]) + second.v)), tight) << t;
    EXPECT_EQ(Real(now.u[0]), Real(0));
  }
  second.run_to(motion.end());
  ASSERT_EQ(second.impacts, 1);
  const auto one = digits.impact(1), two = digits.impact(2);
  EXPECT_LE(abs(Real(Real(one.t) - t1)), tight);
  EXPECT_LE(abs(Real(Real(two.t) - second.first)), tight);
  EXPECT_LE(abs(Real(Real(one.before.v[0]) + first.fastest)), tight);
  EXPECT_LE(abs(Real(Real(one.after.v[1]) + first.fastest)), tight);
  EXPECT_LE(abs(Real(Real(two.before.v[1]) - second.fastest)), tight);
  EXPECT_LE(abs(Real(Real(two.after.v[0]) - second.fastest)), tight);
  EXPECT_LE(abs(Real(Real(one.impulse) - first.fastest)), tight);
}

// Within their bounds, which are small, at 12 instants: the motion before and after impacts by the series of one swing
// after the other. The first begins at u0, and mass 1 and 2 take turns where there are two.
void expect_swings(const Case& test_case, const std::vector<Expansion<Real>>& masses,
                   const Real& step, const Real& u0, double eta) {
  const auto& motion = *test_case.motion;
  const auto size = motion.envelope(0.0);
  Bouncer<Real> known{masses[0], step, eta, 0, u0, 0};
  std::size_t mass = 0;
  for (int k = 1; k <= 12; ++k) {
    const double t = motion.end() * k / 13.0;
    known.run_to(t);
    while (masses.size() == 2 && known.impacts > 0) {
      mass = 1 - mass;
      known = {masses[mass], step, eta, known.first, 0, known.fastest};
      known.run_to(t);
    }
    const auto i = Eigen::Index(mass);
    const auto now = motion.at(t, Side::right), bound = motion.error_bound(t);
    const Real sign = mass == 0 ? 1 : -1;
    EXPECT_LE(abs(Real(sign * now.u[i] - known.u)), bound.u[i]) << t;
    EXPECT_LE(abs(Real(sign * now.v[i] - known.v)), bound.v[i]) << t;
    EXPECT_LT(bound.u[i], 5e-15 * size.u[i]) << t;
    EXPECT_LT(bound.v[i], 5e-15 * size.v[i]) << t;
  }
}

// With 90 digits, of which up to 32 are lost on the way: as many as E has in common with that of the separatrix.
TEST(EllipticCases, KeepTheirDigitsNearTheUnstableRest) {
  Box box(115);
  for (int trial = 0; trial < trials(1); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 115, trial " << trial);
    const double l = box.decades(-1.0, 1.0), g = box.decades(-1.0, 1.0),
                 theta = std::min(3.14159, std::numbers::pi - box.decades(-6.0, -2.0)),
                 eta = box.one_in(2) ? 1.0 : 1.0 - box.decades(-8.0, -1.0),
                 end = 45.0 * std::sqrt(l / g);
    const Real step = 0.5 * std::sqrt(l / g);
    expect_swings(
        make("pendulum", {{"l", l}, {"g", g}, {"theta0", theta}, {"eta", eta}, {"t_end", end}}),
        {pendulum<Real>(l, g)}, step, Real(l) * Real(theta), eta);
    expect_swings(
        make("two-pendula", {{"m1", 0.1}, {"l1", l}, {"g", g}, {"theta1", theta}, {"t_end", end}}),
        {pendulum<Real>(l, g)}, step, Real(l) * Real(theta), 1.0);
    const double height = l * std::pow(std::sin(0.5 * theta), 2),
                 l2 = height * (1.0 + box.decades(-8.0, -2.0));
    expect_swings(make("pendulum-cradle",
                       {{"l1", l}, {"l2", l2}, {"g", g}, {"theta1", theta}, {"t_end", end}}),
                  {pendulum<Real>(l, g), pendulum<Real>(l2, g)}, step, Real(l) * Real(theta), 1.0);
    const double m = box.decades(-1.0, 1.0), k = box.decades(-1.0, 1.0),
                 u0 = box.decades(-1.0, 1.0), w = std::sqrt(k / m),
                 b = -k / (u0 * u0) * (1.0 - box.decades(-14.0, -2.0));
    expect_swings(
        make("duffing-stop",
             {{"m", m}, {"k", k}, {"b", b}, {"u0", u0}, {"eta", eta}, {"t_end", 80.0 / w}}),
        {duffing<Real>(Real(k) / Real(m), Real(b) / Real(m))}, Real(0.25 / w), Real(u0), eta);
  }
  for (const double b : {-0.999999999, -0.99999999999, -0x1.fffffffffffffp-1})
    expect_swings(make("duffing-stop", {{"b", b}, {"eta", 1.0}, {"t_end", 100.0}}),
                  {duffing<Real>(1, b)}, Real(0.25), Real(1), 1.0);
  // By elliptic functions with 80 digits, of another library.
  const auto swung =
      make("pendulum",
           {{"l", 43.822}, {"g", 4.6203}, {"theta0", 3.1415}, {"eta", 1.0}, {"t_end", 300.0}});
  EXPECT_NEAR(swung.motion->at(97.8753825459573, Side::right).u[0], 120.45927916121450, 3e-14);
}
#endif

TEST(EllipticCases, EnvelopesOfSofteningSpringsAreTheLargestSizes) {
  for (const double b : {-0.2, -0.99}) {
    const auto swung = make("duffing-stop", {{"b", b}, {"eta", 1.0}, {"t_end", 30.0}});
    double largest = 0.0;
    for (int i = 0; i <= 3000; ++i)
      largest = std::max(largest, std::abs(swung.motion->at(i * 0.01, Side::right).a[0]));
    EXPECT_NEAR(swung.motion->envelope(0.0).a[0], largest, 1e-4) << b;
  }
}

TEST(EllipticCases, FastPeriodsAreNotLongerThanThoseOfSmallMotion) {
  const auto slow = make("pendulum", {{"theta0", 3.0}}), fast = make("duffing-stop", {{"b", 2.0}}),
             two = make("two-pendula");
  EXPECT_DOUBLE_EQ(slow.damped_periods[0], 2.0 * std::numbers::pi / std::sqrt(9.81));
  EXPECT_EQ(fast.damped_periods[0], constant(fast, "T_0"));
  for (const int i : {0, 1})
    EXPECT_DOUBLE_EQ(
        two.damped_periods[std::size_t(i)],
        2.0 * std::numbers::pi * std::sqrt(constant(two, "l" + std::to_string(i + 1)) / 9.81));
}

TEST(EllipticCases, AlmostPlasticImpactsAreTaken) {
  for (const auto* name : {"pendulum", "duffing-stop"}) {
    const auto test_case = make(name, {{"eta", 1e-100}});
    EXPECT_GT(test_case.motion->impact_count(test_case.motion->end()), 4) << name;
  }
}

TEST(EllipticCases, FunctionsOfAnOpenModulusAreBounded) {
  using numerics::Bounded;
  const Bounded open(1.0L, std::numeric_limits<long double>::infinity());
  for (const auto& modulus : {exact::Modulus<Bounded>{open, 0.1}, {0.9, open}}) {
    const auto [sn, cn, dn] = exact::jacobi<Bounded>(1.0, modulus);
    for (const auto& x : {sn, cn, dn}) EXPECT_EQ(upper(x).value, 1.0L);
  }
}

TEST(EllipticCases, HaveTheirTextbookPeriods) {
  const auto ratio = [](double degrees) {
    return constant(make("pendulum", {{"theta0", degrees * std::numbers::pi / 180.0}}),
                    "T_0/T_linear");
  };
  EXPECT_NEAR(ratio(30.0), 1.0174, 5e-5);
  EXPECT_NEAR(ratio(90.0), 1.18034, 5e-6);
  EXPECT_NEAR(ratio(0.01), 1.0, 1e-8);
  // Small motion is that above a rigid stop.
  const auto small = make("duffing-stop", {{"b", 0.0}, {"eta", 0.9}});
  const auto stop = make("stop", {{"xi1", 0.0}, {"eta", 0.9}});
  for (const double t : {0.3, 1.9, 7.0, 19.0})
    EXPECT_NEAR(small.motion->at(t, Side::right).u[0], stop.motion->at(t, Side::right).u[0], 1e-15);
}

TEST(EllipticCases, ProblemsAreReadAsTheyAreWritten) {
  for (const auto* name : {"pendulum", "duffing-stop", "two-pendula", "belt"}) {
    const auto problem = make(name).problem;
    const auto json = model::problem_json(problem), lines = model::problem_file_text(problem);
    EXPECT_EQ(model::problem_json(model::problem_from_text(json, name)), json);
    EXPECT_EQ(model::problem_file_text(model::problem_from_text(lines, name)), lines);
  }
}

TEST(EllipticCases, AreRefusedWithTheReason) {
  EXPECT_REFUSED(make("pendulum", {{"theta0", 3.2}}), "out-of-range", "stand");
  EXPECT_REFUSED(make("pendulum", {{"eta", 0.0}}), "out-of-range", "rests on the stop");
  EXPECT_REFUSED(make("duffing-stop", {{"b", -1.0}}), "not-admissible", "away from the stop");
  EXPECT_REFUSED(make("pendulum", {{"t_end", 1e7}}), "out-of-range", "impacts");
  EXPECT_REFUSED(make("two-pendula", {{"m1", 2.0}}), "not-admissible", "k1/K(k1) < 0.403");
  EXPECT_REFUSED(make("two-pendula", {{"theta1", 3.2}}), "out-of-range", "stand");
  EXPECT_REFUSED(make("pendulum-cradle", {{"l2", 0.2}}), "not-admissible", "over the top");
  EXPECT_REFUSED(make("pendulum-cradle", {{"theta1", 1e-5}, {"l2", 1e-8}, {"t_end", 1e8}}),
                 "not-admissible", "known to 1e-6");
}

}  // namespace
}  // namespace clackers::cases
