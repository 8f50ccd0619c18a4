#pragma once

#include <iosfwd>

#include "clackers/report/write.hpp"
#include "clackers/study/check_record.hpp"

namespace clackers::report {

/// For a person, at most style.width characters a line.
void write_check_table(const study::CheckRecord& record, std::ostream& out, const Style& style);

}  // namespace clackers::report
