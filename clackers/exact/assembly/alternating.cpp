#include "clackers/exact/assembly/assemblies.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/assembly/modal_shape.hpp"
#include "clackers/exact/assembly/shaped_parameters.hpp"
#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/pair/high_precision.hpp"

namespace clackers::exact {
namespace {

void require_ranges(std::string_view who, const AlternatingParameters& p) {
  constexpr double most = largest_ratio / 2.0;
  require_whole(who, "rh", p.rh, 2.0, most);
  if (std::fmod(p.rh, 2.0) != 0.0)
    refuse(who, "rh", p.rh, fmt::format("an even whole number, 2 <= rh <= {}", most),
           "After an odd number of half-periods the middle mass returns to the same partner.");
  require_scale(who, "r", p.r);
  require_scale(who, "Omega", p.Omega, smallest_scale, 0.5 * largest_scale);
}

void require_admissible(std::string_view who, const AlternatingParameters& p) {
  const double limit = alternating_limit(p.rh);
  if (p.r < limit) return;
  refuse(
      who, "r", p.r, fmt::format("0 < r < r* = {:.10g}", limit),
      fmt::format("The value is {:.10g} times the limit: the displacements of the middle mass, "
                  "{:.6g} m beside 1 m of the outer ones, would reach a partner between impacts; "
                  "up to {:.6g} m they do not. Take a lower r.",
                  p.r / limit, p.r / (2.0 * p.rh), limit / (2.0 * p.rh)),
      "not-admissible");
}

}  // namespace

double alternating_limit(double rh) { return r_star(2.0 * rh); }

std::unique_ptr<const ShapedMotion> make_alternating(const AlternatingParameters& p,
                                                     std::string_view who) {
  require_ranges(who, p);
  auto flight = derive_flight(who, 2.0 * p.Omega, p.sigma, 1.0, p.t_end);
  require_admissible(who, p);
  // With x = Omega times the time since the upper mass was struck, the displacements are sin x,
  // -r/(2 rh) sin(2 rh x) and -cos x up to x = pi/2; then upper and lower mass exchange their roles.
  // x = theta/2 + pi/4 makes sines and cosines of theta/2 and rh theta of them.
  using enum ModalColumn::Function;
  const double half = std::numbers::sqrt2 / 2.0;
  const double sign = std::fmod(p.rh, 4.0) == 0.0 ? -1.0 : 1.0;
  std::vector<ModalColumn> columns{{cosine, 0.5, {half, 0.0, -half}},
                                   {sine, 0.5, {half, 0.0, half}},
                                   {sine, p.rh, {0.0, sign * p.r / (2.0 * p.rh), 0.0}}};
  auto shape = std::make_unique<ModalShape>(std::move(columns),
                                            numerics::DoubleDouble{2.0 * p.Omega, 0.0}, p.sigma);
  const double speed = p.Omega;  // of an outer mass at an impact
  ImpactPattern pattern{{{{1, 2.0 * speed}}, {{0, 2.0 * speed}}},
                        0.5 * ((2.0 + p.r) * speed * speed + 2.0 * p.sigma * p.sigma)};
  return std::make_unique<const ShapedMotion>(p, std::move(flight), std::move(shape),
                                              std::move(pattern), who);
}

model::ImpactProblem<> alternating_problem(const AlternatingParameters& p,
                                           const model::Motion& motion) {
  model::ImpactProblem<> problem;
  const double middle = 2.0 * p.rh * p.Omega, outer = p.Omega, square = p.sigma * p.sigma;
  const Eigen::Vector3d masses(1.0, 1.0 / p.r, 1.0);
  const Eigen::Vector3d ratios(outer * outer + square, middle * middle + square,
                               outer * outer + square);
  problem.system.mass = masses.asDiagonal();
  problem.system.damping = (2.0 * p.sigma * masses).asDiagonal();
  problem.system.stiffness = masses.cwiseProduct(ratios).asDiagonal();
  problem.contacts = {model::contact_between(3, 0, 1), model::contact_between(3, 1, 2)};
  const auto start = motion.at(0.0, model::Side::right);
  problem.start = {0.0, start.u, start.v};
  problem.end = p.t_end;
  return problem;
}

}  // namespace clackers::exact
