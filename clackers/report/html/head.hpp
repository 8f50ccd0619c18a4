#pragma once

#include <string>

#include "clackers/record/record.hpp"

// What stands above the sections of a record.
namespace clackers::report {

/// What the case is, how long, and its steps.
std::string lead_html(const record::CaseRecord& problem);

/// The verdict over all, and what it rests on.
std::string overall_html(const record::Record& record);

}  // namespace clackers::report
