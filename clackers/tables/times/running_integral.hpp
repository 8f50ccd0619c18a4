#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "clackers/cases/case.hpp"

namespace clackers::tables {

/// The integrals from 0 to t of some rates over the states of a motion, by Lobatto's rule on intervals in which no mode, also with
/// all springs closed, and no load turns by more than 1 rad, halved until both halves agree with the whole to the rounding of `largest`.
class RunningIntegral {
 public:
  using Rates = std::function<Eigen::VectorXd(double t, model::Side side)>;

  /// Of as many rates as `largest` has numbers, up to `until` [s]. At `breaks`, ascending, they may jump. The case must
  /// outlive it.
  RunningIntegral(const cases::Case& test_case, Rates rates, const std::vector<double>& breaks,
                  double until, Eigen::VectorXd largest);

  Eigen::VectorXd at(double t) const;

 private:
  struct Interval {
    double from = 0.0;
    Eigen::VectorXd before;  ///< up to `from`
  };

  void add(double from, double to, const Eigen::VectorXd& whole);
  Eigen::VectorXd over(double from, double to) const;

  Rates rates_;
  Eigen::VectorXd largest_, sum_;
  double dof_, fastest_ = 0.0;  ///< [rad/s]
  std::vector<Interval> intervals_;
};

}  // namespace clackers::tables
