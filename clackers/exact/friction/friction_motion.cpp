#include "clackers/exact/friction/friction_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

using Eigen::VectorXd;
using model::Side;
using numerics::Bounded, numerics::WideReal;

namespace {

VectorXd number(double x) { return VectorXd::Constant(1, x); }

constexpr long long most_flights = 4'000'000'000'000'000'000;
// About how many times T has passed at t.
long long flights_within(double t, const Bounded& T, long long most) {
  return static_cast<long long>(
      std::min(std::floor(Bounded(t).value / T.value), static_cast<long double>(most)));
}

}  // namespace

template <class Parameters>
FrictionMotion::FrictionMotion(const Parameters& p, const model::Friction<>& friction)
    : Flights(p) {
  problem_.system.mass = number(p.m);
  problem_.system.damping = number(0.0);
  problem_.system.stiffness = number(p.k);
  problem_.frictions = {friction};
  problem_.start = {0.0, number(0.0), number(0.0)};
  problem_.end = p.end;
}

model::Kinematics FrictionMotion::envelope(double t) const {
  model::require_inside("motion", t, end());
  return {number(size_[0]), number(size_[1]), number(size_[2])};
}

long long FrictionMotion::impact_count(double t) const {
  model::require_inside("motion", t, end());
  return 0;
}

VectorXd FrictionMotion::contact_forces(double t, Side side) const {
  const auto now = at_time(t, side)[0];
  double load = 0.0;
  if (problem_.system.add_load) problem_.system.add_load(t, {&load, 1});
  const auto& system = problem_.system;
  return number(
      (Bounded(system.mass(0, 0)) * now.a + Bounded(system.stiffness(0, 0)) * now.u - Bounded(load))
          .nearest());
}

namespace {

// By which the spring overcomes friction.
WideReal excess(const SliderParameters& p) {
  return WideReal(p.k) * WideReal(p.x0) - WideReal(p.F);
}

const SliderParameters& require_moving(const SliderParameters& p, std::string_view who) {
  const auto left = excess(p);
  if (!(left > 0))
    refuse(who, "x0", p.x0, fmt::format("x0 > F/k = {}", p.F / p.k),
           "The spring does not overcome friction, so that the mass never moves.",
           "not-admissible");
  if (!(left <= 2e9 * WideReal(p.F)))
    refuse(who, "F", p.F, "k (x0 - F/k)/(2 F) <= 1e9, the number of half swings", {},
           "out-of-range");
  return p;
}

}  // namespace

// Of 2 F in k x0 - F.
long long half_swings(const SliderParameters& p) {
  const WideReal left = excess(p), step = 2 * WideReal(p.F), whole = floor(left / step);
  return static_cast<long long>(whole) + (whole * step < left ? 1 : 0);
}

Slider::Slider(const SliderParameters& p, std::string_view who)
    : FlightsBy({require_moving(p, who), exact::half_swings(p)}, p,
                model::Friction<>{number(1.0), p.F, p.F}) {
  problem_.start.u[0] = p.x0;
  const auto swing = (formulas_.x0 - formulas_.d) * formulas_.omega;
  size_ = {p.x0, swing.nearest(), (swing * formulas_.omega).nearest()};
}

// F times the way, of n half swings 2 (x0 - (2 i + 1) F/k); just above F/k this is what is left of a difference.
double Slider::lost() const {
  const WideReal F = problem_.frictions[0].limit, k = problem_.system.stiffness(0, 0),
                 n = formulas_.n;
  return static_cast<double>(2 * n * F * (k * WideReal(problem_.start.u[0]) - n * F) / k);
}

long long Slider::near_flight(double t) const {
  return flights_within(t, formulas_.T, formulas_.n);
}

Belt::Belt(const BeltParameters& p, std::string_view who)
    : FlightsBy(BeltFormulas<Bounded>(p), p,
                model::Friction<>{number(1.0), p.limit, p.kinetic, p.V}) {
  if (!(p.limit > p.kinetic))
    refuse(who, "Fd", p.kinetic, fmt::format("Fd < Fs = {}", p.limit),
           "Without a difference the mass slides into rest, and no stick and slip repeats.",
           "not-admissible");
  const auto& [d, D, V, w] = std::tie(formulas_.d, formulas_.D, formulas_.V, formulas_.omega);
  problem_.start.u[0] = (d - D).nearest();
  problem_.start.v[0] = p.V;
  const auto radius = sqrt(D * D + V * V / (w * w));
  size_ = {(d + radius).nearest(), (w * radius).nearest(), (w * w * radius).nearest()};
}

long long Belt::near_flight(double t) const {
  return 2 * flights_within(t, formulas_.T, most_flights);
}

namespace {

// Friction of alternating sign has all odd harmonics of W; at b = W/sqrt(k/m) = 1/n one of them is resonant.
std::string near_resonance(const Bounded& b) {
  const auto n = 2.0 * std::floor(0.5 / b.nearest()) + 1.0;
  if (n < 3.0) return {};
  return fmt::format(
      " No friction is small enough at W = sqrt(k/m)/n with n odd, where harmonic n of the friction "
      "is in resonance; the nearest n is {:.0f}, and W sqrt(m/k) = {:.6g}. Take another W.",
      n, b.nearest());
}

}  // namespace

ForcedSlider::ForcedSlider(const ForcedSliderParameters& p, std::string_view who)
    : FlightsBy(ForcedSliderFormulas<Bounded>(p), p, model::Friction<>{number(1.0), p.F, p.F}) {
  const auto& f = formulas_;
  if (!abs(f.square).is_positive())
    refuse(who, "W", p.W, "W other than sqrt(k/m)", "At resonance the amplitude grows for ever.",
           "not-admissible");
  // |P cos phi - k x0| > F with x0 of the same F.
  const auto square = f.b * f.b,
             most = abs(square * f.peak) / sqrt(Bounded(1.0) + square * square * f.H * f.H);
  if (!(most - f.F).is_positive() || !f.left.is_positive())
    refuse(who, "F", p.F, fmt::format("F < {}", most.nearest()),
           "The mass would stop at its turning points." +
               (f.left.is_positive() ? std::string() : near_resonance(f.b)),
           "not-admissible");
  // Near resonance terms cancel.
  const ForcedSliderFormulas<numerics::Wide> wide(p);
  phi_ = static_cast<double>(atan2(wide.sin_phi.value, wide.cos_phi.value));
  require_sliding(who);
  problem_.system.add_load = model::HarmonicLoad({{0, p.P, p.W, phi_}});
  problem_.start.u[0] = wide.x0.nearest();
  const auto own = f.F * sqrt(Bounded(1.0) + f.tan * f.tan), force = abs(f.peak);
  size_ = {f.x0.nearest(), ((force * f.W + own * f.omega) / f.k).nearest(),
           ((force * f.W * f.W + own * f.omega * f.omega) / f.k).nearest()};
}

long long ForcedSlider::near_flight(double t) const {
  return flights_within(t, formulas_.T, most_flights);
}

// u' < 0 within the first half period, by pieces in turn: from their middles with the largest acceleration; by u'' < 0
// after u' <= 0 at their beginning, and by u'' > 0 before u' = 0 at the end, with the largest rate of it.
void ForcedSlider::require_sliding(std::string_view who) const {
  const auto& f = formulas_;
  const long double own = (f.F * sqrt(Bounded(1.0) + f.tan * f.tan)).value / f.k.value,
                    driven = abs(f.peak).value / f.k.value, w = f.omega.value, W = f.W.value,
                    most_a = own * w * w + driven * W * W,
                    most_jerk = own * w * w * w + driven * W * W * W;
  const auto T = f.T.value;
  const auto slides = [&](const auto& self, long double from, long double to, int depth) -> bool {
    const long double half = 0.5L * (to - from);
    if (state(0, {from + half, 0.0L})[0].v.value + most_a * half < 0.0L) return true;
    if (state(0, {from + half, 0.0L})[0].a.value + most_jerk * half < 0.0L) return true;
    if (to == T && state(0, f.T)[0].a.value - most_jerk * (to - from) > 0.0L) return true;
    return depth < 24 && self(self, from, from + half, depth + 1) &&
           self(self, from + half, to, depth + 1);
  };
  if (!slides(slides, 0.0L, T, 0))
    refuse(who, "F", f.F.nearest(),
           "a friction with which the mass slides from one turning point to the next",
           "It would stop on the way. Take a smaller F or a larger W.", "not-admissible");
}

}  // namespace clackers::exact
