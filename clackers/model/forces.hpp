#pragma once

#include <Eigen/Core>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::model {

/// How many forces a problem has of each kind, in the order in which they stand in a vector.
struct ForceCounts {
  Eigen::Index contacts = 0, springs = 0, frictions = 0;
  Eigen::Index all() const { return contacts + springs + frictions; }
};
ForceCounts force_counts(const ImpactProblem<>& problem);

/// At t: those of contacts that stay closed, then of one-sided springs in compression, 0 for open ones, along their
/// directions; then those of dry friction [N]. Throws InputError for a time outside of the motion.
Eigen::VectorXd forces(const ImpactProblem<>& problem, const Motion& motion, double t, Side side);

}  // namespace clackers::model
