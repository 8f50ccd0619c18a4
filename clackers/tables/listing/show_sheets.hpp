#pragma once

#include <optional>

#include "clackers/cases/case.hpp"
#include "clackers/record/sheet.hpp"

namespace clackers::tables {

/// The harmonics of the fast mass of a pair around their peak and around the last that reaches
/// `threshold`; nothing for a single mass.
std::optional<record::Sheet> harmonic_sheet(const cases::Case& test_case, double threshold);

/// After which impact a disturbance of the start, or of the frequencies, has made a pair lose its
/// synchrony, for several sizes; nothing for a single mass.
std::optional<record::Sheet> conditioning_sheet(const cases::Case& test_case);

}  // namespace clackers::tables
