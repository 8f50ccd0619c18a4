#pragma once

#include <cstddef>
#include <string_view>

namespace clackers::exact {

/// Returns `value`, or throws InputError unless it is a whole number within [lowest, highest]; the
/// reasons complete the messages for a number that is none (not-whole) and one outside.
double require_whole(std::string_view who, std::string_view name, double value, double lowest,
                     double highest, std::string_view reason = {});

/// The memory that an ImpactProblem of n masses and as many contacts takes: three matrices and a row
/// for each contact.
inline constexpr double largest_problem = 0x1p30;  ///< [byte]
double problem_bytes(double masses, double contacts);

/// Throws InputError (out-of-range), with the size, unless such a problem takes at most
/// largest_problem. `name` = `value` is the parameter that decides.
void require_problem_fits(std::string_view who, std::string_view name, double value, double masses,
                          double contacts);

/// Returns X, an odd whole number up to largest_ratio; throws InputError, also for 1 over an odd
/// number, with the hint `instead`.
double require_odd(std::string_view who, double X, std::string_view instead);

}  // namespace clackers::exact
