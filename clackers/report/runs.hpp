#pragma once

#include "clackers/study/record.hpp"
#include "clackers/study/sheet.hpp"

namespace clackers::report {

/// Every run of a record as a row, methods in the record's order, coarsest steps first. A method
/// without any run, because it refused the case or was not reached, has one row with its name and
/// the reason. `complete` is false in the rows of a method that was interrupted.
study::Sheet runs(const study::Record& record);

}  // namespace clackers::report
