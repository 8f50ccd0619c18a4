#include "clackers/exact/quantities/energy.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact {

using model::Side;
using numerics::DoubleDouble;
using numerics::exp2_rounded;

namespace {

// Gauss and Legendre's rule of ten points on [-1, 1], the positive half.
constexpr double nodes[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                            0.8650633666889845, 0.9739065285171717};
constexpr double weights[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                              0.1494513491505806, 0.0666713443086881};

}  // namespace

EnergyAccount::EnergyAccount(const ClosedForm& motion) : motion_(motion) {
  const auto& c = motion.flight();
  const auto& system = motion.problem().system;
  sigma_ = c.decay.hi * std::log(2.0);
  period_ = c.period.hi;
  log_ratio_ = 2.0 * std::log(2.0) * (c.log2_eta - c.period_decay).hi;
  for (const auto& mass : c.masses) {
    const auto i = static_cast<Eigen::Index>(count_);
    const double w = std::abs(mass.v_sin.hi / mass.b.hi);
    bodies_[count_++] = {system.mass(i, i), system.stiffness(i, i), w, mass.multiple, mass.b.hi};
    in_first_half_ += 0.5 * system.mass(i, i) * mass.b.hi * mass.b.hi *
                      (-w * w * std::expm1(-sigma_ * period_) + 2.0 * sigma_ * sigma_);
  }
  at_first_hit_ = c.energy.hi * exp2_rounded(-c.period_decay);
}

// 1 + g + ... + g^(count - 1) with g = eta^2 exp(-2 sigma T).
double EnergyAccount::sum_over_impacts(double count) const {
  if (motion_.flight().eta == 0.0) return std::min(count, 1.0);
  if (log_ratio_ == 0.0) return count;
  return std::expm1(count * log_ratio_) / std::expm1(log_ratio_);
}

// The integral of 2 m sigma v^2 from 0 to t, v = -b exp(-sigma t) (sigma cos wt + w sin wt).
double EnergyAccount::dissipated_in_first_flight(const Body& body, double t,
                                                 const DoubleDouble& theta_over_pi) const {
  const double w = body.frequency, s = sigma_, scale = 0.5 * body.mass * body.start * body.start;
  if (std::max(s, w) * t <= 0.5) {
    // In closed form this is a difference of nearly equal numbers. The integrand is positive, and
    // with |2 (s + iw)| t <= sqrt 2 the rule of ten points leaves out less than
    // (10!)^4/(21 (20!)^3) sqrt(2)^20 < 1e-27 of its largest value times t.
    double sum = 0.0;
    for (int i = 0; i < 5; ++i)
      for (const double sign : {-1.0, 1.0}) {
        const double tau = 0.5 * t * (1.0 + sign * nodes[i]);
        const double v = s * std::cos(w * tau) + w * std::sin(w * tau);
        sum += weights[i] * std::exp(-2.0 * s * tau) * v * v;
      }
    return scale * 2.0 * s * t * sum;
  }
  const auto [sine, cosine] = numerics::sincospi(theta_over_pi * body.multiple);
  const double decayed = -std::expm1(-2.0 * s * t);
  return scale * ((w * w + 2.0 * s * s) * decayed +
                  std::exp(-2.0 * s * t) * 2.0 * s * sine.hi * (s * sine.hi - w * cosine.hi));
}

EnergySplit EnergyAccount::at(double t, Side side) const {
  const auto [flight, theta_over_pi] = motion_.phase(t, side);
  const auto state = motion_.at(t, side);
  const auto& c = motion_.flight();
  EnergySplit split;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    split.kinetic += 0.5 * bodies_[i].mass * state.v[at] * state.v[at];
    split.potential += 0.5 * bodies_[i].stiffness * state.u[at] * state.u[at];
    if (flight == 0.0) split.dissipated += dissipated_in_first_flight(bodies_[i], t, theta_over_pi);
  }
  if (flight == 0.0) return split;

  split.lost = at_first_hit_ * (1.0 - c.eta) * (1.0 + c.eta) * sum_over_impacts(flight);
  split.dissipated = in_first_half_;
  if (c.eta == 0.0) return split;
  split.dissipated += at_first_hit_ * c.eta * c.eta * -std::expm1(-2.0 * sigma_ * period_) *
                      sum_over_impacts(flight - 1.0);

  // From the impact on: m V^2/2 times 1 - exp(-2 sigma x) [1 - (s/w) sin 2wx + 2 (s/w)^2 sin^2
  // wx], V the velocity just after it.
  const auto part = theta_over_pi + DoubleDouble{0.5, 0.0};
  const double x = std::max(0.0, part.hi) * period_;
  const double decayed = -std::expm1(-2.0 * sigma_ * x), left = std::exp(-2.0 * sigma_ * x);
  const double after = exp2_rounded(c.log2_eta * flight - c.period_decay * (flight - 0.5));
  for (std::size_t i = 0; i < count_; ++i) {
    const auto [sine, cosine] = numerics::sincospi(part * bodies_[i].multiple);
    const double V = c.masses[i].v_hit.hi * after, q = sigma_ / bodies_[i].frequency;
    split.dissipated += 0.5 * bodies_[i].mass * V * V *
                        (decayed + left * 2.0 * q * sine.hi * (cosine.hi - q * sine.hi));
  }
  return split;
}

double EnergyAccount::momentum(double t, Side side) const {
  const auto state = motion_.at(t, side);
  double sum = 0.0;
  for (std::size_t i = 0; i < count_; ++i)
    sum += bodies_[i].mass * state.v[static_cast<Eigen::Index>(i)];
  return sum;
}

double EnergyAccount::initial() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto& body = bodies_[i];
    sum += 0.5 * body.mass * body.start * body.start *
           (body.frequency * body.frequency + 2.0 * sigma_ * sigma_);
  }
  return sum;
}

}  // namespace clackers::exact
