#pragma once

#include <string>

#include "clackers/study/check_record.hpp"

namespace clackers::report {

/// The most significant digits of any displacement of a history.
int most_digits(const study::CheckedFile& file);

/// The same for a person; "single" where a displacement has no more than single precision.
std::string digits_text(const study::CheckedFile& file);

}  // namespace clackers::report
