#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "clackers/base/number.hpp"

namespace clackers::report {

/// `text` with spaces before or behind it, `width` characters in all.
std::string pad(std::string_view text, std::size_t width, bool to_the_right);

/// valid_utf8() as XML 1.0 can hold it: U+FFFD also for control characters and the two code points that
/// it excludes.
std::string xml_text(std::string_view text);

}  // namespace clackers::report
