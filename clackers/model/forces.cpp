#include "clackers/model/forces.hpp"

#include <algorithm>
#include <iterator>

#include "clackers/model/harmonic_load.hpp"

namespace clackers::model {

ForceCounts force_counts(const ImpactProblem<>& problem) {
  const auto* springs = one_sided_springs(problem);
  return {std::ssize(problem.contacts), springs != nullptr ? std::ssize(springs->contacts()) : 0,
          std::ssize(problem.frictions)};
}

Eigen::VectorXd forces(const ImpactProblem<>& problem, const Motion& motion, double t, Side side) {
  const auto counts = force_counts(problem);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(counts.all());
  if (const auto held = motion.contact_forces(t, side); held.size() > 0) {
    values.head(counts.contacts) = held.head(counts.contacts);
    values.tail(counts.frictions) = held.tail(counts.frictions);
  }
  if (counts.springs == 0) return values;
  const auto& springs = *one_sided_springs(problem);
  const auto u = motion.at(t, side).u;
  for (Eigen::Index j = 0; j < counts.springs; ++j) {
    const auto i = std::size_t(j);
    values[counts.contacts + j] =
        std::max(0.0, -springs.stiffnesses()[i] * springs.contacts()[i].gap_at(u));
  }
  return values;
}

}  // namespace clackers::model
