#pragma once

#include <cstddef>
#include <string>
#include <string_view>

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

/// `text` with spaces before or behind it, `width` characters in all.
std::string pad(std::string_view text, std::size_t width, bool to_the_right);

/// valid_utf8() as XML 1.0 can hold it: U+FFFD also for control characters and the two code points that
/// it excludes.
std::string xml_text(std::string_view text);

}  // namespace clackers::report
