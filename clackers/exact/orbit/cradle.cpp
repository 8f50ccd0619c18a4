#include "clackers/exact/orbit/cradle.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/pair/parameters.hpp"

namespace clackers::exact {

using numerics::Bounded;

namespace {

constexpr double largest_cradle_phase = 1e12;

}  // namespace

Cradle::Cradle(const CradleParameters& p, std::string_view who) {
  const auto mass = [&](const char* omega_name, double omega, const char* xi_name, double xi) {
    require_scale(who, omega_name, omega, 1e-30, 1e30);
    if (!(xi >= 0.0 && xi < 1.0))
      refuse(who, xi_name, xi, "0 <= xi < 1",
             xi >= 1.0 ? "At 1 and beyond the mass does not come back to the contact."
                       : "A negative damping ratio would feed energy in.");
    Mass made;
    made.omega = omega;
    made.sigma = Bounded(xi) * omega;
    made.w = Bounded(omega) * sqrt((Bounded(1.0) - xi) * (Bounded(1.0) + xi));
    made.half_period = Bounded::pi() / made.w;
    made.decay = made.sigma * made.half_period;
    return made;
  };
  masses_ = {mass("omega1", p.omega1, "xi1", p.xi1), mass("omega2", p.omega2, "xi2", p.xi2)};
  require_positive(who, "t_end", p.t_end);
  if (const double fastest = std::max(p.omega1, p.omega2); p.t_end * fastest > largest_cradle_phase)
    refuse(who, "t_end", p.t_end, "omega1 t_end <= 1e12 and omega2 t_end <= 1e12",
           "Beyond, phases are not known to the digits of a double.");

  problem_.system.mass = Eigen::Matrix2d::Identity();
  problem_.system.damping =
      Eigen::Vector2d(2.0 * p.xi1 * p.omega1, 2.0 * p.xi2 * p.omega2).asDiagonal();
  problem_.system.stiffness =
      Eigen::Vector2d(p.omega1 * p.omega1, p.omega2 * p.omega2).asDiagonal();
  problem_.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 1.0}};
  problem_.end = p.t_end;
  const auto start = at(0.0, model::Side::right);
  problem_.start = {0.0, start.u, start.v};
}

// Flights of mass 1 and mass 2 before flight k: (k + 1) / 2 and k / 2.
Bounded Cradle::instant(long long k) const {
  const auto first = static_cast<double>((k + 1) / 2), second = static_cast<double>(k / 2);
  return (Bounded(first) - 0.5) * masses_[0].half_period + Bounded(second) * masses_[1].half_period;
}

// u1(0) = 1 in the middle of flight 0.
Bounded Cradle::speed(long long k) const {
  const auto first = static_cast<double>((k + 1) / 2), second = static_cast<double>(k / 2);
  return masses_[0].w *
         exp(-((Bounded(first) - 0.5) * masses_[0].decay + Bounded(second) * masses_[1].decay));
}

long long Cradle::near_flight(double t) const {
  const auto cycle = masses_[0].half_period.value + masses_[1].half_period.value;
  const long double since = static_cast<long double>(t) + 0.5L * masses_[0].half_period.value;
  const auto cycles = std::floor(since / cycle);
  return 2 * static_cast<long long>(cycles) +
         (since - cycles * cycle >= masses_[0].half_period.value ? 1 : 0);
}

Flights::States Cradle::state(long long k, const Bounded& s) const {
  const auto moving = static_cast<std::size_t>(k % 2);
  const auto& mass = masses_[moving];
  const auto start = moving == 0 ? speed(k) : -speed(k);
  const auto decayed = start * exp(-(mass.sigma * s));
  const auto phase = mass.w * s;
  States states;
  auto& now = states[moving];
  now.u = decayed * sin(phase) / mass.w;
  now.v = decayed * cos(phase) - mass.sigma * now.u;
  now.a = -(Bounded(2.0) * mass.sigma * now.v + mass.omega * mass.omega * now.u);
  return states;
}

Flights::Limits Cradle::limits(long long k) const {
  const auto arriving = static_cast<std::size_t>((k - 1) % 2), leaving = 1 - arriving;
  const auto v = arriving == 0 ? -speed(k) : speed(k);
  Limits limit;
  const auto damped = [&](std::size_t mass) {
    return MassState{0.0, v, -(Bounded(2.0) * masses_[mass].sigma * v)};
  };
  limit.before[arriving] = damped(arriving);
  limit.after[leaving] = damped(leaving);
  limit.impulse = speed(k);
  return limit;
}

model::Kinematics Cradle::envelope(double t) const {
  const auto k = flight_at(t, model::Side::left);
  const auto s = Bounded(t) - instant(k);
  const double v = (speed(k) * exp(-(masses_[std::size_t(k % 2)].sigma * s))).nearest();
  model::Kinematics size{Eigen::VectorXd(2), Eigen::VectorXd(2), Eigen::VectorXd(2)};
  for (Eigen::Index j = 0; j < 2; ++j) {
    const auto& mass = masses_[std::size_t(j)];
    const double omega = mass.omega.nearest();
    size.u[j] = v / mass.w.nearest();
    size.v[j] = size.u[j] * omega;
    size.a[j] = size.v[j] * omega;
  }
  return size;
}

// Impacts exchange perturbations as they exchange velocities. In the moving role they decay as the
// motion does, by e^(-sigma1 T1 - sigma2 T2) over two impacts. In the resting role they vibrate with
// mass 2 for T1, then with mass 1 for T2, as in Meissner's equation, and may grow even undamped.
double Cradle::perturbation_growth() const {
  const auto flow = [&](std::size_t mass, double T) {
    const double w = masses_[mass].w.nearest(), sigma = masses_[mass].sigma.nearest();
    const double c = std::cos(w * T), n = std::sin(w * T) / w;
    const double square = w * w + sigma * sigma;
    Eigen::Matrix2d map;
    map << c + sigma * n, n, -square * n, c - sigma * n;
    return Eigen::Matrix2d(std::exp(-sigma * T) * map);
  };
  const Eigen::Matrix2d map = flow(0, flight_time(1)) * flow(1, flight_time(0));
  const double half = 0.5 * map.trace(), rest = half * half - map.determinant();
  const double largest =
      rest > 0.0 ? std::abs(half) + std::sqrt(rest) : std::sqrt(map.determinant());
  const double decay = (masses_[0].decay + masses_[1].decay).nearest();
  return std::sqrt(std::max(1.0, largest * std::exp(decay)));
}

}  // namespace clackers::exact
