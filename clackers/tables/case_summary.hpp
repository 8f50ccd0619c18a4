#pragma once

#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"

namespace clackers::tables {

/// What a record says of a case.
record::CaseSummary summary_of(const cases::Case& problem);

}  // namespace clackers::tables
