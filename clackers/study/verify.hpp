#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/study/progress.hpp"
#include "clackers/study/record.hpp"

namespace clackers::study {

/// What `clackers verify` is asked for.
struct VerifyRequest {
  std::vector<std::string> methods;  ///< specifications; empty: the default panel
  std::vector<std::string> cases;    ///< names; empty: the default case
  cases::Settings settings;          ///< of every case
  RefinementPlan plan;
  int jobs = 0;         ///< threads; 0: one a processor
  std::string command;  ///< as typed, for the record
};

/// Assesses every method on every case over the plan's steps. Throws InputError before any work for
/// what cannot be run: unknown names, values outside their range, too many steps, a method or a case
/// named twice, a case that no method takes. A method that objects to a case is kept with its
/// refusal. When `interrupt` becomes true the record comes back with what was finished, marked
/// interrupted.
Record verify(const VerifyRequest& request, const Progress& progress = {},
              const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::study
