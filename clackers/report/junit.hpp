#pragma once

#include <iosfwd>

#include "clackers/study/baseline.hpp"
#include "clackers/study/record.hpp"

namespace clackers::report {

/// A study as JUnit XML, which continuous-integration systems show: one suite, the case; one test a
/// method. A method that disagrees is a failure with its sentence; one that refused the case or
/// stays undecided is skipped with the reason; one that was interrupted is an error. `time` is
/// processor time [s]. What was measured stands in properties, as numbers that read back to the
/// same double. What changed since a baseline is the output of the suite.
void write_junit(const study::Record& record, std::ostream& out,
                 const study::BaselineComparison* changes = nullptr);

}  // namespace clackers::report
