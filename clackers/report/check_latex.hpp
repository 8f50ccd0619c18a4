#pragma once

#include <iosfwd>

#include "clackers/study/check_record.hpp"

namespace clackers::report {

/// Checked histories as a LaTeX table (booktabs): a row a file, the verdict with its sentence and
/// the order of several below it.
void write_check_latex(const study::CheckRecord& record, std::ostream& out);

}  // namespace clackers::report
