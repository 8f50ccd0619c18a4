#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clackers::report {

/// The shortest text that reads back to the same double; "inf", "-inf", "nan" where there is none.
std::string exact_number(double value);

/// For a person: at most `digits` significant digits, fewer where the text would be longer than
/// `width` characters. One digit with its exponent is the least, so 7 characters are always enough.
std::string short_number(double value, int digits = 6, std::size_t width = 32);

/// For a person who compares columns: one digit before the point and `decimals` after it, as in
/// "1.2e-7". "-" for NaN, which stands for "not measured".
std::string scientific(double value, int decimals = 1);

/// A whole number in at most five characters: 81920, 164k, 5.2M.
std::string short_count(long long value);

/// Characters that a UTF-8 text takes on the terminal, one a code point.
std::size_t display_width(std::string_view text);

/// `text` in lines of at most `width` characters: broken at spaces; in a long word behind "+", else
/// behind ":" or ",", else behind one of "_/=-", else anywhere. Newlines stay, and so does a line's
/// indentation; a line such as "Order    2 for gamma = 1/2" goes on below its "2".
std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// Prose that was broken to the width of its source, with the lines of each paragraph joined again.
/// An empty or indented line (a formula), and one such as "Order    2", begin anew.
std::string rejoin(std::string_view text);

/// `text` with spaces before or behind it, `width` characters in all.
std::string pad(std::string_view text, std::size_t width, bool to_the_right);

/// valid_utf8() as XML 1.0 can hold it: U+FFFD also for control characters and the two code points that
/// it excludes.
std::string xml_text(std::string_view text);

}  // namespace clackers::report
