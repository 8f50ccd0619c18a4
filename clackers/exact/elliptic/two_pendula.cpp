#include "clackers/exact/elliptic/two_pendula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/model/nonlinear_springs.hpp"

namespace clackers::exact {

using numerics::Bounded;

namespace {

// Where k/K(k) is largest, and what it is there.
constexpr long double turning_modulus = 0.837452960268874L;
constexpr double largest_ratio = 0.40314018970565;
constexpr double most_impacts = 1e9;

Bounded over_quarter_period(const Bounded& k) {
  return k / quarter_period(Swing::of_speed(0.5, 1.0, k).modulus);
}

// The modulus below the turning one with k/K(k) = ratio, which grows with k there; its error is certified by the signs
// of the difference on both sides.
Bounded modulus_of_ratio(const Bounded& ratio, std::string_view who, double mass_ratio) {
  long double low = 0.0L, high = turning_modulus;
  for (int i = 0; i < 80; ++i) {
    const auto middle = 0.5L * (low + high);
    (over_quarter_period({middle, 0.0L}).value < ratio.value ? low : high) = middle;
  }
  const auto beyond = [&](long double k, double sign) {
    const auto rest = Bounded(sign) * (over_quarter_period({k, 0.0L}) - ratio);
    return rest.value > rest.error;
  };
  for (long double reach = 1e-19L * low; reach < 1e-12L * low; reach *= 2.0L)
    if (beyond(low + reach, 1.0) && beyond(low - reach, -1.0)) return {low, reach};
  refuse(who, "m1/m2", mass_ratio,
         fmt::format("(m1/m2) k1/K(k1) < {}, which is {} here", largest_ratio, ratio.nearest()),
         "No swing of pendulum 2 has the momentum of pendulum 1 and meets it in time.",
         "not-admissible");
}

}  // namespace

TwoPendula TwoPendula::synchronized(const Parameters& p, std::string_view who) {
  const Bounded l1 = p.l1;
  const auto first = Swing::of_angle(l1, sqrt(Bounded(p.g) / l1), p.theta1);
  const auto K1 = quarter_period(first.modulus);
  const auto k2 =
      modulus_of_ratio(Bounded(p.m1) / Bounded(p.m2) * first.modulus.k / K1, who, p.m1 / p.m2);
  auto second = Swing::of_speed(0.5, 1.0, k2);
  const auto stretch = quarter_period(second.modulus) / K1;
  second.w = first.w * stretch;
  second.l = l1 / (stretch * stretch);
  return {p, first, second, true, who};
}

TwoPendula TwoPendula::alternating(const Parameters& p, double l2, std::string_view who) {
  const Bounded l1 = p.l1, g = p.g;
  const auto first = Swing::of_angle(l1, sqrt(g / l1), p.theta1);
  const auto w2 = sqrt(g / Bounded(l2));
  const double height = (l1 * first.modulus.k * first.modulus.k).nearest();
  if (!(height < (1.0 - 1e-9) * l2))
    refuse(who, "l2", l2, fmt::format("l2 > l1 sin^2(theta1/2) = {}", height),
           "Pendulum 2 would go over the top.", "not-admissible");
  return {p, first, Swing::of_speed(l2, w2, first.speed()), false, who};
}

TwoPendula::TwoPendula(const Parameters& p, const Swing& first, const Swing& second, bool together,
                       std::string_view who)
    : together_(together), swings_{first, second}, T1_(first.duration()) {
  if (!together) T2_ = second.duration();
  if (!(p.end < most_impacts * T1_.nearest()))
    refuse(who, "t_end", p.end, fmt::format("t_end < {}", most_impacts * T1_.nearest()),
           "So many swings are not known to the digits of a double.");
  problem_.system.mass = Eigen::Vector2d(p.m1, p.m2).asDiagonal();
  problem_.system.damping = problem_.system.stiffness = Eigen::Matrix2d::Zero();
  std::vector<model::NonlinearSprings::Row> weights;
  for (int i = 0; i < 2; ++i) {
    const auto& l = swings_[std::size_t(i)].l;
    weights.push_back({Eigen::Vector2d::Unit(i), model::NonlinearSprings::Law::sine,
                       (Bounded(problem_.system.mass(i, i)) * Bounded(p.g) / l).nearest(),
                       l.nearest()});
  }
  problem_.system.nonlinear = std::make_shared<model::NonlinearSprings>(std::move(weights));
  problem_.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 1.0}};
  problem_.start = {
      0.0, Eigen::Vector2d(first.arc().nearest(), together ? -second.arc().nearest() : 0.0),
      Eigen::Vector2d::Zero()};
  problem_.end = p.end;
}

Bounded TwoPendula::instant(long long k) const {
  const auto half = Bounded(0.5) * T1_;
  if (together_) return Bounded(double(k)) * T1_ - half;
  return Bounded(double((k + 1) / 2)) * T1_ + Bounded(double(k / 2)) * T2_ - half;
}

long long TwoPendula::near_flight(double t) const {
  const auto cycle = T1_.value + T2_.value, since = static_cast<long double>(t) + 0.5L * T1_.value;
  const auto cycles = std::floor(since / cycle);
  if (together_) return static_cast<long long>(cycles);
  return 2 * static_cast<long long>(cycles) + (since - cycles * cycle >= T1_.value ? 1 : 0);
}

auto TwoPendula::state(long long k, const Bounded& s) const -> States {
  States now{};
  if (together_ || k % 2 == 0) now[0] = swings_[0].at(s);
  if (together_ || k % 2 == 1) {
    const auto [u, v, a] = swings_[1].at(s);
    now[1] = {-u, -v, -a};
  }
  return now;
}

auto TwoPendula::limits(long long k) const -> Limits {
  const auto v1 = swings_[0].speed(), v2 = swings_[1].speed();
  Limits limit{};
  limit.impulse = Bounded(problem_.system.mass(0, 0)) * (together_ ? Bounded(2.0) * v1 : v1);
  if (together_) {
    limit.before[0].v = -v1, limit.after[0].v = v1;
    limit.before[1].v = v2, limit.after[1].v = -v2;
  } else if (k % 2 == 1) {
    limit.before[0].v = limit.after[1].v = -v1;
  } else {
    limit.before[1].v = limit.after[0].v = v1;
  }
  return limit;
}

model::Kinematics TwoPendula::envelope(double) const {
  model::Kinematics size{Eigen::VectorXd(2), Eigen::VectorXd(2), Eigen::VectorXd(2)};
  for (Eigen::Index i = 0; i < 2; ++i) {
    const auto& swing = swings_[std::size_t(i)];
    const double g = (swing.l * swing.w * swing.w).nearest();
    size.u[i] = swing.arc().nearest();
    size.v[i] = swing.speed().nearest();
    // Beyond a quarter turn the weight is largest on the way.
    size.a[i] = 2.0 * swing.modulus.k.value * swing.modulus.k.value > 1.0L
                    ? g
                    : g * std::sin(size.u[i] / swing.l.nearest());
  }
  return size;
}

}  // namespace clackers::exact
