#pragma once

#include <string_view>

namespace clackers::exact {

/// Masses, stiffnesses, amplitudes and mass ratios may span 120 decades. Then no product of them
/// that a motion needs leaves the normal doubles.
inline constexpr double smallest_scale = 1e-60, largest_scale = 1e60;

/// Throws InputError unless smallest <= value <= largest (the limits above unless given).
void require_scale(std::string_view who, std::string_view name, double value,
                   double smallest = smallest_scale, double largest = largest_scale);
/// Throws InputError unless xi1 is 0 or smallest_scale <= xi1 < 1.
void require_damping_ratio(std::string_view who, double xi1);
/// Throws InputError unless 0 <= eta <= 1.
void require_restitution(std::string_view who, double eta);

}  // namespace clackers::exact
