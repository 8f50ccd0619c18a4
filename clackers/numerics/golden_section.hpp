#pragma once

#include <utility>

namespace clackers::numerics {

struct Minimum {
  double x = 0.0, value = 0.0;
};

/// The smallest value found of a function with one minimum in [low, high], an interval that each
/// step shortens to 0.618 of itself. Values are compared by <.
Minimum golden_section(double low, double high, int steps, const auto& function) {
  constexpr double golden = 0.6180339887498949;
  const auto at = [&](double x) { return Minimum{x, function(x)}; };
  auto left = at(high - golden * (high - low)), right = at(low + golden * (high - low));
  for (int i = 0; i < steps; ++i) {
    if (left.value < right.value) {
      high = std::exchange(right, left).x;
      left = at(high - golden * (high - low));
    } else {
      low = std::exchange(left, right).x;
      right = at(low + golden * (high - low));
    }
  }
  return left.value < right.value ? left : right;
}

}  // namespace clackers::numerics
