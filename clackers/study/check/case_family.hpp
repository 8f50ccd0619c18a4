#pragma once

#include "clackers/cases/case.hpp"
#include "clackers/diagnose/diagnose.hpp"

namespace clackers::study {

/// The parameters of a case that are numbers, then the numbers of its contacts and one-sided springs, and its motions
/// of as many masses. Parameters that are asked for together are all settings, or none is. The case must outlive it.
diagnose::CaseFamily family_of(const cases::Case& problem);

}  // namespace clackers::study
