#pragma once

// Histories of a foreign solver at several steps of several cases, for tests only.

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "clackers/diagnose/testing/foreign_solver.hpp"
#include "clackers/diagnose/testing/histories.hpp"

namespace clackers::diagnose::testing {

/// A case and the steps at which it is run, coarsest first.
struct LadderPlan {
  cases::Case problem;
  std::vector<double> steps;
};

/// Plans of different systems, dampings, restitutions, steps and numbers of files: five files
/// in the ratio 1.93 for even numbers, so that no grid contains another, nine in the ratio sqrt(2)
/// for odd ones. The coarsest step is a 20th to a 30th of the fastest period.
inline LadderPlan ladder_plan(int number) {
  static const std::vector<std::pair<const char*, Settings>> systems{
      {"three-parameter", {{"N", 2.0}, {"xi1", 0.05}}},
      {"three-parameter", {{"N", 1.0}, {"xi1", 0.1}}},
      {"three-parameter", {{"N", 1.0}, {"xi1", 0.02}}},
      {"stop", {{"xi1", 0.05}, {"eta", 0.8}}},
      {"synchronized-pair", {{"X", 5.0}, {"r", 2.0}, {"eta", 0.8}, {"xi1", 0.08}}}};
  std::mt19937 random(unsigned(number) + 17u);
  std::uniform_real_distribution<double> divisor(20.0, 30.0);
  const auto& [name, settings] = systems[std::size_t(number) % systems.size()];
  LadderPlan plan{cases::make(name, settings), {}};
  const auto& periods = plan.problem.damped_periods;
  const double coarsest = *std::ranges::min_element(periods) / divisor(random);
  const int files = number % 2 == 0 ? 5 : 9;
  const double ratio = number % 2 == 0 ? 1.93 : std::sqrt(2.0);
  for (int i = 0; i < files; ++i) plan.steps.push_back(coarsest / std::pow(ratio, i));
  return plan;
}

/// The histories of a solver that was given `problem` instead of the plan's.
inline Files files_of(const LadderPlan& plan, const std::string& solver,
                      const model::ImpactProblem<>& problem) {
  Files files{plan.problem};
  for (const double step : plan.steps) files.add(history_of(solver, problem, step), step);
  return files;
}

inline Files files_of(const LadderPlan& plan, const std::string& solver) {
  return files_of(plan, solver, plan.problem.problem);
}

}  // namespace clackers::diagnose::testing
