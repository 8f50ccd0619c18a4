#pragma once

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

}  // namespace clackers
