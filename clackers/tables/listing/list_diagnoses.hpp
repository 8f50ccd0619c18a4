#pragma once

#include "clackers/record/sheet.hpp"

namespace clackers::study {

/// Every cause that check and verify look for: what its value is, the unit, and what it means.
Sheet list_diagnoses();

}  // namespace clackers::study
