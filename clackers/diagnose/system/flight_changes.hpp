#pragma once

#include <functional>
#include <span>
#include <vector>

#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/model/system.hpp"

namespace clackers::diagnose {

/// One way in which the flights may be those of another system: linear in each of its parameters.
struct FlightChange {
  Diagnosis cause;  ///< without its numbers
  std::vector<std::function<void(model::SmoothSystem<>&, double)>> parameters;
  double frequency = 0.0;  ///< of a load [rad/s]
  bool is_of_all = false;  ///< all springs, dampers or loads by one share, not one of them
};

/// A spring, a damper, a mass, a load and a constant force on a mass: each, and of springs, dampers and
/// loads all together.
std::vector<FlightChange> changes_of(const model::SmoothSystem<>& system);

/// The diagnosis of a change by the values of its parameters; `uncertainty` of the first.
Diagnosis diagnosis_by(const FlightChange& change, std::span<const double> values,
                       double uncertainty);

}  // namespace clackers::diagnose
