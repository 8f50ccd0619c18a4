#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "clackers/diagnose/diagnose.hpp"
#include "clackers/diagnose/file/reading.hpp"

namespace clackers::diagnose {

/// The first row of a history beside the state that the case has at its time, as lists of quantities
/// (reading.hpp).
class FirstRow {
 public:
  FirstRow(const FirstRows& opening, const model::ImpactProblem<>& problem,
           const model::Motion& motion);

  std::size_t masses() const { return masses_; }
  bool has_v() const { return given_.size() > masses_; }
  double time() const { return opening_.rows.t.front(); }
  /// Step of the solver, or where it is not known the time between the first rows; 0 for one row.
  double step() const { return step_; }
  const FirstRows& opening() const { return opening_; }
  const model::Motion& motion() const { return motion_; }
  const model::ImpactProblem<>& problem() const { return problem_; }
  /// NaN for displacements that the file does not have.
  const std::vector<double>& given() const { return given_; }
  const std::vector<double>& expected() const { return expected_; }
  bool complete() const;

  /// Numbers agree up to this part of the envelope: 1e-6, and twice what printing makes.
  double tolerance() const { return tolerance_; }
  /// Largest difference over the envelope; quantities that are not known are left out.
  double distance(const std::vector<double>& numbers, const std::vector<double>& state) const;
  double distance() const { return distance(given_, expected_); }
  /// The state of the motion at that time, as a list of quantities.
  std::vector<double> state_at(double t) const;
  /// Scale of quantity q.
  double scale(std::size_t q) const { return scale_[q]; }

  /// Rms distance of the rows before the first impact from the motion under a reading; NaN for fewer
  /// than three of them.
  double flight_distance(const Reading& reading) const;
  /// Rms distance of their displacements from another motion; NaN for fewer than three.
  double flight_distance(const model::Motion& other) const;
  /// The same from the motion that the problem has from the state of the first row, free of contact.
  double own_flight_distance() const;

 private:
  double flight_distance(std::span<const double> u) const;

  const FirstRows& opening_;
  const model::ImpactProblem<>& problem_;
  const model::Motion& motion_;
  std::size_t masses_;
  double step_ = 0.0, tolerance_;
  std::vector<double> given_, expected_, scale_;
  model::Trajectory flight_, reference_;  ///< rows before the first impact
};

}  // namespace clackers::diagnose
