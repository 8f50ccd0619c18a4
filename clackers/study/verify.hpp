#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/study/refinement.hpp"

namespace clackers::study {

/// What `clackers verify` is asked for.
struct VerifyRequest {
  std::vector<std::string> methods;  ///< specifications; empty: the default panel
  std::vector<std::string> cases;    ///< names; empty: the default case
  cases::Settings settings;          ///< of every case
  /// Of each case instead; empty: none has settings of its own.
  std::vector<cases::Settings> case_settings{};
  RefinementRequest plan;
  /// The levels of adaptive methods, descending; empty: default_tolerances.
  std::vector<double> tolerances{};
  /// Time for refinement beyond the plan, of all cases together [s]; 0: none. What is run within it
  /// does not depend on it, only where it ends.
  double budget = 0.0;
  int jobs = 0;         ///< threads; 0: one a processor
  std::string command;  ///< as typed, for the record
};

/// Assesses every method on every case over the plan's steps, adaptive ones over tolerances, of which
/// there are none without an adaptive method. Throws InputError before any work for
/// what cannot be run: unknown names, values outside their range, too many steps, a method or a case
/// named twice, a case that no method takes. A method that objects to a case is kept with its
/// refusal. Subjects that the plan leaves undecided are refined further, round by round, while the
/// budget lasts: next_plan() says how; a round that would exceed the budget, by the measured time of
/// a step, is not begun. Every round reports progress from 0 to 1. When `interrupt` becomes true the
/// record comes back with what was finished, marked interrupted; a subject whose refinement was
/// interrupted keeps the ladder it had before.
record::Record verify(const VerifyRequest& request, const Progress& progress = {},
                      const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::study
