#pragma once

#include <string>
#include <string_view>

namespace clackers::cli {

/// One line on standard error, for a person.
void note(const std::string& text);

/// "clackers: message [code]" on standard error, broken at its width if that is a terminal.
void complain(std::string_view message, std::string_view code);

}  // namespace clackers::cli
