#include "clackers/exact/bodies/bar_contact.hpp"

#include <cmath>

#include "clackers/exact/bodies/bar_waves.hpp"

namespace clackers::exact {

using model::Side;
using numerics::Bounded, numerics::narrowed, numerics::Wide, numerics::WideReal;

BarContact::BarContact(const BarsParameters& parameters, std::string_view who)
    : p_(parameters), waves_(std::make_unique<const Waves>(parameters, who)) {}

BarContact::~BarContact() = default;

BarContact::Wave BarContact::wave(std::size_t bar) const {
  const auto& [tau, c, z, out] = waves_->waves_[bar];
  return {narrowed(tau), narrowed(c), narrowed(z)};
}

std::vector<double> BarContact::lengths() const {
  std::vector<double> list;
  for (const auto& bar : p_.bars) list.push_back(bar.L);
  return list;
}

Bounded BarContact::gap() const { return narrowed(waves_->gap_); }
Bounded BarContact::period() const { return narrowed(waves_->period_); }

BarContact::Point BarContact::at(std::size_t bar, double x, double t, Side side) const {
  const auto& w = *waves_;
  const auto now = w.folded(t).t, late = Wide(x) / w.waves_[bar].c, half = Wide(0.5);
  const auto o = w.outgoing(bar, now - late, side, half_spacing(t)),
             a = w.arriving(bar, now + late, side, half_spacing(t));
  auto stress = Wide(p_.bars[bar].rho) * w.waves_[bar].c * (half * (a - o) + Wide(p_.g) * late);
  // The left bar is seen from its right end.
  if (bar + 1 < p_.bars.size()) stress = -stress;
  return {narrowed(w.displacement(bar, x, now)), narrowed(half * (o + a)), narrowed(stress)};
}

Bounded BarContact::gap(double t) const {
  const auto now = waves_->folded(t).t;
  const auto& phase = waves_->phase(now, Side::right, 0);
  return phase.closed ? Bounded(0.0)
                      : narrowed(phase.gap + Waves::moved(phase.rate, phase.slope, now - phase.t));
}

Bounded BarContact::force(double t, Side side) const {
  const auto now = waves_->folded(t).t;
  const auto& phase = waves_->phase(now, side, half_spacing(t));
  return phase.closed
             ? narrowed(-(waves_->compliance_ * (phase.rate + phase.slope * (now - phase.t))))
             : Bounded(0.0);
}

Bounded BarContact::impulse(double t, Side) const {
  const auto [now, periods] = waves_->folded(t);
  auto sum = waves_->impulse(now);
  if (periods > 0) {
    const auto& T = waves_->period_;
    sum = sum + Wide(periods, 0) * (waves_->impulse(Wide(2.0) * T) - waves_->impulse(T));
  }
  return narrowed(sum);
}

std::vector<BarContact::Event> BarContact::events() const {
  std::vector<Event> list;
  for (const auto& [closes, t] : waves_->events_)
    if (!(waves_->period_.value > 0 && t.value > waves_->period_.value))
      list.push_back({closes, narrowed(t)});
  return list;
}

BarContact::Changes BarContact::changes() const {
  Changes found{{}, period()};
  for (const auto& event : events()) found.first.push_back(event.t);
  return found;
}

// The velocity and c u_x are linear between fronts, so two points of Gauss give their squares exactly.
BarContact::Energy BarContact::energy(double time) const {
  Wide kinetic, elastic, potential;
  const auto t = waves_->folded(time).t;
  const auto half = Wide(0.5), place = Wide(1.0) / sqrt(Wide(3.0));
  for (std::size_t b = 0; b < p_.bars.size(); ++b) {
    const auto& [tau, c, z, out] = waves_->waves_[b];
    std::vector<Wide> fronts{0.0, tau};
    for (const auto& piece : out)
      for (const auto& late : {t - piece.t, piece.t + Wide(2.0) * tau - t})
        if (late.value > 0 && late.value < tau.value) fronts.push_back(late);
    std::ranges::sort(fronts, {}, &Wide::value);
    for (std::size_t i = 0; i + 1 < fronts.size(); ++i) {
      const auto length = half * (fronts[i + 1] - fronts[i]), weight = z * length;
      for (const auto& point : {-place, place}) {
        const auto late = fronts[i] + length * (Wide(1.0) + point);
        const auto o = waves_->outgoing(b, t - late, Side::right, 0),
                   a = waves_->arriving(b, t + late, Side::right, 0);
        const auto v = half * (o + a), s = half * (a - o) + Wide(p_.g) * late;
        kinetic = kinetic + half * weight * v * v;
        elastic = elastic + half * weight * s * s;
        potential = potential + Wide(p_.g) * weight * waves_->displacement(b, late * c, t);
      }
    }
  }
  return {narrowed(kinetic), narrowed(elastic), narrowed(potential)};
}

}  // namespace clackers::exact
