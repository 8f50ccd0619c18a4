#pragma once

#include <string>
#include <string_view>

namespace clackers::report {

/// The text with U+FFFD for every byte that belongs to no character of UTF-8.
std::string valid_utf8(std::string_view text);

}  // namespace clackers::report
