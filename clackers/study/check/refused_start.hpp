#pragma once

#include <string>

#include "clackers/cases/case.hpp"
#include "clackers/diagnose/diagnose.hpp"
#include "clackers/study/check/initial_state.hpp"

namespace clackers::study {

/// Refuses a history that starts from another state than the case (InputError). The message of file
/// `name` says the number that differs most, and why with its cure where that is found: parameters of
/// the case that start it so (not-this-case), or a cause of diagnose_start() with its code.
[[noreturn]] void refuse_start(const std::string& name, const diagnose::Opening& opening,
                               const cases::Case& problem, const StartDifference& most);

/// Refuses a history whose first row is after the start and shows units, signs or columns other than
/// the case's. Returns where nothing of that kind explains the row.
void refuse_reading(const std::string& name, const diagnose::Opening& opening,
                    const cases::Case& problem);

}  // namespace clackers::study
