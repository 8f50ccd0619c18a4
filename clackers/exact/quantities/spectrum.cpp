#include "clackers/exact/quantities/spectrum.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/parameters.hpp"
#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact {
namespace {

using numerics::DoubleDouble;
using Complex = std::complex<double>;

constexpr DoubleDouble inverse_pi{0.31830988618379069, -1.9678676675182486e-17};

// Sine and cosine of pi y: whole turns are taken off exactly first. |y| < most_radians/pi < 2^54
// keeps the low part below 1.
numerics::SineCosine turned(const DoubleDouble& y) {
  const auto rest = numerics::two_sum(std::remainder(y.hi, 2.0), y.lo);
  return numerics::sincospi(rest);
}

// -expm1(-(alpha + i pi turns)) for alpha >= 0. Both parts of the real part have one sign where its
// cosine is positive, and 1 leads where it is not.
Complex one_minus_exp(double alpha, const DoubleDouble& turns) {
  const auto whole = turned(turns), half = turned(turns * 0.5);
  const double decayed = -std::expm1(-alpha), sine = half.sine.hi;
  return {decayed * whole.cosine.hi + 2.0 * sine * sine, std::exp(-alpha) * whole.sine.hi};
}

// (1 - exp(-s))/s for s = alpha + i pi turns; 1 at s = 0.
Complex psi(double alpha, const DoubleDouble& turns) {
  const Complex s(alpha, numerics::pi.hi * turns.hi);
  return s == 0.0 ? Complex(1.0) : one_minus_exp(alpha, turns) / s;
}

// 2^halvings exp(-i pi turns)
Complex wave(const DoubleDouble& halvings, const DoubleDouble& turns) {
  const auto [sine, cosine] = turned(turns);
  return numerics::exp2_rounded(halvings) * Complex(cosine.hi, -sine.hi);
}

}  // namespace

Spectrum::Spectrum(const ClosedForm& motion) : motion_(motion) {
  const auto& c = motion.flight();
  inverse_ = DoubleDouble{c.period.hi, c.period.mid} * inverse_pi;
  omega_ = c.turns.hi * numerics::pi.hi;
  sigma_ = c.decay.hi * std::log(2.0);
  const auto phase = motion.phase(c.end, model::Side::right);
  impacts_ = phase.flight;
  const auto all = c.turns * c.end;
  last_ = impacts_ > 0.0 ? phase.theta_over_pi + DoubleDouble{0.5, 0.0}
                         : numerics::quick_two_sum(all.hi, all.mid);
}

std::array<Complex, 2> Spectrum::at(double omega) const {
  const auto& c = motion_.flight();
  if (!(omega >= 0.0 && omega * c.end <= most_radians))
    refuse("spectrum", "omega", omega,
           fmt::format("0 <= omega <= {:.6g} rad/s, which is 2^55 radians over the run",
                       most_radians / c.end));
  // Lengths are in half periods T, so that pi h times a length is a phase.
  const auto h = inverse_ * omega;
  const double T = c.period.hi, K = impacts_;
  const auto first = K > 0.0 ? DoubleDouble{0.5, 0.0} : last_;
  const bool flies_on = K > 0.0 && c.eta > 0.0;
  // Flights 1 to K - 1: a geometric sum of ratio exp(L).
  Complex whole = 0.0, last = 0.0;
  if (flies_on) {
    const auto halvings = c.log2_eta - c.period_decay;
    const double n = K - 1.0, shrink = -std::log(2.0) * halvings.hi;
    const auto above = one_minus_exp(n * shrink, h * n), below = one_minus_exp(shrink, h);
    whole = wave(c.log2_eta - c.period_decay * 0.5, h * 0.5) *
            (below == 0.0 ? Complex(n) : above / below);
    last = wave(c.log2_eta * K - c.period_decay * (K - 0.5), h * (K - 0.5));
  }

  std::array<Complex, 2> result{};
  for (std::size_t i = 0; i < c.masses.size(); ++i) {
    const double q = c.masses[i].multiple, w = q * omega_;
    const auto near = h - DoubleDouble{q, 0.0}, far = h + DoubleDouble{q, 0.0};
    // Integrals of exp(-(z -+ iw) t).
    const auto integral = [&](const DoubleDouble& detuning, const DoubleDouble& length) {
      return T * length.hi * psi(sigma_ * T * length.hi, detuning * length);
    };
    // z - iw and z + iw, z = sigma + i omega.
    const Complex slow(sigma_, omega_ * near.hi), quick(sigma_, omega_ * far.hi);
    Complex sum;
    if (std::abs(slow) * T * first.hi > 1.0) {
      // The sum of the two integrals, each of size 1/w, would cancel to z/w^2 far from resonance.
      const Complex z(sigma_, omega);
      const auto [sine, cosine] = turned(first * q);
      const auto left = wave(-(c.period_decay * first), h * first);
      sum = (z - left * (z * cosine.hi - w * sine.hi)) / slow / quick;
    } else {
      sum = 0.5 * (integral(near, first) + integral(far, first));
    }
    if (flies_on) {
      // Over a whole flight exp(i w T) = -1 leaves the one factor that resonates.
      const Complex flight = T * psi(sigma_ * T, near) / quick;
      const Complex tail = (integral(near, last_) - integral(far, last_)) / Complex(0.0, 2.0 * w);
      sum += w * quarter_sine(q) * (whole * flight + last * tail);
    }
    result[i] = c.masses[i].b.hi * sum + Complex(0.0, 0.0);  // no -0
  }
  return result;
}

}  // namespace clackers::exact
