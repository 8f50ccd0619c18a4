#pragma once

#include <string>

#include "clackers/report/html/tables.hpp"

namespace clackers::report {

/// A section for each subject of a case: finding, facts, levels, what one would conclude without the
/// exact solution, and metrics.
std::string subjects_html(const record::CaseRecord& problem, const Place& place);

}  // namespace clackers::report
