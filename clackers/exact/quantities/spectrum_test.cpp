#include "clackers/exact/quantities/spectrum.hpp"

#include <gtest/gtest.h>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_members.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using namespace testing_oracle;

struct WideComplex {
  Real re, im;
};
WideComplex operator+(const WideComplex& a, const WideComplex& b) {
  return {a.re + b.re, a.im + b.im};
}
WideComplex operator*(const WideComplex& a, const WideComplex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
WideComplex over(const WideComplex& a) {
  const Real square = a.re * a.re + a.im * a.im;
  return {a.re / square, -a.im / square};
}
Real size(const WideComplex& a) { return sqrt(a.re * a.re + a.im * a.im); }

// Integral of exp(-z t) b exp(i w t) from one time to another: (f(to) - f(from))/(iw - z).
WideComplex wave(const Real& b, const Real& sigma, const Real& detuning, const Real& from,
                 const Real& to) {
  const WideComplex rate{-sigma, detuning};
  const auto at = [&](const Real& t) {
    const Real e = b * exp(-sigma * t);
    return WideComplex{e * cos(detuning * t), e * sin(detuning * t)};
  };
  const auto start = at(from), end = at(to);
  return WideComplex{end.re - start.re, end.im - start.im} * over(rate);
}

struct Transform {
  WideComplex whole{0, 0};
  Real parts = 0;  // magnitudes of first flight, whole flights and the last one
};

// Flight by flight, as the integral is defined.
Transform transform(const Oracle& o, int i, const Real& omega, const Real& end) {
  const auto& m = o.mass[i];
  WideComplex part[3] = {{0, 0}, {0, 0}, {0, 0}};
  const auto last = o.impacts(double(end));
  for (long long k = 0; k <= last; ++k) {
    const Real from = k == 0 ? Real(0) : o.instant(double(k));
    const Real to = k == last ? end : o.instant(double(k + 1));
    const Real b = (k % 2 == 0 ? 1 : -1) * m.start * pow(Real(o.eta), k) / 2;
    auto& sum = part[k == 0 ? 0 : k == last ? 2 : 1];
    sum = sum + wave(b, o.sigma, m.frequency - omega, from, to) +
          wave(b, o.sigma, -m.frequency - omega, from, to);
  }
  Transform t;
  for (const auto& one : part) {
    t.whole = t.whole + one;
    t.parts += size(one);
  }
  return t;
}

void expect_transform(const ClosedForm& motion, const Oracle& oracle, double omega) {
  const auto found = Spectrum(motion).at(omega);
  for (int i = 0; i < oracle.dof; ++i) {
    const auto reference = transform(oracle, i, omega, motion.end());
    const auto& f = found[static_cast<std::size_t>(i)];
    const WideComplex error{reference.whole.re - Real(f.real()),
                            reference.whole.im - Real(f.imag())};
    EXPECT_LE(size(error), 1e-13 * reference.parts)
        << "omega " << omega << " mass " << i + 1 << " found " << f << " parts " << reference.parts;
  }
}

TEST(Spectrum, IsTheTransformOfEveryFlightOfRandomPairs) {
  constexpr unsigned seed = 20260421;
  Box box(seed);
  for (int i = 0; i < trials(8); ++i) {
    auto p = simple_pair(box);
    // From before the first impact to some hundred of them.
    p.t_end *= box.one_in(4) ? 0.09 : box.decades(-0.5, 1.5);
    if (box.one_in(5)) p.eta = 0.0;
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " xi1 " << p.xi1
                                    << " X " << p.X << " eta " << p.eta << " end " << p.t_end);
    const SynchronizedPair motion(p);
    const auto oracle = oracle_of(p);
    const double slow = double(oracle.omega), odd = p.X < 1.0 ? 1.0 / p.X : p.X;
    // Resonances to the last bit, multiples of 2 Omega where all flights add up, and others.
    for (const double w : {1.0, odd, 2.0, std::round(odd) + 1.0, 4.0, 0.3, 1.7, 30.0, 1e3})
      expect_transform(motion, oracle, w * slow);
    for (int n = 0; n < 4; ++n)
      expect_transform(motion, oracle, slow * odd * box.decades(-3.0, 2.0));
    if (HasFailure()) return;
  }
}

TEST(Spectrum, IsRightBesideEveryResonanceOfALongRun) {
  for (const double xi1 : {0.0, 1e-8, 1e-3})
    for (const double eta : {1.0, 1.0 - 1e-6}) {
      // A frequency that is no double, since the oracle divides by what vanishes at resonance.
      const PairParameters p{.k1 = 1.7, .xi1 = xi1, .X = 3.0, .r = 2.0, .eta = eta, .t_end = 60.0};
      const SynchronizedPair motion(p);
      const auto oracle = oracle_of(p);
      const double slow = double(oracle.omega);
      for (const double w : {1.0, 2.0, 3.0, 8.0})
        for (const double off : {0.0, 1e-15, 1e-12, -1e-8, 1e-5, 1e-3})
          expect_transform(motion, oracle, w * slow * (1.0 + off));
    }
}

TEST(Spectrum, OfHeavyDampingAndAFastMassIsRightFarFromResonance) {
  // The first flight is z/w^2 between integrals of size 1/w.
  const struct {
    double X, xi1;
  } table[] = {{400001.0, 0.99}, {62423.0, 0.9943}, {999999997.0, 0.9965}, {999999997.0, 0.999}};
  for (const auto& [X, xi1] : table) {
    const PairParameters p{.xi1 = xi1, .X = X, .r = 1.0, .t_end = 100.0};
    const SynchronizedPair motion(p);
    for (const double omega : {0.0, 1e-3, 1.0, 30.0, 0.14 * X})
      expect_transform(motion, oracle_of(p), omega);
  }
}

// The transform by Gauss's rule of five points on short pieces of each flight of the motion itself.
std::array<std::complex<double>, 2> quadrature(const ClosedForm& motion, double omega,
                                               double piece) {
  constexpr double nodes[] = {0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr double weights[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  std::array<std::complex<double>, 2> sum{};
  double from = 0.0;
  for (long long k = 1; from < motion.end(); ++k) {
    const bool more = k <= motion.impact_count(motion.end());
    const double to = more ? motion.impact(k).t : motion.end();
    const double h = (to - from) / std::ceil((to - from) / piece);
    for (double a = from; a < to - 0.5 * h; a += h)
      for (int n = 0; n < 3; ++n)
        for (const double sign : {-1.0, 1.0}) {
          if (n == 0 && sign < 0.0) continue;
          const double t = std::min(motion.end(), a + 0.5 * h * (1.0 + sign * nodes[n]));
          const auto u = motion.at(t, Side::left).u;
          for (Eigen::Index i = 0; i < u.size(); ++i)
            sum[std::size_t(i)] += 0.5 * h * weights[n] * u[i] * std::polar(1.0, -omega * t);
        }
    from = to;
  }
  return sum;
}

void expect_quadrature(const ClosedForm& motion, double omega) {
  const auto found = Spectrum(motion).at(omega), expected = quadrature(motion, omega, 0.02);
  // (0.02 * 12)^10 of the rule for the highest frequencies, over 10!.
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LE(std::abs(found[i] - expected[i]), 1e-12) << "omega " << omega << " mass " << i + 1;
}

TEST(Spectrum, IsTheIntegralAtExactResonance) {
  // sigma = 0, Omega = 1 and omega whole: z^2 + w^2 is exactly 0, and so is the sum's denominator.
  const ExactDataPair motion({.sigma = 0.0, .X = 5.0});
  for (const double omega : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 1.0 + 0x1p-52, 5.0 - 0x1p-50})
    expect_quadrature(motion, omega);
}

TEST(Spectrum, IsTheIntegralWithoutAStopAndBeforeAndWithoutRebound) {
  const FreeMass free({.xi1 = 0.02, .t_end = 31.0});
  const FreeMass undamped({.xi1 = 0.0, .t_end = 31.0});
  const RigidStop stop({.xi1 = 0.1, .eta = 0.6});
  const RigidStop dead({.xi1 = 0.1, .eta = 0.0});
  const SynchronizedPair early({.t_end = 1.0});
  for (const double omega : {0.0, 0.4, 1.0, 2.0, 3.3}) {
    expect_quadrature(free, omega);
    expect_quadrature(undamped, omega);
    expect_quadrature(stop, omega);
    expect_quadrature(dead, omega);
    expect_quadrature(early, omega);
  }
}

TEST(Spectrum, OfARunOfABillionSecondsHasALineAtTwiceTheFrequency) {
  // Of |sin theta| the line at 2 Omega is 2/(3 pi) a second, 4/(3 pi) being its amplitude.
  const ExactDataPair motion({.sigma = 0.0, .A_over_X = 1.0, .X = 1.0, .r = 0.5, .t_end = 1e9});
  const auto line = Spectrum(motion).at(2.0)[0];
  // The run ends within a period, of 1e9/pi.
  EXPECT_NEAR(std::abs(line) / 1e9, 2.0 / (3.0 * 3.14159265358979), 1e-8);
}

TEST(Spectrum, RefusesFrequenciesThatAreNegativeOrWhosePhaseIsUncertain) {
  const SynchronizedPair motion({});
  const Spectrum spectrum(motion);
  for (const double omega : {-1.0, 2e15, double(NAN), double(INFINITY)})
    EXPECT_THROW(spectrum.at(omega), InputError) << omega;
  EXPECT_NO_THROW(spectrum.at(1.8e15));
}

}  // namespace
}  // namespace clackers::exact
