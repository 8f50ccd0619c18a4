#include "clackers/exact/bodies/string_on_obstacle.hpp"

namespace clackers::exact {

using model::Side;
using numerics::Bounded, numerics::narrowed, numerics::Wide, numerics::WideReal;

namespace {

// s less whole periods, within [from, from + period).
Wide folded(const Wide& s, int period, int from) {
  const WideReal whole = floor((s.value - from) / period) * period;
  return s - Wide(whole, 0);
}

}  // namespace

StringOnObstacle::StringOnObstacle(const StringOnObstacleParameters& p)
    : p_(p),
      speed_(sqrt(Wide(p.T) / Wide(p.rho))),
      tau_(Wide(p.L) / speed_),
      impulse_(Wide(4.0) * Wide(p.T) * Wide(p.H) / speed_),
      place_(p.place),
      rest_(Wide(1.0) - place_),
      near_(min(place_, rest_)) {}

auto StringOnObstacle::time(double t, Side side) const -> Time {
  return {Wide(t) / tau_, side, WideReal(half_spacing(t)) / tau_.value};
}

bool StringOnObstacle::Time::is_past(const Wide& now, const Wide& instant) const {
  const auto since = now - instant;
  const WideReal shift = since.error + slack;
  return since.value + (side == Side::right ? shift : -shift) >= 0;
}

Wide StringOnObstacle::shape(const Wide& s) const {
  const auto now = folded(s, 2, -1), distance = abs(now);
  const auto height = min(distance / place_, (Wide(1.0) - distance) / rest_);
  return now.value < 0 ? -height : height;
}

Wide StringOnObstacle::slope(const Wide& s, const Time& limits) const {
  const auto now = folded(s, 2, -1);
  const bool rises = limits.is_past(now, -place_) && !limits.is_past(now, place_);
  return Wide(1.0) / (rises ? place_ : -rest_);
}

auto StringOnObstacle::at(std::size_t, double x, double t, Side side) const -> Point {
  const auto part = Wide(x) / Wide(p_.L);
  const auto now = time(t, side);
  // What comes from either side, f being odd.
  const auto ahead = now.s + part, behind = now.s - part;
  const auto touch = place_ + part * (rest_ - place_), s = folded(now.s, 2, 0);
  const bool is_below = now.is_past(s, touch) && !now.is_past(s, Wide(2.0) - touch);
  const auto half = Wide(is_below ? -0.5 : 0.5) * Wide(p_.H);
  const auto first = slope(ahead, now), second = slope(behind, now);
  auto u = abs(half * (shape(ahead) - shape(behind)));
  if (u.value <= u.error) u.value = 0;  // at the ends and on the obstacle
  const bool is_held = t == 0.0 && side == Side::left;
  return {narrowed(u), is_held ? Bounded(0.0) : narrowed(half * (first - second) / tau_),
          narrowed(half * (first + second) * Wide(p_.T) / Wide(p_.L))};
}

// Of every half period the touch lasts from near_ to 1 - near_, and hands on its impulse evenly.
Bounded StringOnObstacle::force(double t, Side side) const {
  const auto now = time(t, side);
  const auto s = folded(now.s, 1, 0), until = Wide(1.0) - near_;
  if (!now.is_past(s, near_) || now.is_past(s, until)) return 0.0;
  return narrowed(impulse_ / (tau_ * (until - near_)));
}

Bounded StringOnObstacle::impulse(double t, Side side) const {
  const auto now = time(t, side);
  const auto s = folded(now.s, 1, 0), since = s - near_, lasts = Wide(1.0) - Wide(2.0) * near_;
  const Wide before(now.s.value - s.value, 0);
  const Wide part = lasts.value > 0 ? min(positive_part(since / lasts), 1.0)
                                    : Wide(now.is_past(s, near_) ? 1.0 : 0.0);
  return narrowed(impulse_ * (before + part));
}

// Points between the two corners move, all with one speed.
auto StringOnObstacle::energy(double t) const -> Energy {
  const auto s = abs(folded(Wide(t) / tau_, 2, -1));
  const auto moves = Wide(2.0) * min(min(s, Wide(1.0) - s), near_);
  const auto product = place_ * rest_,
             all = Wide(0.5) * Wide(p_.T) * Wide(p_.H) * Wide(p_.H) / (Wide(p_.L) * product),
             kinetic = all * moves / (Wide(4.0) * product);
  return {narrowed(kinetic), narrowed(all - kinetic), 0.0};
}

}  // namespace clackers::exact
