#pragma once

#include <string>
#include <string_view>

namespace clackers::report {

/// Text as LaTeX text, in UTF-8: nothing in it is a command, a quote or a dash that was not typed.
/// Control characters become spaces.
std::string tex_text(std::string_view text);

/// Text for one line behind "%": no line end, no broken UTF-8.
std::string tex_comment(std::string_view text);

/// "$5.2\cdot 10^{-5}$"; "$0$", "$\infty$", and "--" for NaN, which stands for "not measured".
std::string tex_scientific(double value, int decimals = 1);

/// At most three digits: "$0.05$", or as tex_scientific.
std::string tex_number(double value);

}  // namespace clackers::report
