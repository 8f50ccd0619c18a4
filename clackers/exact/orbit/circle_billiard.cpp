#include "clackers/exact/orbit/circle_billiard.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::exact {

using Eigen::Vector2d;
using numerics::narrowed, numerics::Wide;

namespace {

const CircleBilliardParameters& checked(const CircleBilliardParameters& p, std::string_view who) {
  const Wide x = p.x0, y = p.y0, R = p.R;
  if (const double r = std::hypot(p.x0, p.y0); !((x * x + y * y - R * R).value < 0))
    refuse(who, "R", p.R, fmt::format("R > sqrt(x0^2 + y0^2) = {}", r),
           "The point starts inside the circle.");
  if (p.vx == 0.0 && p.vy == 0.0)
    refuse(who, "vx", p.vx, "a velocity other than 0", "The point would stay where it is.");
  return p;
}

}  // namespace

CircleBilliard::CircleBilliard(const CircleBilliardParameters& p, std::string_view who)
    : WideFlights(p, CircleFormulas<Wide>(checked(p, who))), R_(p.R) {
  constexpr double most_impacts = 1e9;
  const double most = most_impacts * narrowed(Wide(2.0) * formulas_.half).nearest();
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

double CircleBilliard::distance() const {
  return narrowed(formulas_.L / sqrt(formulas_.square)).nearest();
}
double CircleBilliard::chord() const {
  return narrowed(Wide(2.0) * formulas_.S / sqrt(formulas_.square)).nearest();
}

long long CircleBilliard::near_flight(double t) const {
  const auto chords = (Wide(t) - formulas_.begins + formulas_.half) / (Wide(2.0) * formulas_.half);
  return static_cast<long long>(narrowed(chords).value);
}

model::Kinematics CircleBilliard::envelope(double t) const {
  model::require_inside("motion", t, end());
  const double v = narrowed(sqrt(formulas_.square)).nearest();
  return {Vector2d(R_, R_), Vector2d(v, v), Vector2d(v * v / R_, v * v / R_)};
}

}  // namespace clackers::exact
