#pragma once

#include <iosfwd>

#include "clackers/report/write.hpp"
#include "clackers/study/check_record.hpp"

namespace clackers::report {

/// A checked history, or several as levels of one method. Table: a row a file, what limits the
/// judgement, the metrics of the finest file, the fit, and a last line with the verdict and what to
/// do next; at most style.width characters a line. Csv: a row a file, metrics as columns. Json:
/// everything, with the schema clackers/check/1.
void write(const study::CheckRecord& record, Format format, std::ostream& out,
           const Style& style = {});

}  // namespace clackers::report
