#pragma once

#include <span>
#include <string>
#include <string_view>

namespace clackers::cli {

/// `text` broken at spaces so that no line is longer than `width` (a longer word stands alone).
/// Every line but the first begins with `indent` spaces; the first is taken to stand behind as many
/// columns. Line breaks in the text are kept.
std::string wrap(std::string_view text, std::size_t width, std::size_t indent = 0);

/// The arguments as a line that a POSIX shell reads back to the same arguments.
std::string shell_line(std::span<const std::string> arguments);

}  // namespace clackers::cli
