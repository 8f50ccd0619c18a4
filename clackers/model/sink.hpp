#pragma once

#include <span>

namespace clackers::model {

/// A block of consecutive states of a run: row-major (time, mass). Valid only during the call.
struct SampleBlock {
  int dof = 0;
  std::span<const double> t;     ///< [s], ascending
  std::span<const double> u, v;  ///< each t.size() x dof
};

/// One impact as a run reports it. Valid only during the call.
struct ReportedImpact {
  double t = 0.0;                                ///< [s]
  int contact = 0;                               ///< row of ImpactProblem::contacts
  std::span<const double> u, v_before, v_after;  ///< one entry a degree of freedom
  double impulse = 0.0;                          ///< along the contact's direction [N s]
};

/// Receives a run as it happens: stores it, streams it or reduces it. States and impacts come in
/// order of time; the states up to an impact have been delivered when the impact is. The state at
/// the start of the run is delivered first.
class Sink {
 public:
  virtual ~Sink() = default;
  /// Returns false to end the run here.
  virtual bool take(const SampleBlock& block) = 0;
  /// Returns false to end the run here.
  virtual bool take(const ReportedImpact& impact) = 0;
};

}  // namespace clackers::model
