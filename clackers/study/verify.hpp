#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/solvers/solver.hpp"
#include "clackers/study/candidate.hpp"
#include "clackers/study/refinement.hpp"

namespace clackers::study {

/// What `clackers verify` is asked for.
struct VerifyRequest {
  /// Specifications; empty: the default panel, or none beside solvers.
  std::vector<std::string> methods;
  std::vector<std::string> cases;  ///< names; empty: the default case
  cases::Settings settings;        ///< of every case
  /// Of each case instead; empty: none has settings of its own.
  std::vector<cases::Settings> case_settings{};
  RefinementRequest plan;
  /// Time for refinement beyond the plan, of all cases and subjects together [s]; 0: none. What is run
  /// within it does not depend on it, only where it ends.
  double budget = 0.0;
  int jobs = 0;                                   ///< threads; 0: one per processor
  std::string command;                            ///< as typed, for the record
  std::vector<solvers::SolverSubject> solvers{};  ///< behind the methods
};

/// Assesses every method and solver on every case over the plan's steps, adaptive ones over
/// tolerances, of which there are none without an adaptive method or a solver. Throws InputError
/// before any work for what cannot be run: unknown names, values outside their range, too many steps,
/// a subject or a case named twice, a case that no method takes. A method that objects to a case is
/// kept with its refusal. A run of a solver that fails is a failed run of its step with what was
/// printed; after three failures in a row that smaller steps would share, those are not made.
///
/// Subjects that the plan leaves undecided are refined further, round by round, while the budget
/// lasts: next_plan() says how; a round that would exceed the budget, by the measured time of a step,
/// is not begun. Runs are made in parallel, those of serial candidates one at a time. Every round
/// reports progress from 0 to 1. In the end some runs of a method whose errors do not fall as in
/// smooth motion are made again and diagnosed.
///
/// When `interrupt` becomes true the record comes back with what was finished, marked interrupted; a
/// subject whose refinement was interrupted keeps the ladder it had before.
record::Record verify(const VerifyRequest& request, const Progress& progress = {},
                      const std::atomic<bool>* interrupt = nullptr);

/// The cases of a request and the steps of each. Throws InputError as verify() does before any work,
/// except what only a solver refuses.
struct PlannedCase {
  record::CaseSummary problem;
  record::RefinementPlan steps;
};
std::vector<PlannedCase> planned_cases(const VerifyRequest& request);

/// The plan of a case whose subjects are histories, or solvers with levels of their own.
inline constexpr record::RefinementPlan no_refinement{0.0, 0, 0};

/// The steps of a request on a case, and the tolerances. Throws InputError for steps that verify()
/// refuses.
record::RefinementPlan checked_plan(const RefinementRequest& request, const StudyCase& problem,
                                    LadderKind kind);
std::vector<double> tolerances_of(const RefinementRequest& request);

}  // namespace clackers::study
