#pragma once

#include <string>

#include "clackers/study/check_record.hpp"

namespace clackers::report {

/// The record as json of the schema clackers/check/1. Numbers read back to the same double; what was
/// not measured is the text "nan", infinities are "inf" and "-inf", since json has no such numbers.
std::string check_json(const study::CheckRecord& record);

}  // namespace clackers::report
