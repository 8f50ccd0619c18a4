#pragma once

#include <cstddef>
#include <span>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/errors/score.hpp"
#include "clackers/measure/errors/state_errors.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::measure {

/// The largest proved error of the reference at time t over `scale`, its peak(), of u and v of all
/// masses; components without a scale are left out.
double relative_bound(const model::Motion& reference, const model::Kinematics& scale, double t);

/// What errors may be by rounding, a unit of each of `states`, or by the error bound of the reference
/// at 17 equidistant times from `first` to `last` [s], whichever is larger; relative as u_error is.
double rounding_floor(const model::Motion& reference, const model::Kinematics& scale,
                      long long states, double first, double last);

/// What errors of runs on a case are divided by. To find it takes as long as a run.
struct Scales {
  model::Kinematics peak;  ///< of the reference
  /// The largest energy of the reference over the run [J]: that at the start, unless it has none there
  /// or a load brings some; then the largest at 1024 equal parts.
  double energy;
};
Scales scales_of(const model::Motion& reference, const model::ImpactProblem<>& problem);

/// States of all masses, row-major (time, mass).
struct StateRows {
  std::span<const double> u, v;  ///< v is empty where velocities are not known
};

/// Measures a run or a stored history: takes its states with those of the reference, and stores only
/// sums and maxima. Errors of u and v are relative to the largest envelope over the run, those of the
/// energy v' M v / 2 + u' K u / 2 to the largest energy of the reference over the run.
class Meter {
 public:
  /// Motion must outlive the meter.
  Meter(const model::Motion& reference, const model::ImpactProblem<>& problem, Scales scales);

  /// Takes states at output times, in order, with the right limits of the reference.
  void take(std::span<const double> t, const StateRows& found, const StateRows& reference);
  /// Takes the limits of a jump as VelocityError does; they are no states for the energy.
  void take(const model::ReportedImpact& impact) { velocity_.take(impact); }
  /// Takes displacements at one time within a jump, where u is continuous: one entry a mass.
  void take_displacements(const double* found, const double* reference) {
    ++states_;
    errors_.take_displacements(found, reference);
  }

  /// The errors so far; step, outcome, work, time and impacts are left as they are in a new score. A
  /// state that was not finite makes the errors infinite. NaN stands for what is not known: errors
  /// of velocities and energy without velocities, the energy's without a positive scale.
  RunScore score() const;
  /// Largest |error in u| of each mass [m].
  std::span<const double> u_errors() const { return errors_.u(); }
  const VelocityError& velocity() const { return velocity_; }
  const Scales& scales() const { return scales_; }
  double last() const { return last_; }  ///< time of the last state [s]

 private:
  const model::Motion& reference_;
  std::size_t dof_;
  Scales scales_;
  StateErrors errors_;
  double first_, last_;  ///< times of the first and last state [s]
  long long states_ = 0;
  bool has_velocities_ = true;
  VelocityError velocity_;
};

}  // namespace clackers::measure
