#pragma once

#include <iosfwd>

#include "clackers/report/write.hpp"

namespace clackers::report {

/// A study for a person: the case, a row a method, a sentence for each method that needs one,
/// what changed since a baseline, and a
/// last line with the verdict and the next command. At most style.width characters a line.
void write_verdict_table(const study::Record& record, std::ostream& out, const Style& style,
                         const study::BaselineComparison* changes = nullptr);

}  // namespace clackers::report
