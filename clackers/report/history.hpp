#pragma once

#include <span>
#include <string>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"
#include "clackers/study/baseline.hpp"

namespace clackers::report {

/// Records of one study, oldest first, as sheets: a row for each subject of each record with what changed
/// since the record before, then order, error and cost against the number of the record, with lines at
/// records in which something changed. `changes[i]` compares records[i + 1] with records[i].
std::vector<record::Sheet> history_sheets(std::span<const record::Record> records,
                                          std::span<const std::string> names,
                                          std::span<const study::BaselineComparison> changes);

}  // namespace clackers::report
