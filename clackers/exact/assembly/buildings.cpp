#include "clackers/exact/assembly/assemblies.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/exact/assembly/building_shape.hpp"
#include "clackers/exact/assembly/shaped_parameters.hpp"
#include "clackers/exact/pair/high_precision.hpp"

namespace clackers::exact {
namespace {

using std::numbers::pi;

// The integral of cos^(2n-1) from 0 to an angle with this sine and cosine: J_1 = sin,
// m J_m = cos^(m-1) sin + (m-1) J_(m-2), sums of terms of one sign.
double integral(int n, double sine, double cosine) {
  double sum = sine, power = 1.0;
  const double square = cosine * cosine;
  for (int m = 3; m < 2 * n; m += 2) {
    power *= square;
    sum = (power * sine + double(m - 1) * sum) / double(m);
  }
  return sum;
}

// I_L(y/X) and -I_R(y), both rising for y in [pi, 3 pi/2], the first trough of I_R. Later ones are
// no deeper and I_L is larger there; beyond theta = pi/2 all repeats backwards.
struct Trough {
  int left, right;
  double X;
  double slow(double y) const { return integral(left, std::sin(y / X), std::cos(y / X)); }
  double fast(double y) const { return integral(right, std::sin(y - pi), std::cos(y - pi)); }
};

Building building(double storeys, double roof_mass, double frequency) {
  return {static_cast<int>(storeys), roof_mass, frequency};
}

void require_ranges(std::string_view who, const BuildingsParameters& p) {
  const auto storeys = [&](const char* name, double value) {
    require_whole(who, name, value, 1.0, most_storeys,
                  value > most_storeys
                      ? fmt::format("The three matrices of such a building take {:.3g} GB, and its "
                                    "amplitudes, binomial coefficients, leave double precision.",
                                    problem_bytes(value, 0.0) / 0x1p30)
                      : std::string());
  };
  storeys("left", p.left);
  storeys("right", p.right);
  require_odd(who, p.X, "Exchange the buildings: the right one is the faster.");
  require_scale(who, "r", p.r);
  require_scale(who, "m1", p.m1);
  require_scale(who, "V", p.V);
}

void require_admissible(std::string_view who, const BuildingsParameters& p) {
  const auto limit = buildings_limit(static_cast<int>(p.left), static_cast<int>(p.right), p.X);
  if (p.r < limit.proven) return;
  refuse(who, "r", p.r, fmt::format("0 < r < r* = {:.10g}", limit.r_star),
         fmt::format("The value is {:.10g} times the limit for {} and {} storeys and X = {}: the "
                     "roofs would touch away from equilibrium, at the latest {:.6g} s after an "
                     "impact. Take r below the limit, or X = 1, which takes every r.",
                     p.r / limit.r_star, p.left, p.right, p.X, limit.angle / p.Omega),
         "not-admissible");
}

}  // namespace

BuildingsLimit buildings_limit(int left, int right, double X) {
  if (X == 1.0) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    return {endless, endless, 0.5 * pi};
  }
  // Intervals on which X slow(begin) / fast(end), a bound from below, could still beat the least value
  // seen are halved.
  constexpr double decided = 1e-8;
  const Trough trough{left, right, X};
  struct Interval {
    double begin, end, slow, fast;  // values at begin, end
  };
  double least = X * trough.slow(1.5 * pi) / trough.fast(1.5 * pi), where = 1.5 * pi;
  std::vector<Interval> open{{pi, 1.5 * pi, trough.slow(pi), trough.fast(1.5 * pi)}};
  while (!open.empty()) {
    const auto [begin, end, slow, fast] = open.back();
    open.pop_back();
    if (X * slow / fast >= least * (1.0 - decided)) continue;
    const double middle = begin + 0.5 * (end - begin);
    const double slow_there = trough.slow(middle), fast_there = trough.fast(middle);
    if (X * slow_there / fast_there < least) {
      least = X * slow_there / fast_there;
      where = middle;
    }
    open.push_back({begin, middle, slow, fast_there});
    open.push_back({middle, end, slow_there, fast});
  }
  return {least, least * (1.0 - decided), where / X};
}

std::unique_ptr<const ShapedMotion> make_buildings(const BuildingsParameters& p,
                                                   std::string_view who) {
  require_ranges(who, p);
  auto flight = derive_flight(who, p.Omega, p.sigma, p.eta, p.t_end);
  flight.first_impact = 1.0;
  require_admissible(who, p);
  auto shape = std::make_unique<BuildingShape>(
      std::vector<BuildingShape::Part>{{static_cast<int>(p.left), 1.0, p.V},
                                       {static_cast<int>(p.right), p.X, -p.r * p.V}},
      p.Omega, p.sigma);
  const double momentum = p.m1 * p.V;
  ImpactPattern pattern{{{{0, (1.0 + p.eta) * momentum}}}, 0.5 * momentum * p.V * (1.0 + p.r)};
  return std::make_unique<const ShapedMotion>(p, std::move(flight), std::move(shape),
                                              std::move(pattern), who);
}

model::ImpactProblem<> buildings_problem(const BuildingsParameters& p,
                                         const model::Motion& motion) {
  const Eigen::Index n = motion.dof();
  model::ImpactProblem<> problem;
  auto& system = problem.system;
  system.mass = system.damping = system.stiffness = Eigen::MatrixXd::Zero(n, n);
  Eigen::Index at = 0;
  for (const auto& structure :
       {building(p.left, p.m1, p.Omega), building(p.right, p.m1 / p.r, p.Omega * p.X)}) {
    const auto masses = structure.masses(), springs = structure.stiffnesses();
    for (std::size_t i = 0; i < masses.size(); ++i, ++at) {
      const double above = i == 0 ? 0.0 : springs[i - 1];
      system.mass(at, at) = masses[i];
      system.damping(at, at) = 2.0 * p.sigma * masses[i];
      system.stiffness(at, at) = above + springs[i] + p.sigma * p.sigma * masses[i];
      if (i > 0) system.stiffness(at, at - 1) = system.stiffness(at - 1, at) = -above;
    }
  }
  problem.contacts = {model::contact_between(n, 0, static_cast<Eigen::Index>(p.left), p.eta)};
  const auto start = motion.at(0.0, model::Side::right);
  problem.start = {0.0, start.u, start.v};
  problem.end = p.t_end;
  return problem;
}

}  // namespace clackers::exact
