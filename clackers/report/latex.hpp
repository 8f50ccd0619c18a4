#pragma once

#include <iosfwd>

#include "clackers/study/record.hpp"

namespace clackers::report {

/// The verdict table as a LaTeX fragment: a table of the package booktabs with caption and label
/// (tab:clackers-CASE), for \input. What is said of a method beyond its numbers is a note below.
void write_latex(const study::Record& record, std::ostream& out);

}  // namespace clackers::report
