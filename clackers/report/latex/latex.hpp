#pragma once

#include "clackers/report/write.hpp"

namespace clackers::report {

/// A record as LaTeX fragments for \input: of each case a table of its methods (tab:clackers-CASE)
/// and one of its histories (tab:clackers-check-CASE), with the package booktabs. Findings are notes
/// below.
void write_latex(const record::Record& record, std::ostream& out, const Style& style,
                 const study::BaselineComparison* changes);

}  // namespace clackers::report
