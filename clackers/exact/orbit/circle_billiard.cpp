#include "clackers/exact/orbit/circle_billiard.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::exact {

using Eigen::Vector2d;
using numerics::Bounded, numerics::narrowed, numerics::Wide;

namespace {

struct Direction {
  Wide x, y;
  friend Direction operator*(const Direction& a, const Direction& b) {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
  }
};

}  // namespace

CircleBilliard::CircleBilliard(const CircleBilliardParameters& p, std::string_view who) : p_(p) {
  const Wide x = p.x0, y = p.y0, vx = p.vx, vy = p.vy, R = p.R;
  if (const double r = std::hypot(p.x0, p.y0); !((x * x + y * y - R * R).value < 0))
    refuse(who, "R", p.R, fmt::format("R > sqrt(x0^2 + y0^2) = {}", r),
           "The point starts inside the circle.");
  if (p.vx == 0.0 && p.vy == 0.0)
    refuse(who, "vx", p.vx, "a velocity other than 0", "The point would stay where it is.");
  v_ = sqrt(vx * vx + vy * vy);
  b_ = (x * vx + y * vy) / v_;
  d_ = (x * vy - y * vx) / v_;
  l_ = sqrt((R - d_) * (R + d_));
  constexpr double most_impacts = 1e9;
  const double most = most_impacts * narrowed(Wide(2.0) * l_ / v_).nearest();
  if (!(p.end < most))
    refuse(who, "t_end", p.end, fmt::format("t_end < {}", most),
           "So many impacts are not known to the digits of a double.");
  problem_.system.mass = Eigen::Matrix2d::Identity();
  problem_.system.damping = problem_.system.stiffness = Eigen::Matrix2d::Zero();
  problem_.start = {0.0, Vector2d(p.x0, p.y0), Vector2d(p.vx, p.vy)};
  problem_.end = p.end;
  problem_.unstated = fmt::format(
      "the wall (u1^2 + u2^2 <= R^2 with R = {} m; at an impact the velocity along the radius is reversed)",
      p.R);
}

Bounded CircleBilliard::instant(long long k) const {
  return narrowed((Wide(2.0 * double(k) - 1.0) * l_ - b_) / v_);
}
long long CircleBilliard::near_flight(double t) const {
  const auto chords = (b_ + v_ * Wide(t) + l_) / (Wide(2.0) * l_);
  return static_cast<long long>(narrowed(chords).value);
}

auto CircleBilliard::on_chord(long long k, const Bounded& sigma) const -> States {
  const Wide R = p_.R;
  const Direction turn{d_ / R, l_ / R};
  Direction now{Wide(p_.vx) / v_, Wide(p_.vy) / v_};
  auto square = turn * turn;
  for (; k > 0; k /= 2, square = square * square)
    if (k % 2 == 1) now = now * square;
  const auto x = narrowed(now.x), y = narrowed(now.y), d = narrowed(d_), v = narrowed(v_);
  return {{{sigma * x + d * y, v * x, 0.0}, {sigma * y - d * x, v * y, 0.0}}};
}

auto CircleBilliard::state(long long k, const Bounded& s) const -> States {
  return on_chord(k, narrowed(v_) * s - narrowed(l_));
}

auto CircleBilliard::limits(long long k) const -> Limits {
  const auto l = narrowed(l_);
  return {on_chord(k - 1, l), on_chord(k, -l), narrowed(Wide(2.0) * v_ * l_ / Wide(p_.R))};
}

model::Kinematics CircleBilliard::envelope(double t) const {
  model::require_inside("motion", t, end());
  const double v = narrowed(v_).nearest();
  return {Vector2d(p_.R, p_.R), Vector2d(v, v), Vector2d(v * v / p_.R, v * v / p_.R)};
}

}  // namespace clackers::exact
