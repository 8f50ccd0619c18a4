#include "clackers/measure/impacts/shared_impacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::measure {
namespace {

constexpr long long most_impacts = 1000;

// Whether an impulse at one of some contacts changes the gap rate of another. The mass is factorized when it is needed.
class Coupling {
 public:
  explicit Coupling(const model::ImpactProblem<>& problem) : problem_(problem) {}

  bool share_masses(std::span<const int> contacts) {
    if (!mass_) mass_.emplace(problem_.system.mass);
    Eigen::MatrixXd rows(problem_.dof(), Eigen::Index(contacts.size()));
    for (std::size_t i = 0; i < contacts.size(); ++i)
      rows.col(Eigen::Index(i)) = problem_.contacts[std::size_t(contacts[i])].direction;
    Eigen::MatrixXd coupling = rows.transpose() * mass_->solve(rows);
    const Eigen::VectorXd size = coupling.diagonal().cwiseSqrt();
    coupling.diagonal().setZero();
    // Orthogonal rows leave n products' rounding; any real coupling is far larger.
    const double rounding = 16.0 * double(rows.rows()) * std::numeric_limits<double>::epsilon();
    return ((coupling.array().abs() / (size * size.transpose()).array()) > rounding).any();
  }

 private:
  const model::ImpactProblem<>& problem_;
  std::optional<numerics::Cholesky> mass_;
};

// What the error does at an instant, up to `until`.
std::optional<SharedImpacts> at_instant(const SharedInstant& instant, double until,
                                        std::span<const double> times,
                                        std::span<const std::vector<double>> errors) {
  SharedImpacts found{.instant = instant};
  // Of an interval only the middle is known; the shortest distance is its length.
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < times.size(); ++i) width = std::min(width, times[i] - times[i - 1]);
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

}  // namespace

std::vector<SharedInstant> shared_instants(const model::Motion& reference,
                                           const model::ImpactProblem<>& problem) {
  std::vector<SharedInstant> all;
  if (problem.contacts.size() < 2) return all;
  const auto count = std::min(reference.impact_count(reference.end()), most_impacts);
  Coupling coupling(problem);
  const auto closed = reference.closed_contacts();
  std::vector<int> contacts;
  double first = 0.0, hi = -std::numeric_limits<double>::infinity();
  const auto add = [&] {
    if (contacts.empty()) return;
    for (const auto& one : closed)
      if (one.from < first && first <= one.until && !std::ranges::count(contacts, one.contact))
        contacts.push_back(one.contact);
    if (contacts.size() > 1 && coupling.share_masses(contacts))
      all.push_back({first, int(contacts.size())});
  };
  for (long long k = 1; k <= count; ++k) {
    const auto impact = reference.impact(k);
    if (impact.when.lo > hi) {
      add();
      contacts.clear();
      first = impact.t;
    }
    contacts.push_back(impact.contact);
    hi = std::max(hi, impact.when.hi);
  }
  add();
  return all;
}

double closest_impacts(const model::Motion& reference, const model::ImpactProblem<>& problem) {
  if (problem.contacts.size() < 2) return 0.0;
  const auto count = std::min(reference.impact_count(reference.end()), most_impacts);
  std::vector<model::MotionImpact> impacts;
  double largest = 0.0;
  for (long long k = 1; k <= count; ++k) {
    impacts.push_back(reference.impact(k));
    largest = std::max(largest, impacts.back().impulse);
  }
  Coupling coupling(problem);
  double closest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < impacts.size(); ++k) {
    const auto &one = impacts[k - 1], &next = impacts[k];
    if (next.when.lo > one.when.hi && next.t - one.t < closest && one.contact != next.contact &&
        std::min(one.impulse, next.impulse) >= 0.1 * largest &&
        coupling.share_masses(std::array{one.contact, next.contact}))
      closest = next.t - one.t;
  }
  return std::isfinite(closest) ? closest : 0.0;
}

std::optional<SharedImpacts> at_shared_instants(std::span<const SharedInstant> instants,
                                                double start, std::span<const double> times,
                                                std::span<const std::vector<double>> errors) {
  if (times.size() < 2) return {};
  std::optional<SharedImpacts> first;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const double next =
        i + 1 < instants.size() ? instants[i + 1].t : std::numeric_limits<double>::infinity();
    const auto found =
        at_instant(instants[i], std::min(next, 2.0 * instants[i].t - start), times, errors);
    if (found && comes_from_shared_impacts(*found)) return found;
    if (i == 0) first = found;
  }
  return first;
}

bool comes_from_shared_impacts(const SharedImpacts& found) {
  constexpr double smallest = 0.1, factor = 30.0;
  return found.error_after >= smallest && found.error_after >= factor * found.error_before;
}

}  // namespace clackers::measure
