#pragma once

#include "clackers/record/sheet.hpp"

namespace clackers::tables {

/// Every cause that check and verify look for: what its value is, the unit, and what it means.
record::Sheet list_diagnoses();

}  // namespace clackers::tables
