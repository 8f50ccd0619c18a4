#pragma once

#include <cmath>
#include <string>

#include "clackers/cases/case.hpp"
#include "clackers/methods/testing/runs.hpp"

// Rows of methods of the catalogue, for tests only.
namespace clackers::diagnose::testing {

/// The rows of the method over the whole case with whole steps of about h [s], as a file without
/// an events file has them.
inline model::Trajectory run(const std::string& method, const model::ImpactProblem<>& problem,
                             double h) {
  auto rows = methods::runs::run(method, problem, problem.end / std::round(problem.end / h));
  rows.trajectory.impacts.reset();
  return std::move(rows.trajectory);
}

}  // namespace clackers::diagnose::testing
