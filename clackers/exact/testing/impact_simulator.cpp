#include "clackers/exact/testing/impact_simulator.hpp"

#include <algorithm>
#include <stdexcept>

namespace clackers::exact::testing_oracle {

FreeMass90::FreeMass90(const Real& m, const Real& c, const Real& k, const RawForce& force)
    : m_(m), c_(c), k_(k), sigma_(c / (2 * m)), force_(force) {
  const Real square = k / m - sigma_ * sigma_;
  if (!(square > 0)) throw std::domain_error("simulator: c^2 < 4 m k is needed");
  w_ = sqrt(square);
  // u = x cos(nu t + phase) + y sin(nu t + phase): the coefficients of M a + C v + K u.
  const Real nu = force.frequency, d = k - m * nu * nu, f = c * nu;
  if (force.amplitude == 0) return;
  steady_cos_ = force.amplitude * d / (d * d + f * f);
  steady_sin_ = force.amplitude * f / (d * d + f * f);
}

void FreeMass90::start(const Real& t, const Real& u, const Real& v) {
  t_ = t;
  p_ = u - steady(t, 0);
  q_ = (v - steady(t, 1) + sigma_ * p_) / w_;
  amplitude_ = sqrt(p_ * p_ + q_ * q_);
}

void FreeMass90::put(const Real& s, RawState& to, std::size_t i) const {
  const Real e = exp(-sigma_ * s), phase = w_ * s;
  Real sine, cosine;
  sin_cos(phase, sine, cosine);
  const Real x = e * (p_ * cosine + q_ * sine), y = e * (q_ * cosine - p_ * sine);
  to.u[i] = x;
  to.v[i] = w_ * y - sigma_ * x;
  to.a[i] = -(c_ * to.v[i] + k_ * to.u[i]) / m_;
  if (force_.amplitude == 0) return;
  to.u[i] += steady(t_ + s, 0);
  to.v[i] += steady(t_ + s, 1);
  to.a[i] = (force_.amplitude * cos(force_.frequency * (t_ + s) + force_.phase) - c_ * to.v[i] -
             k_ * to.u[i]) /
            m_;
}

Real FreeMass90::steady_curvature() const {
  return sqrt(steady_cos_ * steady_cos_ + steady_sin_ * steady_sin_) * force_.frequency *
         force_.frequency;
}

Real FreeMass90::rate(const Real& shift) const {
  const Real rest = sigma_ - shift;
  return sqrt(rest * rest + w_ * w_);
}

Real FreeMass90::energy(const RawState& x, std::size_t i) const {
  return (m_ * x.v[i] * x.v[i] + k_ * x.u[i] * x.u[i]) / 2;
}

Real FreeMass90::steady(const Real& t, int derivative) const {
  if (force_.amplitude == 0) return 0;
  const Real x = force_.frequency * t + force_.phase;
  return derivative == 0 ? steady_cos_ * cos(x) + steady_sin_ * sin(x)
                         : force_.frequency * (steady_sin_ * cos(x) - steady_cos_ * sin(x));
}

ImpactSimulator::ImpactSimulator(const RawPair& p)
    : masses_{FreeMass90(p.m1, p.c1, p.k1, p.force1), FreeMass90(p.m2, p.c2, p.k2, p.force2)},
      eta_(p.eta),
      gap_(p.gap) {
  // Nearly critical masses decay to e^(-1e9) between impacts.
  mpfr_set_emin(mpfr_get_emin_min());
  mpfr_set_emax(mpfr_get_emax_max());
  fly_from({Real(0), {p.u10, p.u20}, {p.v10, p.v20}, {}});
  // Allowed to start touching, as after an impact.
  if (gap(start_) < -tiny()) throw std::domain_error("simulator: the masses overlap at t = 0");
}

RawState ImpactSimulator::at(const Real& t) const {
  RawState x;
  x.t = t;
  const Real s = t - start_.t;
  for (std::size_t i = 0; i < 2; ++i) masses_[i].put(s, x, i);
  return x;
}

std::optional<RawPairImpact> ImpactSimulator::next(const Real& until) {
  if (eta_ == 0 && hits_ > 0) throw std::domain_error("simulator: the masses may stick");
  const auto t = first_contact(until);
  if (!t) return std::nullopt;
  RawPairImpact hit;
  hit.before = hit.after = at(*t);
  hit.energy_before = energy(hit.before);
  // Newton's law, u1' - u2' -> -eta (u1' - u2'), and conserved momentum.
  const Real closing = hit.before.v[0] - hit.before.v[1];
  const Real &m1 = masses_[0].mass(), &m2 = masses_[1].mass();
  hit.impulse = -(1 + eta_) * closing * m1 * m2 / (m1 + m2);
  hit.after.v[0] += hit.impulse / m1;
  hit.after.v[1] -= hit.impulse / m2;
  ++hits_;
  fly_from(hit.after);
  hit.after = at(*t);  // with its acceleration
  hit.energy_after = energy(hit.after);
  return hit;
}

void ImpactSimulator::fly_from(const RawState& x) {
  start_ = x;
  for (std::size_t i = 0; i < 2; ++i) masses_[i].start(x.t, x.u[i], x.v[i]);
  // With a gap or a force G'' has a part that does not decay, so nothing is factored out.
  shift_ = gap_ == 0 && !masses_[0].is_forced() && !masses_[1].is_forced()
               ? std::min(masses_[0].sigma(), masses_[1].sigma())
               : Real(0);
  bound_ = 0;
  for (const auto& mass : masses_) {
    const Real rate = mass.rate(shift_);
    bound_ += mass.amplitude() * rate * rate + mass.steady_curvature();
  }
}

Real ImpactSimulator::tiny() const {
  static const Real tolerance("1e-70");
  return (masses_[0].amplitude() + masses_[1].amplitude() + abs(gap_)) * tolerance;
}

std::optional<Real> ImpactSimulator::first_contact(const Real& until) const {
  // Where a flight starts touching with the gap growing, the first step is over 0 by its slope alone.
  Real s = 0, value = gap(start_), slope = start_.v[0] - start_.v[1] + shift_ * value;
  const bool touching = value < tiny();
  if (touching) value = 0;
  const Real span = until - start_.t;
  for (int steps = 0;; ++steps) {
    if (steps > 1000000 || !isfinite(value)) throw std::domain_error("simulator: undecided");
    if ((steps > 0 || (touching && slope <= 0)) && value < tiny()) {
      // G + G' x + M x^2 / 2 < 0 for some x proves that the masses meet at all.
      if (!(slope < 0 && slope * slope > 4 * bound_ * tiny()))
        throw std::domain_error("simulator: the masses graze");
      // One plain Newton step over what is left, too small to be proven and to matter.
      s += value / -slope;
      return s <= span ? std::optional<Real>(start_.t + s) : std::nullopt;
    }
    const Real root = sqrt(slope * slope + 2 * bound_ * value);
    // Both forms of the parabola's zero; neither subtracts.
    s += slope > 0 ? (slope + root) / bound_ : 2 * value / (root - slope);
    if (s > span) return std::nullopt;
    const RawState x = at(start_.t + s);
    const Real scale = shift_ == 0 ? Real(1) : exp(shift_ * s), g = gap(x);
    value = scale * g;
    slope = scale * (x.v[0] - x.v[1] + shift_ * g);
  }
}

std::vector<RawState> simulate(const RawPair& pair, std::span<const Real> times) {
  ImpactSimulator simulator(pair);
  std::vector<RawState> states;
  for (const auto& t : times) {
    while (simulator.next(t)) {
    }
    states.push_back(simulator.at(t));
  }
  return states;
}

}  // namespace clackers::exact::testing_oracle
