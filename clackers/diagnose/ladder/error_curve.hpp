#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "clackers/diagnose/observation.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::diagnose {

/// The error of one sampled history as a function of time, relative to the scale of u.
class ErrorCurve {
 public:
  /// The observation and the motion are read here alone.
  ErrorCurve(const Observation& seen, const model::Motion& motion, const Eigen::VectorXd& scale);

  std::size_t size() const { return t_.size(); }
  double time(std::size_t row) const { return t_[row]; }
  /// Error at a row, one entry a mass; NaN for a mass that the history lacks.
  Eigen::VectorXd at_row(std::size_t row) const { return e_.col(Eigen::Index(row)); }
  /// By a cubic in Hermite's form, or through four rows without velocities. Nothing outside the
  /// sample and where an impact of history or reference lies in the interval.
  std::optional<Eigen::VectorXd> at(double t) const;
  double largest() const;

 private:
  bool has_impact(double from, double to) const;

  std::vector<double> t_;
  Eigen::MatrixXd e_, rate_;     ///< masses x rows; `rate_` empty without velocities
  std::vector<double> impacts_;  ///< of history and reference, ascending [s]
};

}  // namespace clackers::diagnose
