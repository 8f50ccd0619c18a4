#pragma once

#include <optional>

#include "clackers/cases/case.hpp"
#include "clackers/report/write.hpp"

namespace clackers::cli {

/// Where the dials of a page stand for a case. Throws InputError where there are none for it.
report::Dials dials_of(const cases::Case& test_case);

/// The same for pages of respond and show; nothing where there are none, or where the dials would leave
/// their usual range: the page computes runs of methods when it opens.
std::optional<report::Dials> usual_dials(const cases::Case& test_case);

}  // namespace clackers::cli
