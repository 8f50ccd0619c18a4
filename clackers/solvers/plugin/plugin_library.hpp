#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/solvers/plugin/clackers_solver.h"

namespace clackers::solvers {

/// Loads a shared library, which stays for the rest of the process, and returns its solver. Throws
/// InputError (not-a-plugin) where it cannot be loaded, has no function clackers_plugin(), or a solver
/// of another version, without run or of unknown refinement.
const clackers_solver& load_plugin(const std::string& library);

/// A problem as plug-ins are handed it.
class PluginProblem {
 public:
  explicit PluginProblem(const model::ImpactProblem<>& problem);
  PluginProblem(const PluginProblem&) = delete;
  PluginProblem& operator=(const PluginProblem&) = delete;

  const clackers_solver_problem* get() const { return &problem_; }

 private:
  std::vector<double> mass_, damping_, stiffness_, directions_, gaps_, restitutions_, u_, v_;
  clackers_solver_problem problem_;
};

}  // namespace clackers::solvers
