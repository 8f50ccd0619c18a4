#pragma once

#include <iosfwd>

#include "clackers/study/check_record.hpp"

namespace clackers::report {

/// Checked histories as JUnit XML: one suite, the case; one test, the history or the ladder of
/// histories. It fails when it disagrees and is skipped when undecided, with the sentence that says
/// why. A line a file stands in the body, what was measured of the finest in properties.
void write_check_junit(const study::CheckRecord& record, std::ostream& out);

}  // namespace clackers::report
