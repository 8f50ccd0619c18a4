#pragma once

#include <optional>
#include <vector>

#include "clackers/model/sink.hpp"

namespace clackers::model {

/// An impact of a stored history.
struct Impact {
  double t = 0.0;  ///< [s]
  int contact = 0;
  std::vector<double> u, v_before, v_after;
  double impulse = 0.0;  ///< [N s]
};

/// A stored history, row-major (time, mass). A time that stands twice carries the left and the
/// right limit of a jump.
struct Trajectory {
  int dof = 0;
  std::vector<double> t;     ///< [s], not descending
  std::vector<double> u, v;  ///< t.size() x dof
  std::vector<double> a;     ///< t.size() x dof, or empty when not known
  /// Empty optional: impacts were not reported. Empty list: there were none.
  std::optional<std::vector<Impact>> impacts;
};

/// Stores a run whole; for short runs, tests and figures.
class TrajectorySink : public Sink {
 public:
  explicit TrajectorySink(bool impacts_are_reported);
  bool take(const SampleBlock& block) override;
  bool take(const ReportedImpact& impact) override;
  const Trajectory& trajectory() const { return trajectory_; }

 private:
  Trajectory trajectory_;
};

}  // namespace clackers::model
