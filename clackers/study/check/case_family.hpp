#pragma once

#include "clackers/cases/case.hpp"
#include "clackers/diagnose/diagnose.hpp"

namespace clackers::study {

/// Whether a case is a problem file, none of whose numbers is a parameter.
bool is_of_a_file(const cases::Case& problem);

/// The parameters of a case that are numbers, of a problem file those of its contacts, and its motions. The case must
/// outlive it.
diagnose::CaseFamily family_of(const cases::Case& problem);

}  // namespace clackers::study
