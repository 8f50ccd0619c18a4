#include "clackers/exact/friction/friction_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

using Eigen::VectorXd;
using model::Side;
using numerics::Bounded, numerics::WideReal;

namespace {

VectorXd number(double x) { return VectorXd::Constant(1, x); }

Bounded absolute(const Bounded& x) { return x.value < 0.0L ? -x : x; }
bool is_positive(const Bounded& x) { return x.value > x.error; }

constexpr long long most_flights = 4'000'000'000'000'000'000;
// About how many times T has passed at t.
long long flights_within(double t, const Bounded& T, long long most) {
  return static_cast<long long>(
      std::min(std::floor(Bounded(t).value / T.value), static_cast<long double>(most)));
}

}  // namespace

FrictionMotion::FrictionMotion(double m, double k, const model::Friction<>& friction, double end)
    : k_(k), omega_(sqrt(Bounded(k) / Bounded(m))) {
  problem_.system.mass = number(m);
  problem_.system.damping = number(0.0);
  problem_.system.stiffness = number(k);
  problem_.frictions = {friction};
  problem_.start = {0.0, number(0.0), number(0.0)};
  problem_.end = end;
}

model::Kinematics FrictionMotion::envelope(double t) const {
  model::require_inside("motion", t, end());
  return {number(size_[0]), number(size_[1]), number(size_[2])};
}

long long FrictionMotion::impact_count(double t) const {
  model::require_inside("motion", t, end());
  return 0;
}

auto FrictionMotion::limits(long long) const -> Limits { return {}; }

VectorXd FrictionMotion::contact_forces(double t, Side side) const {
  const auto now = at_time(t, side)[0];
  double load = 0.0;
  if (problem_.system.add_load) problem_.system.add_load(t, {&load, 1});
  return number(
      (Bounded(problem_.system.mass(0, 0)) * now.a + k_ * now.u - Bounded(load)).nearest());
}

// The number of half swings is that of 2 F in k x0 - F, whose products are exact in 256 bits.
Slider::Slider(const SliderParameters& p, std::string_view who)
    : FrictionMotion(p.m, p.k, {number(1.0), p.F, p.F}, p.end),
      x0_(p.x0),
      d_(Bounded(p.F) / k_),
      T_(Bounded::pi() / omega_) {
  const WideReal left = WideReal(p.k) * WideReal(p.x0) - WideReal(p.F), step = 2 * WideReal(p.F);
  if (!(left > 0))
    refuse(who, "x0", p.x0, fmt::format("x0 > F/k = {}", d_.nearest()),
           "The spring does not overcome friction, so that the mass never moves.",
           "not-admissible");
  if (!(left <= 1e9 * step))
    refuse(who, "F", p.F, "k (x0 - F/k)/(2 F) <= 1e9, the number of half swings", {},
           "out-of-range");
  const WideReal whole = floor(left / step);
  n_ = static_cast<long long>(whole) + (whole * step < left ? 1 : 0);
  problem_.start.u[0] = p.x0;
  const auto swing = (x0_ - d_) * omega_;
  size_ = {p.x0, swing.nearest(), (swing * omega_).nearest()};
}

Bounded Slider::rest() const {
  const auto u = x0_ - Bounded(2.0 * double(n_)) * d_;
  return n_ % 2 == 0 ? u : -u;
}

Bounded Slider::instant(long long k) const {
  return k > n_ ? Bounded(INFINITY) : Bounded(double(k)) * T_;
}
long long Slider::near_flight(double t) const { return flights_within(t, T_, n_); }

auto Slider::state(long long k, const Bounded& s) const -> States {
  if (k == n_) return {{{rest(), 0.0, 0.0}}};
  const Bounded sign = k % 2 == 0 ? 1.0 : -1.0, th = omega_ * s,
                A = sign * (x0_ - Bounded(2.0 * double(k) + 1.0) * d_), wave = A * cos(th);
  return {{{wave + sign * d_, -(A * omega_ * sin(th)), -(wave * omega_ * omega_)}}};
}

Belt::Belt(const BeltParameters& p, std::string_view who)
    : FrictionMotion(p.m, p.k, {number(1.0), p.limit, p.kinetic, p.V}, p.end),
      V_(p.V),
      D_((Bounded(p.limit) - Bounded(p.kinetic)) / k_),
      d_(Bounded(p.kinetic) / k_),
      stick_(Bounded(2.0) * D_ / V_) {
  if (!(p.limit > p.kinetic))
    refuse(who, "Fd", p.kinetic, fmt::format("Fd < Fs = {}", p.limit),
           "Without a difference the mass slides into rest, and no stick and slip repeats.",
           "not-admissible");
  // pi - atan(x) = pi/2 + atan(1/x), without cancellation for small V.
  const auto rest = atan(V_ / (omega_ * D_));
  T_ = stick_ + (Bounded::pi() + Bounded(2.0) * rest) / omega_;
  problem_.start.u[0] = (d_ - D_).nearest();
  problem_.start.v[0] = p.V;
  const auto radius = sqrt(D_ * D_ + V_ * V_ / (omega_ * omega_));
  size_ = {(d_ + radius).nearest(), (omega_ * radius).nearest(),
           (omega_ * omega_ * radius).nearest()};
}

Bounded Belt::instant(long long k) const {
  const auto start = Bounded(double(k / 2)) * T_;
  return k % 2 == 0 ? start : start + stick_;
}
long long Belt::near_flight(double t) const { return 2 * flights_within(t, T_, most_flights); }

auto Belt::state(long long k, const Bounded& s) const -> States {
  if (k % 2 == 0) return {{{d_ - D_ + V_ * s, V_, 0.0}}};
  const auto th = omega_ * s, c = cos(th), n = sin(th), wave = D_ * c + V_ / omega_ * n;
  return {{{d_ + wave, V_ * c - omega_ * D_ * n, -(omega_ * omega_ * wave)}}};
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
    : FrictionMotion(p.m, p.k, {number(1.0), p.F, p.F}, p.end),
      F_(p.F),
      P_(p.P),
      W_(p.W),
      T_(Bounded::pi() / W_) {
  const auto b = W_ / omega_, square = Bounded(1.0) - b * b;
  if (!is_positive(absolute(square)))
    refuse(who, "W", p.W, "W other than sqrt(k/m)", "At resonance the amplitude grows for ever.",
           "not-admissible");
  Vd_ = Bounded(1.0) / square;
  const auto quarter = Bounded::pi() / (Bounded(2.0) * b);
  tan_ = sin(quarter) / cos(quarter);
  const auto H = tan_ / b, peak = P_ * Vd_, left = peak * peak - F_ * F_ * H * H;
  if (!is_positive(left))
    refuse(who, "F", p.F, fmt::format("F < P |Vd/H| = {:.3g}", absolute(peak / H).nearest()),
           "Friction is too large for a motion that turns without a stop." + near_resonance(b),
           "not-admissible");
  x0_ = sqrt(left) / k_;
  cos_phi_ = k_ * x0_ / peak;
  sin_phi_ = -(F_ / P_) * H / Vd_;
  phi_ = double(std::atan2(sin_phi_.value, cos_phi_.value));
  if (!is_positive(absolute(P_ * cos_phi_ - k_ * x0_) - F_))
    refuse(who, "F", p.F,
           fmt::format("F < |P cos phi - k x0| = {}", absolute(P_ * cos_phi_ - k_ * x0_).nearest()),
           "The mass would stop at its turning points.", "not-admissible");
  require_sliding(who, p.F);
  problem_.system.add_load = model::HarmonicLoad({{0, p.P, p.W, phi_}});
  problem_.start.u[0] = x0_.nearest();
  const auto own = F_ * sqrt(Bounded(1.0) + tan_ * tan_), force = absolute(peak);
  size_ = {x0_.nearest(), ((force * W_ + own * omega_) / k_).nearest(),
           ((force * W_ * W_ + own * omega_ * omega_) / k_).nearest()};
}

Bounded ForcedSlider::instant(long long k) const { return Bounded(double(k)) * T_; }
long long ForcedSlider::near_flight(double t) const { return flights_within(t, T_, most_flights); }

auto ForcedSlider::state(long long k, const Bounded& s) const -> States {
  const auto c = cos(W_ * s), n = sin(W_ * s), co = cos(omega_ * s), si = sin(omega_ * s);
  const auto driven = P_ * Vd_ * (c * cos_phi_ - n * sin_phi_),
             late = P_ * Vd_ * (n * cos_phi_ + c * sin_phi_);
  const auto own = F_ * (co + tan_ * si), own_late = F_ * (si - tan_ * co);
  const auto scale = Bounded(k % 2 == 0 ? 1.0 : -1.0) / k_;
  return {{{scale * (F_ + driven - own), scale * (omega_ * own_late - W_ * late),
            scale * (omega_ * omega_ * own - W_ * W_ * driven)}}};
}

// u' < 0 within the first half period, by pieces: from their middles with the largest acceleration, at both
// ends, where u' = 0, by the acceleration with the largest rate of it.
void ForcedSlider::require_sliding(std::string_view who, double F) const {
  const long double own = (F_ * sqrt(Bounded(1.0) + tan_ * tan_)).value / k_.value,
                    driven = (absolute(P_ * Vd_)).value / k_.value, w = omega_.value, W = W_.value,
                    most_a = own * w * w + driven * W * W,
                    most_jerk = own * w * w * w + driven * W * W * W;
  const auto T = T_.value;
  const auto slides = [&](const auto& self, long double from, long double to, int depth) -> bool {
    const long double half = 0.5L * (to - from);
    if (state(0, {from + half, 0.0L})[0].v.value + most_a * half < 0.0L) return true;
    if (from == 0.0L && state(0, 0.0)[0].a.value + most_jerk * to < 0.0L) return true;
    if (to == T && state(0, T_)[0].a.value - most_jerk * (to - from) > 0.0L) return true;
    return depth < 24 && self(self, from, from + half, depth + 1) &&
           self(self, from + half, to, depth + 1);
  };
  if (!slides(slides, 0.0L, T, 0))
    refuse(who, "F", F, "a friction with which the mass slides from one turning point to the next",
           "It would stop on the way. Take a smaller F or a larger W.", "not-admissible");
}

}  // namespace clackers::exact
