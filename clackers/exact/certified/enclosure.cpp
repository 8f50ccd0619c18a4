#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/enclosure.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/exact/certified/flights_enclosure.hpp"
#include "clackers/exact/certified/orbit_enclosure.hpp"
#include "clackers/exact/certified/shaped_enclosure.hpp"

namespace clackers::certified {
namespace {

// sin(odd pi / 2)
bool is_certain(const Ball& value, long bits) {
  return value.is_zero() || value.accuracy() >= bits;
}

bool is_certain(const KinematicBalls& values, long bits) {
  for (const auto* part : {&values.u, &values.v, &values.a})
    for (const auto& value : *part)
      if (!is_certain(value, bits)) return false;
  return true;
}

// Evaluates with more and more bits until the result is certain. A value that is not 0 becomes so
// at some number of bits, and those that are 0 come out as exact zeros.
template <class Evaluate, class IsDone>
auto refined(long bits, Evaluate evaluate, IsDone is_done) {
  for (long working = bits + 64;; working *= 2) {
    const WorkingBits scope(working);
    auto result = evaluate();
    if (is_done(result)) return result;
  }
}

}  // namespace

PairEnclosure::PairEnclosure(const Inputs& inputs)
    : Enclosure({inputs.collides, inputs.eta}), in_(inputs) {}

// The free parameters are 0 or within 1e-60 and 1e60, so each brings less than 2^253 into a
// denominator; the square of the energy has the most of them, less than 20. A restitution reaches
// 2^-1074, and eta^(2 k) is squared there.
double PairEnclosure::fraction_bits(long long flights) const {
  return 16384.0 + 4400.0 * double(flights);
}

// The constants with the working bits of now.
const PairEnclosure::Constants& PairEnclosure::constants() {
  if (c_.bits == WorkingBits::now()) return c_;
  c_.bits = WorkingBits::now();
  const Ball odd = in_.odd, r = in_.r, A = in_.amplitude;
  const double s = quarter_sine(in_.odd);
  if (in_.kind == Inputs::Kind::exact_data) {
    // As ExactDataPair writes them: k_i = m_i ((p Omega)^2 + sigma^2).
    c_.omega = in_.frequency;
    c_.sigma = in_.damping;
    c_.mass = {r * in_.mass, Ball(in_.mass)};
    c_.start = {A * odd, Ball(-s) * r * A};
    c_.frequency = {c_.omega, odd * c_.omega};
    return c_;
  }
  // Eq. (12), (13), (15), (17) with any mass ratio.
  const Ball xi1 = in_.damping, omega1 = sqrt(Ball(in_.stiffness) / in_.mass);
  const Ball damped = omega1 * sqrt((Ball(1.0) - xi1) * (Ball(1.0) + xi1));
  c_.sigma = xi1 * omega1;
  c_.mass = {Ball(in_.mass), Ball(in_.mass) / r};
  if (in_.exchanged) {
    c_.omega = damped / odd;
    c_.start = {Ball(s) * A, -(r * A * odd)};
    c_.frequency = {damped, c_.omega};
  } else {
    c_.omega = damped;
    c_.start = {A, Ball(-s) * r * A / odd};
    c_.frequency = {damped, odd * damped};
  }
  return c_;
}

Ball Enclosure::instant_now(long long k) {
  return (Ball(double(k - 1)) + timing_.first_impact) * Ball::pi() / omega();
}

Ball Enclosure::instant(long long k, long bits) {
  return refined(
      bits, [&] { return instant_now(k); }, [&](const Ball& t) { return is_certain(t, bits); });
}

// The k with t_k <= t < t_(k+1). It is never on the edge: t_k is transcendental, Omega being algebraic.
long long Enclosure::natural_flight(double t) {
  const auto floor_of_turns = [&] {
    const Ball turns = omega() * t / Ball::pi() + (1.0 - timing_.first_impact);
    Ball whole;
    arb_floor(whole.get(), turns.get(), WorkingBits::now());
    return whole;
  };
  const Ball k =
      refined(64, floor_of_turns, [](const Ball& whole) { return arb_is_exact(whole.get()) != 0; });
  return static_cast<long long>(k.middle());  // at most 2^50
}

long long Enclosure::impact_count(double t) {
  if (!timing_.collides) return 0;
  const auto instants = natural_flight(t);
  return timing_.at_once * (timing_.eta == 0.0 ? std::min(instants, 1LL) : instants);
}

double Enclosure::nearest_double_to_instant(long long k) {
  const auto rounded = [](const Ball& t, auto bound) {
    arf_t end;
    arf_init(end);
    bound(end, t.get(), WorkingBits::now());
    const double value = arf_get_d(end, ARF_RND_NEAR);
    arf_clear(end);
    return value;
  };
  return refined(
             64, [&] { return instant_now(k); },
             [&](const Ball& t) {
               return rounded(t, arb_get_lbound_arf) == rounded(t, arb_get_ubound_arf);
             })
      .middle();
}

long long Enclosure::flight(double t, model::Side side) {
  if (!timing_.collides) return 0;
  const auto k = natural_flight(t);
  for (const auto hit : {k, k + 1})
    if (hit >= 1 && nearest_double_to_instant(hit) == t)
      return side == model::Side::left ? hit - 1 : hit;
  return k;
}

Ball Enclosure::decay_now(long long k, const Ball& t) {
  return power(Ball(timing_.eta), static_cast<unsigned long>(k)) * exp(-(sigma() * t));
}

KinematicBalls PairEnclosure::at_now(long long k, double t) {
  const auto& c = constants();
  KinematicBalls now;
  // Each impact reverses the sign of the motion: the sgn of Eq. (22).
  const Ball e = (k % 2 == 0 ? decay_now(k, t) : -decay_now(k, t));
  for (std::size_t i = 0; i < static_cast<std::size_t>(in_.dof); ++i) {
    const Ball &w = c.frequency[i], &sigma = c.sigma, amplitude = e * c.start[i];
    const Ball cosine = cos(w * t), sine = sin(w * t);
    now.u.push_back(amplitude * cosine);
    now.v.push_back(-(amplitude * (sigma * cosine + w * sine)));
    now.a.push_back(amplitude * ((sigma * sigma - w * w) * cosine + Ball(2.0) * sigma * w * sine));
  }
  return now;
}

KinematicBalls Enclosure::at(double t, model::Side side, long bits) {
  const auto k = flight(t, side);
  return refined(
      bits, [&] { return at_now(k, t); },
      [&](const KinematicBalls& now) { return is_certain(now, bits); });
}

ImpactBalls PairEnclosure::impact_now(long long k) {
  const auto& c = constants();
  ImpactBalls hit;
  hit.t = instant_now(k);
  const Ball e = decay_now(k - 1, hit.t), eta = in_.eta;
  for (std::size_t i = 0; i < static_cast<std::size_t>(in_.dof); ++i) {
    // The sign of sin(w t_k) alternates from one impact to the next, and so does the motion's.
    const double s = quarter_sine(in_.multiple(i));
    const Ball v = Ball(-s) * c.start[i] * c.frequency[i] * e;
    for (auto* side : {&hit.before, &hit.after}) side->u.emplace_back();
    hit.before.v.push_back(v);
    hit.after.v.push_back(-(eta * v));
    hit.before.a.push_back(Ball(-2.0) * c.sigma * v);
    hit.after.a.push_back(Ball(2.0) * c.sigma * eta * v);
    hit.energy_before = hit.energy_before + scaled(c.mass[i] * v * v, -1);
  }
  hit.energy_after = eta * eta * hit.energy_before;
  hit.impulse = (Ball(1.0) + eta) * c.mass[0] * abs(hit.before.v[0]);
  return hit;
}

ImpactBalls Enclosure::impact(long long k, long bits) {
  return refined(
      bits, [&] { return impact_now(k); },
      [&](const ImpactBalls& hit) {
        for (const auto* value : {&hit.t, &hit.impulse, &hit.energy_before, &hit.energy_after})
          if (!is_certain(*value, bits)) return false;
        return is_certain(hit.before, bits) && is_certain(hit.after, bits);
      });
}

std::unique_ptr<Enclosure> enclosure_of(const model::Motion& motion) {
  if (const auto* shaped = dynamic_cast<const exact::ShapedMotion*>(&motion))
    return std::make_unique<ShapedEnclosure>(*shaped);
  if (const auto* flights = dynamic_cast<const exact::PiecewiseMotion*>(&motion))
    return std::make_unique<FlightsEnclosure>(*flights);
  if (const auto* orbit = dynamic_cast<const exact::Flights*>(&motion);
      orbit != nullptr && orbit->parameters().index() != 0)
    return std::make_unique<OrbitEnclosure>(*orbit);
  return std::make_unique<PairEnclosure>(Inputs(motion));
}

}  // namespace clackers::certified

#endif
