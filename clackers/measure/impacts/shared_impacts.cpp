#include "clackers/measure/impacts/shared_impacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::measure {
namespace {

// Whether an impulse at one of these contacts changes the gap rate of another.
bool share_masses(std::span<const int> contacts, const model::ImpactProblem<>& problem,
                  const numerics::Cholesky& mass) {
  Eigen::MatrixXd rows(problem.dof(), Eigen::Index(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    rows.col(Eigen::Index(i)) = problem.contacts[std::size_t(contacts[i])].direction;
  Eigen::MatrixXd coupling = rows.transpose() * mass.solve(rows);
  const Eigen::VectorXd size = coupling.diagonal().cwiseSqrt();
  coupling.diagonal().setZero();
  // Orthogonal rows leave n products' rounding; any real coupling is far larger.
  const double rounding = 16.0 * double(rows.rows()) * std::numeric_limits<double>::epsilon();
  return ((coupling.array().abs() / (size * size.transpose()).array()) > rounding).any();
}

}  // namespace

std::optional<SharedInstant> first_shared_instant(const model::Motion& reference,
                                                  const model::ImpactProblem<>& problem) {
  constexpr long long most_impacts = 1000;
  if (problem.contacts.size() < 2) return {};
  const auto count = std::min(reference.impact_count(reference.end()), most_impacts);
  std::optional<numerics::Cholesky> mass;
  std::vector<int> contacts;
  double first = 0.0, hi = -std::numeric_limits<double>::infinity();
  const auto found = [&]() -> bool {
    if (contacts.size() < 2) return false;
    if (!mass) mass.emplace(problem.system.mass);
    return share_masses(contacts, problem, *mass);
  };
  for (long long k = 1; k <= count; ++k) {
    const auto impact = reference.impact(k);
    if (impact.when.lo > hi) {
      if (found()) break;
      contacts.clear();
      first = impact.t;
    }
    contacts.push_back(impact.contact);
    hi = std::max(hi, impact.when.hi);
  }
  if (!found()) return {};
  return SharedInstant{first, int(contacts.size())};
}

std::optional<SharedImpacts> at_shared_instant(const SharedInstant& instant, double start,
                                               std::span<const double> times,
                                               std::span<const std::vector<double>> errors) {
  if (times.size() < 2) return {};
  SharedImpacts found{.instant = instant};
  // Of an interval only the middle is known; the shortest distance is its length.
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < times.size(); ++i) width = std::min(width, times[i] - times[i - 1]);
  const double until = instant.t + (instant.t - start);
  bool is_before_known = false, is_after_known = false;
  for (std::size_t i = 0; i < times.size(); ++i) {
    double error = 0.0;
    for (const auto& of_mass : errors) error = std::max(error, of_mass[i]);
    if (times[i] < instant.t - width) {
      found.error_before = std::max(found.error_before, error);
      is_before_known = true;
    } else if (times[i] > instant.t + width && times[i] < until) {
      found.error_after = std::max(found.error_after, error);
      is_after_known = true;
    }
  }
  if (!is_before_known || !is_after_known) return {};
  return found;
}

bool comes_from_shared_impacts(const SharedImpacts& found) {
  constexpr double smallest = 0.1, factor = 30.0;
  return found.error_after >= smallest && found.error_after >= factor * found.error_before;
}

}  // namespace clackers::measure
