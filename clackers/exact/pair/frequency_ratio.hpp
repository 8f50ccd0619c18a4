#pragma once

#include <string_view>

namespace clackers::exact {

/// The ratio X of the damped frequencies of mass 2 and mass 1: an odd whole number, or 1 over one
/// when the roles are exchanged and mass 1 is the fast one.
struct FrequencyRatio {
  double odd = 1.0;        ///< fast over slow: 1, 3, 5, ...
  bool exchanged = false;  ///< true: X = 1/odd, for odd >= 3
};

/// The largest odd ratio that is taken. The reduced phase of the fast mass is then known to 2^-70.
inline constexpr double largest_ratio = 1e9;

/// Reads X: an odd whole number from 1 to largest_ratio, or the double nearest to 1 over one.
/// Throws InputError, naming the nearest odd numbers.
FrequencyRatio frequency_ratio(std::string_view who, double X);

/// s = sin(X pi/2) = (-1)^((X-1)/2) of an odd whole number.
double quarter_sine(double odd);

}  // namespace clackers::exact
