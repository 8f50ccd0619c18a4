#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clackers {

/// The text as it may go to a terminal or into a message: control characters (C0, DEL, C1, line
/// separators, marks of direction) and bytes that are no UTF-8 become "\xNN", a byte each. Names of
/// files and columns come from others and could otherwise rewrite the screen (CWE-150).
std::string printable(std::string_view text);

/// A word as a POSIX shell reads it back; without quotes where it needs none, so that it may stand
/// between quotes of a command.
std::string shell_quoted(std::string_view word);
/// The arguments as a line that a POSIX shell reads back to the same arguments.
std::string shell_line(std::span<const std::string> arguments);
/// The arguments of a line that shell_line() wrote.
std::vector<std::string> shell_words(std::string_view line);

/// Characters that a UTF-8 text takes on the terminal, one a code point.
std::size_t display_width(std::string_view text);

/// What wrap() does with a word longer than a line: breaks it, or gives it a line, as a path must
/// have that a person copies.
enum class LongWords { broken, kept };

/// `text` in lines of at most `width` characters: broken at spaces; in a long word behind "+", else
/// behind ":" or ",", else behind one of "_/=-", else anywhere. Newlines stay, and so does a line's
/// indentation; a line such as "Order    2 for gamma = 1/2" goes on below its "2".
std::vector<std::string> wrap(std::string_view text, std::size_t width,
                              LongWords long_words = LongWords::broken);
/// The same with long words kept, and every line but the first behind `indent` spaces; the first is
/// taken to stand behind as many columns.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

/// Prose broken to the width of its source, with the lines of each paragraph joined again. An empty or
/// indented line (a formula), and one such as "Order    2", begin anew; what hangs below the 2 goes on.
std::string rejoin(std::string_view text);

}  // namespace clackers
