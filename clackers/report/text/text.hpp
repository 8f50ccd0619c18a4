#pragma once

#include "clackers/report/write.hpp"

namespace clackers::report {

/// A record for a person, at most style.width characters a line: of each case a table of methods,
/// one of histories with the metrics of the finest, and a sentence for each finding; of several cases
/// the performance profile; what changed since a baseline; a last line with the verdict and the next
/// command.
void write_text(const record::Record& record, std::ostream& out, const Style& style,
                const study::BaselineComparison* changes);

}  // namespace clackers::report
