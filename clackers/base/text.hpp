#pragma once

#include <string>
#include <string_view>

namespace clackers {

/// The text as it may go to a terminal or into a message: control characters (C0, DEL, C1, line
/// separators, marks of direction) and bytes that are no UTF-8 become "\xNN", a byte each. Names of
/// files and columns come from others and could otherwise rewrite the screen (CWE-150).
std::string printable(std::string_view text);

}  // namespace clackers
