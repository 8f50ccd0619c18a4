#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/exact/quantities/energy.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/tables/times/running_integral.hpp"

namespace clackers::tables {

/// Where the energy of a motion of any kind is. Constant loads f have the potential -f . u. What dashpots and
/// friction dissipate, and the work of other loads and of belts, is integrated over the states. What that leaves
/// out, and the errors of the states, is the error of total().
class EnergyBalance {
 public:
  /// Up to `until` [s]. The case must outlive it.
  EnergyBalance(const cases::Case& test_case, double until);
  EnergyBalance(const EnergyBalance&) = delete;
  EnergyBalance& operator=(const EnergyBalance&) = delete;

  /// Whether loads that vary, or belts, do work.
  bool has_work() const { return work_of_loads_ || work_of_belts_; }
  exact::EnergySplit at(double t, model::Side side) const;
  /// Sum of M v [kg m/s].
  double momentum(double t, model::Side side) const;

 private:
  /// What flows out and in.
  enum { dissipated, work };
  using Flow = Eigen::Vector2d;
  struct Loss {
    double t = 0.0, sum = 0.0;
  };

  void add_losses();
  void integrate(const cases::Case& test_case, double until);
  Flow rate(double t, model::Side side) const;

  const model::ImpactProblem<>& problem_;
  const model::Motion& motion_;
  measure::MechanicalEnergy energy_;
  Eigen::VectorXd constant_;  ///< loads [N]
  model::Load varying_;       ///< the others
  bool work_of_loads_ = false, work_of_belts_ = false;
  std::vector<Loss> losses_;
  std::optional<RunningIntegral> flow_;
};

}  // namespace clackers::tables
