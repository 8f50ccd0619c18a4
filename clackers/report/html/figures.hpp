#pragma once

#include <string>
#include <vector>

#include "clackers/report/html/tables.hpp"

namespace clackers::report {

/// The figures of a case: frames with captions, legends and tools. `number` counts the figures of the
/// page and is raised.
std::string figures_html(const study::CaseRecord& problem, const Place& place, int& number);

/// The figure "profile" of profiles over several cases, with its legend.
std::string profile_html(const study::Record& record, int& number);

}  // namespace clackers::report
