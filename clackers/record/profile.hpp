#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/judge/cost/performance_profile.hpp"
#include "clackers/judge/cost/work_precision.hpp"

namespace clackers::record {

struct CaseRecord;

/// A performance profile of the methods of one study or of several, by one counter.
struct Profile {
  std::string counter;  ///< as a run's work has it in json: "force_evaluations"
  /// A case with an error in u to reach: "stop: error in u <= 1e-03".
  std::vector<std::string> tasks;
  std::vector<judge::MethodProfile> methods;  ///< refused and failed ones too, as in the study
};

/// "force_evaluations": the name of a counter in json and csv.
std::string_view field_of(judge::Counter counter);

/// Profiles by every counter that is the same on every machine and above 0 wherever a task is
/// solved. The tasks: each case with the errors 0.1, 0.01, ... down to the smallest that some method
/// reaches on it; what a method needs for one is judge::work_for. A method that refused a case or
/// does not reach an error has failed there. Nothing where a subject was
/// interrupted, since what was not run has not failed, and where no method reaches 0.1. All cases
/// have the same methods.
std::vector<Profile> profiles_of(std::span<const CaseRecord> cases);

}  // namespace clackers::record
