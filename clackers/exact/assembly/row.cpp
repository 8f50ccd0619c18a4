#include "clackers/exact/assembly/assemblies.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/assembly/modal_shape.hpp"
#include "clackers/exact/assembly/shaped_parameters.hpp"
#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/pair/high_precision.hpp"

namespace clackers::exact {
namespace {

constexpr double most_masses = 1e9;

void require_admissible(std::string_view who, const RowParameters& p) {
  require_positive(who, "speed", p.speed);
  if (p.fast == 0.0 || p.speed < row_limit(p)) return;
  refuse(who, "speed", p.speed, fmt::format("0 < speed < {:.10g}", row_limit(p)),
         fmt::format("The value is {:.10g} times the limit: the fast mass, number {} of {}, would "
                     "touch a slow neighbour away from equilibrium. Take a lower speed.",
                     p.speed / row_limit(p), p.fast, p.masses),
         "not-admissible");
}

}  // namespace

std::vector<RowMass> row_masses(const RowParameters& p) {
  const auto n = static_cast<int>(p.masses), fast = static_cast<int>(p.fast);
  // Masses 1 to `up` move up. Without a fast mass the two in the middle have 1 m/s.
  const int up = fast == 0 ? (n + 1) / 2 : fast == n ? n - 1 : fast;
  std::vector<RowMass> row(static_cast<std::size_t>(n));
  double momentum_up = 0.0, momentum_down = 0.0;
  for (int i = 1; i <= n; ++i) {
    auto& [mass, multiple, velocity] = row[static_cast<std::size_t>(i - 1)];
    if (i == fast) {
      multiple = p.X;
      velocity = i == n ? -p.speed : p.speed;
    } else {
      velocity = fast == 0 ? (i <= up ? up + 1 - i : up - i) : fast - i;
    }
    (i <= up ? momentum_up : momentum_down) += velocity;
  }
  for (int i = 1; i <= n; ++i)
    row[static_cast<std::size_t>(i - 1)].mass =
        i <= up ? p.m1 : p.m1 * momentum_up / -momentum_down;
  return row;
}

double row_limit(const RowParameters& p) {
  return p.fast == 1.0 || p.fast == p.masses ? r_star(p.X) : 1.0;
}

std::unique_ptr<const ShapedMotion> make_row(const RowParameters& p, std::string_view who) {
  require_whole(who, "masses", p.masses, 2.0, most_masses);
  require_problem_fits(who, "masses", p.masses, p.masses, p.masses - 1.0);
  require_whole(who, "fast", p.fast, 0.0, p.masses, "It is the number of a mass, or 0 for none.");
  require_odd(who, p.X, "At most one mass is faster, and none slower.");
  require_scale(who, "m1", p.m1);
  auto flight = derive_flight(who, p.Omega, p.sigma, p.eta, p.t_end);
  require_admissible(who, p);

  const auto row = row_masses(p);
  const auto n = row.size();
  ModalColumn slow{ModalColumn::Function::cosine, 1.0, std::vector<double>(n)};
  ModalColumn fast{ModalColumn::Function::cosine, p.X, std::vector<double>(p.fast == 0.0 ? 0 : n)};
  ImpactPattern pattern;
  pattern.contacts.emplace_back();
  double momentum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& [mass, multiple, velocity] = row[i];
    // p' = velocity at theta = -pi/2.
    const double amplitude = quarter_sine(multiple) * velocity / (multiple * p.Omega);
    (double(i + 1) == p.fast ? fast : slow).amplitude[i] = amplitude;
    momentum += mass * velocity;
    if (i + 1 < n)
      pattern.contacts.front().push_back({static_cast<int>(i), (1.0 + p.eta) * momentum});
    pattern.energy += 0.5 * mass * velocity * velocity;
  }
  std::vector<ModalColumn> columns{std::move(slow)};
  if (p.fast != 0.0) columns.push_back(std::move(fast));
  auto shape = std::make_unique<ModalShape>(std::move(columns),
                                            numerics::DoubleDouble{p.Omega, 0.0}, p.sigma);
  return std::make_unique<const ShapedMotion>(p, std::move(flight), std::move(shape),
                                              std::move(pattern), who);
}

model::ImpactProblem<> row_problem(const RowParameters& p, const model::Motion& motion) {
  const auto row = row_masses(p);
  const auto n = static_cast<Eigen::Index>(row.size());
  model::ImpactProblem<> problem;
  auto& system = problem.system;
  system.mass = system.damping = system.stiffness = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& [mass, multiple, velocity] = row[static_cast<std::size_t>(i)];
    const double own = multiple * p.Omega;
    system.mass(i, i) = mass;
    system.damping(i, i) = 2.0 * p.sigma * mass;
    system.stiffness(i, i) = mass * (own * own + p.sigma * p.sigma);
    if (i + 1 < n) problem.contacts.push_back(model::contact_between(n, i, i + 1, p.eta));
  }
  const auto start = motion.at(0.0, model::Side::right);
  problem.start = {0.0, start.u, start.v};
  problem.end = p.t_end;
  return problem;
}

}  // namespace clackers::exact
