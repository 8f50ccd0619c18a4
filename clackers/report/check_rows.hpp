#pragma once

#include "clackers/study/check_record.hpp"
#include "clackers/study/sheet.hpp"

namespace clackers::report {

/// A row a history, coarsest step first; every metric is a column.
study::Sheet check_rows(const study::CheckRecord& record);

}  // namespace clackers::report
