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

Cradle::Cradle(const CradleParameters& p, std::string_view who)
    : FlightsBy(CradleFormulas<Bounded>(p), p) {
  const auto require = [&](const char* omega_name, double omega, const char* xi_name, double xi) {
    require_scale(who, omega_name, omega, 1e-30, 1e30);
    if (!(xi >= 0.0 && xi < 1.0))
      refuse(who, xi_name, xi, "0 <= xi < 1",
             xi >= 1.0 ? "At 1 and beyond the mass does not come back to the contact."
                       : "A negative damping ratio would feed energy in.");
  };
  require("omega1", p.omega1, "xi1", p.xi1);
  require("omega2", p.omega2, "xi2", p.xi2);
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

long long Cradle::near_flight(double t) const {
  const auto cycle = formulas_.masses[0].half_period.value + formulas_.masses[1].half_period.value;
  const long double since =
      static_cast<long double>(t) + 0.5L * formulas_.masses[0].half_period.value;
  const auto cycles = std::floor(since / cycle);
  return 2 * static_cast<long long>(cycles) +
         (since - cycles * cycle >= formulas_.masses[0].half_period.value ? 1 : 0);
}

model::Kinematics Cradle::envelope(double t) const {
  const auto k = flight_at(t, model::Side::left);
  const auto s = Bounded(t) - instant(k);
  const double v =
      (formulas_.speed(k) * exp(-(formulas_.masses[std::size_t(k % 2)].sigma * s))).nearest();
  model::Kinematics size{Eigen::VectorXd(2), Eigen::VectorXd(2), Eigen::VectorXd(2)};
  for (Eigen::Index j = 0; j < 2; ++j) {
    const auto& mass = formulas_.masses[std::size_t(j)];
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
    const double w = formulas_.masses[mass].w.nearest(),
                 sigma = formulas_.masses[mass].sigma.nearest();
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
  const double decay = (formulas_.masses[0].decay + formulas_.masses[1].decay).nearest();
  return std::sqrt(std::max(1.0, largest * std::exp(decay)));
}

}  // namespace clackers::exact
