#pragma once

#include <optional>
#include <vector>

#include "clackers/diagnose/observation.hpp"
#include "clackers/diagnose/system/flight_changes.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::diagnose {

/// Some changes fitted together: their parameters one after the other.
struct Fitted {
  std::vector<std::size_t> changes;
  Eigen::VectorXd values, uncertainty;
  double gain = 0.0;
};

/// What the flights of one history lack of the case's equations, from row to row, and what each change
/// makes of it.
class FlightFits {
 public:
  FlightFits(const Observation& seen, const model::SmoothSystem<>& system,
             const std::vector<FlightChange>& changes);

  /// Whether the history has velocities and enough rows between impacts.
  bool known() const { return lack_.size() > 0; }
  /// By this share displacements between rows are larger than what velocities make of them: no force
  /// does so, but a clock, or another unit of velocities.
  double excess() const { return excess_; }

  Fitted of(std::vector<std::size_t> changes) const;

 private:
  void move_flights(const Observation& seen, const model::SmoothSystem<>& system,
                    const std::vector<FlightChange>& changes);

  Eigen::VectorXd lack_;  ///< of sqrt(m) v, over the length of the flight: a row a flight and mass
  Eigen::MatrixXd columns_, gram_;
  Eigen::VectorXd onto_;
  double excess_ = 0.0, square_ = 0.0;
  Eigen::Index next_ = 0;
  std::vector<Eigen::Index> first_, count_;
};

/// The change, or two of them, that leave least; nothing where another one leaves little more. One of
/// some springs, dampers or loads beside all of them is as good as two.
std::optional<Fitted> best_of(const FlightFits& fits, const std::vector<FlightChange>& changes);

}  // namespace clackers::diagnose
