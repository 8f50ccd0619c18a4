#pragma once

#include <span>
#include <string>
#include <string_view>

namespace clackers {

/// Returns `value`, or throws InputError if it is NaN or infinite.
double require_finite(std::string_view who, std::string_view name, double value);
/// Returns `value`, or throws InputError unless 0 < value < infinity.
double require_positive(std::string_view who, std::string_view name, double value);
/// Returns `value`, or throws InputError unless lowest <= value <= highest.
double require_within(std::string_view who, std::string_view name, double value, double lowest,
                      double highest);
/// Returns the step h in seconds, or throws InputError unless 0 < h < infinity.
double require_step(std::string_view who, double h);

/// The known name nearest to a misspelled one: edit distance (insert, delete, replace, swap of
/// neighbours), at most a third of the length plus one. Else the first that begins with it, if it has
/// three letters, or an empty string.
std::string nearest(std::string_view given, std::span<const std::string> known);

/// Throws InputError: `who: no WHAT "given". Did you mean "x"? All names: WHERE_LISTED`.
[[noreturn]] void refuse_name(std::string_view what, std::string_view given,
                              std::span<const std::string> known, std::string_view where_listed);

}  // namespace clackers
