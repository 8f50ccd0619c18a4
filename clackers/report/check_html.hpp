#pragma once

#include <string>

#include "clackers/study/check_record.hpp"

namespace clackers::report {

// The pieces of check's page that differ from verify's; everything of a record in them is escaped.

/// The table of files, what limits the judgement, and the fit of several.
std::string histories_html(const study::CheckRecord& record);

/// All metrics of the finest history with their definitions, those not measured with the reason.
std::string metrics_html(const study::CheckRecord& record);

}  // namespace clackers::report
