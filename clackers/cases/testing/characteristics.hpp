#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace clackers::cases {

/// A bar between stops, or half a plucked string above a point, by its characteristics, in cells of which all gaps are
/// whole multiples. Waves in the speed V of one, lengths in V dt, so that all numbers are whole.
struct Characteristics {
  std::vector<double> right, left;  ///< w+ and w- of each cell
  std::vector<double> u;            ///< change of its middle since the start, times 4
  double low, high;                 ///< gaps of the ends; NaN of one that is held
  double impulse = 0.0, force = 0.0;

  static Characteristics between_stops(int cells, int gap, int both) {
    const std::vector<double> falls(std::size_t(cells), -1.0), zero(falls.size(), 0.0);
    return {falls, falls, zero, double(gap), double(both - gap)};
  }
  /// At rest, inclined by -V/c.
  static Characteristics plucked(int cells, int gap) {
    const std::vector<double> rises(std::size_t(cells), 1.0), falls(rises.size(), -1.0),
        zero(rises.size(), 0.0);
    return {rises, falls, zero, double(gap), NAN};
  }

  void step() {
    const auto w0 = right, w1 = left;
    const double a = left.front(), b = right.back();
    const bool is_held = std::isnan(high);
    // The force of a closed end keeps it from going on.
    const double at_low = low == 0.0 ? std::max(0.0, -a) : 0.0, at_high = is_held ? b
                                                                          : high == 0.0
                                                                              ? std::max(0.0, b)
                                                                              : 0.0;
    low += a + at_low, high -= b - at_high;
    force = at_low + (is_held ? 0.0 : at_high);
    impulse += force;
    right.insert(right.begin(), a + 2.0 * at_low), right.pop_back();
    left.push_back(b - 2.0 * at_high), left.erase(left.begin());
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += w0[i] + w1[i] + right[i] + left[i];
  }
};

}  // namespace clackers::cases
