#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/study/record.hpp"

namespace clackers::study {

/// What `clackers verify` is asked for.
struct VerifyRequest {
  std::vector<std::string> methods;  ///< specifications; empty: the default panel
  std::string case_name;             ///< empty: the default case
  cases::Settings settings;
  LadderPlan plan;
  int jobs = 0;         ///< threads; 0: one a processor
  std::string command;  ///< as typed, for the record
};

/// Told now and then, from any thread, one at a time: the share of the work that is done, in [0,
/// 1].
using Progress = std::function<void(double share)>;

/// Judges every method on the case over the plan's ladder. Throws InputError before any work for
/// what cannot be run. A method that objects to the case is kept with its refusal. When `interrupt`
/// becomes true the record comes back with what was finished, marked interrupted.
Record verify(const VerifyRequest& request, const Progress& progress = {},
              const std::atomic<bool>* interrupt = nullptr);

/// The record as json and back; every number reads back to the same double. Json knows neither
/// infinity nor NaN: they stand as the texts "inf", "-inf" and "nan".
std::string to_json(const Record& record);
/// Throws InputError for text that is no such record: a missing, misspelled or unknown field, a
/// value of another kind, another schema.
Record record_from_json(const std::string& text);

/// 0 agrees or nothing claimed, 1 disagrees, 3 undecided; of several methods 1, else 3, else 0.
/// A method that refused the case counts for nothing. 130 for an interrupted record.
int exit_code(const Record& record);

}  // namespace clackers::study
