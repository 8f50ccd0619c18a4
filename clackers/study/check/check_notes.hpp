#pragma once

#include "clackers/study/check_record.hpp"

namespace clackers::study {

/// Adds in words what limits the judgement of a history, and by how much: printed digits, sampling,
/// where its collisions come from, a late start, an early end, a start beside the reference.
void add_notes(CheckedFile& file, const CaseSummary& problem);

}  // namespace clackers::study
