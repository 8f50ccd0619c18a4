#pragma once

#include "clackers/study/record.hpp"

namespace clackers::study {

/// Throws InputError [other-study] where the baseline is of another case, other parameters, another
/// length or another ladder than `problem` and `plan`. Numbers are compared bit by bit: a record
/// reads back to the same doubles.
void match_baseline(const CaseSummary& problem, const LadderPlan& plan, const Record& baseline);

}  // namespace clackers::study
