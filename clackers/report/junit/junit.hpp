#pragma once

#include "clackers/report/write.hpp"

namespace clackers::report {

/// A record as JUnit XML, which continuous-integration systems show: a suite a case, a test a
/// subject. A subject that disagrees is a failure with its finding; one that refused the case or
/// stays undecided is skipped with the reason; one that was interrupted is an error. `time` is
/// processor time [s]. What was measured stands in properties, as numbers that read back to the same
/// double. What changed since a baseline is the output of the suite.
void write_junit(const record::Record& record, std::ostream& out, const Style& style,
                 const study::BaselineComparison* changes);

}  // namespace clackers::report
