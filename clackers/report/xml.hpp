#pragma once

#include <string>
#include <string_view>

namespace clackers::report {

/// Text as xml text, in UTF-8. What xml 1.0 cannot hold (control characters, broken UTF-8) becomes
/// U+FFFD.
std::string xml_text(std::string_view text);

/// ` name="value"`, escaped, with the space before it. Line ends and tabs survive, which xml would
/// read as spaces.
std::string xml_attribute(std::string_view name, std::string_view value);

}  // namespace clackers::report
