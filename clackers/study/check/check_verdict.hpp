#pragma once

#include <vector>

#include "clackers/study/check_record.hpp"

namespace clackers::study {

/// The histories as levels of a ladder, coarsest first: neighbouring steps, of a ratio below 1.3,
/// within a factor 2 are one level. Files come coarsest first.
assess::Ladder levels_of(const std::vector<CheckedFile>& files);

/// Fills assessment, verdict, sentence, reason and next of a record whose files are judged one by
/// one and sorted, coarsest first.
void decide(CheckRecord& record);

}  // namespace clackers::study
