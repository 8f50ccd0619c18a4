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
constexpr double turning_modulus = 0.837452960268874;
constexpr double largest_turn_ratio = 0.40314018970565;
constexpr double most_swings = 1e9;

double over_quarter_period(const Modulus<Bounded>& modulus) {
  return (modulus.k / quarter_period(modulus)).nearest();
}

double first_ratio(const TwoPendulaParameters& p) {
  return p.m1 / p.m2 * over_quarter_period(Swing<Bounded>::of_angle(p.l1, 1.0, p.theta1).modulus);
}

}  // namespace

double second_modulus(const TwoPendulaParameters& p) {
  const double ratio = first_ratio(p);
  double low = 0.0, high = turning_modulus;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (over_quarter_period(Modulus<Bounded>::of(middle)) < ratio ? low : high) = middle;
  }
  return low;
}

TwoPendula::TwoPendula(const TwoPendulaParameters& p, std::string_view who)
    : FlightsBy({p, second_modulus(p)}, p) {
  const auto& k2 = swing(1).modulus.k;
  if (!(k2.error < 1e-12L * k2.value))
    refuse(
        who, "m1/m2", p.m1 / p.m2,
        fmt::format("(m1/m2) k1/K(k1) < {}, which is {} here", largest_turn_ratio, first_ratio(p)),
        "No swing of pendulum 2 has the momentum of pendulum 1 and meets it in time.",
        "not-admissible");
  state_problem({p.m1, p.m2}, p.g, p.end, who);
}

TwoPendula::TwoPendula(const PendulumCradleParameters& p, std::string_view who)
    : FlightsBy(TwoPendulaFormulas<Bounded>(p), p) {
  const auto& [l, w, modulus] = swing(0);
  const double height = (l * modulus.k * modulus.k).nearest();
  if (!(height < (1.0 - 1e-9) * p.l2))
    refuse(who, "l2", p.l2, fmt::format("l2 > l1 sin^2(theta1/2) = {}", height),
           "Pendulum 2 would go over the top.", "not-admissible");
  state_problem({1.0, 1.0}, p.g, p.end, who);
}

void TwoPendula::state_problem(const Eigen::Vector2d& masses, double g, double end,
                               std::string_view who) {
  const double most = most_swings * formulas_.T1.nearest();
  if (!(end < most))
    refuse(who, "t_end", end, fmt::format("t_end < {}", most),
           "So many swings are not known to the digits of a double.");
  problem_.system.mass = masses.asDiagonal();
  problem_.system.damping = problem_.system.stiffness = Eigen::Matrix2d::Zero();
  std::vector<model::NonlinearSprings::Row> weights;
  for (int i = 0; i < 2; ++i) {
    const auto& l = swing(i).l;
    weights.push_back({Eigen::Vector2d::Unit(i), model::NonlinearSprings::Law::sine,
                       (Bounded(masses[i]) * Bounded(g) / l).nearest(), l.nearest()});
  }
  problem_.system.nonlinear = std::make_shared<model::NonlinearSprings>(std::move(weights));
  problem_.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 1.0}};
  problem_.start = {0.0,
                    Eigen::Vector2d(swing(0).arc().nearest(),
                                    formulas_.together ? -swing(1).arc().nearest() : 0.0),
                    Eigen::Vector2d::Zero()};
  problem_.end = end;
}

long long TwoPendula::near_flight(double t) const {
  const auto T1 = formulas_.T1.value, cycle = T1 + formulas_.T2.value,
             since = static_cast<long double>(t) + 0.5L * T1;
  const auto cycles = std::floor(since / cycle);
  if (formulas_.together) return static_cast<long long>(cycles);
  return 2 * static_cast<long long>(cycles) + (since - cycles * cycle >= T1 ? 1 : 0);
}

model::Kinematics TwoPendula::envelope(double) const {
  model::Kinematics size{Eigen::VectorXd(2), Eigen::VectorXd(2), Eigen::VectorXd(2)};
  for (int i = 0; i < 2; ++i) {
    const auto& [l, w, modulus] = swing(i);
    const double g = (l * w * w).nearest();
    size.u[i] = swing(i).arc().nearest();
    size.v[i] = swing(i).speed().nearest();
    // Beyond a quarter turn the weight is largest on the way.
    size.a[i] =
        2.0 * modulus.k.value * modulus.k.value > 1.0L ? g : g * std::sin(size.u[i] / l.nearest());
  }
  return size;
}

}  // namespace clackers::exact
