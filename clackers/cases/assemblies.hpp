#pragma once

#include <vector>

#include "clackers/cases/row.hpp"

namespace clackers::cases {

/// Any number of masses whose impacts are synchronized.
std::vector<Row> assembly_rows();

/// Parameters that mean the same in every case.
Parameter xi1();
Parameter whole_N();
Parameter scale(const char* name, double default_value, const char* unit, const char* allowed,
                const char* meaning);

/// X = 4N + 1 of Eq. (9), up to the largest ratio that the reference solution takes. Throws
/// InputError for an N that is no whole number or outside its range.
double ratio(const Case& which, double N);

}  // namespace clackers::cases
