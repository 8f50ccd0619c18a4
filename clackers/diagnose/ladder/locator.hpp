#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {

/// Locates single impacts of a history of `problem`, which must outlive it, by its free motion.
class Locator {
  using FreeState = measure::FreeState;

 public:
  explicit Locator(const model::ImpactProblem<>& problem)
      : motion_(problem.system),
        mass_(problem.system.mass),
        frequency_(measure::highest_frequency(problem.system)) {}
  double frequency() const { return frequency_; }
  /// Steps of w h <= 0.02 cost 0.02^5 / 120 = 3e-11 of the state each.
  FreeState moved(const FreeState& state, double s) const {
    return motion_.moved(state, s, 1 + int(std::min(1e4, std::abs(s) * frequency_ / 0.02)));
  }
  std::optional<LocatedImpact> located(const FreeState& before, const FreeState& after,
                                       const model::Contact<>& contact,
                                       const std::vector<model::Contact<>>& contacts,
                                       const std::vector<int>& together) const;
  /// What a flight between two rows lacks in the speed of the gap.
  double lack(const FreeState& from, const FreeState& to, const model::Contact<>& contact) const {
    return std::abs(contact.gap_rate(moved(from, to.t - from.t).v - to.v));
  }
  double difference(const Eigen::VectorXd& u, const Eigen::VectorXd& v) const {
    return frequency_ * u.norm() + v.norm();
  }

 private:
  /// The state where the gap closes, nearest in the direction of `reach` [s].
  std::optional<FreeState> closed(FreeState state, const model::Contact<>& contact,
                                  double reach) const;
  /// Velocities after the contacts of these numbers were struck at once.
  Eigen::VectorXd struck(const Eigen::VectorXd& v, const std::vector<model::Contact<>>& contacts,
                         const std::vector<int>& numbers) const;
  double kinetic(const Eigen::VectorXd& v) const { return std::sqrt(v.dot(mass_ * v)); }
  /// What impulses along all contacts leave of a change of velocities.
  double beside_impulses(const Eigen::VectorXd& jump,
                         const std::vector<model::Contact<>>& contacts) const;

  measure::FreeMotion motion_;
  const Eigen::MatrixXd& mass_;
  double frequency_;
};

}  // namespace clackers::diagnose
