#pragma once

#include <Eigen/Core>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/exact/quantities/energy.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::tables {

/// Where the energy of a motion of any kind is. Constant loads f have the potential -f . u. What dashpots and
/// friction dissipate, and the work of other loads and of belts, is integrated over the states: between impacts by
/// Gauss's rule on intervals in which no mode turns by more than 1 rad, halved until both halves agree with the whole to
/// the rounding of the largest energy. What that leaves out, and the errors of the states, is the error of total().
class EnergyBalance {
 public:
  /// Up to `until` [s]. The case must outlive it.
  EnergyBalance(const cases::Case& test_case, double until);

  /// Whether loads that vary, or belts, do work.
  bool has_work() const { return work_of_loads_ || work_of_belts_; }
  exact::EnergySplit at(double t, model::Side side) const;
  /// Sum of M v [kg m/s].
  double momentum(double t, model::Side side) const;

 private:
  /// What has flowed out and in.
  struct Flow {
    double dissipated = 0.0, work = 0.0;
  };
  struct Interval {
    double from = 0.0;
    Flow before{};  ///< up to `from`
  };
  struct Loss {
    double t = 0.0, sum = 0.0;
  };

  void add_losses();
  void integrate(double until);
  double tolerance(double t) const;
  void add(double from, double to, const Flow& whole);
  Flow rate(double t, model::Side side) const;
  Flow integral(double from, double to) const;

  const model::ImpactProblem<>& problem_;
  const model::Motion& motion_;
  measure::MechanicalEnergy energy_;
  Eigen::VectorXd constant_;  ///< loads [N]
  model::Load varying_;       ///< the others
  bool work_of_loads_ = false, work_of_belts_ = false;
  double fastest_ = 0.0;  ///< [rad/s]
  double largest_ = 0.0;  ///< energy [J]
  std::vector<Loss> losses_;
  std::vector<Interval> intervals_;
  Flow sum_;
};

}  // namespace clackers::tables
