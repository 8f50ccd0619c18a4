#pragma once

#include <memory>

#include "clackers/tables/respond.hpp"

namespace clackers::tables {

/// respond() with each value correctly rounded to `digits` significant digits, as text; times to at
/// least 17, so that they read back as the doubles they are. The case must outlive the rows. Throws
/// InputError unless 1 <= digits <= 1000, and when built without Arb.
std::unique_ptr<record::RowSource> respond(const cases::Case& test_case, const TimeGrid& grid,
                                           long long digits);

/// impacts() in the same way; t is the true instant, not the nearest double.
std::unique_ptr<record::RowSource> impacts(const cases::Case& test_case, long long digits);

}  // namespace clackers::tables
