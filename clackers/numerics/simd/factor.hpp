#pragma once

#include "clackers/numerics/double_double.hpp"

namespace clackers::numerics::simd {

/// A constant hi + lo that vectors are multiplied by, with hi = head + tail in halves of at most
/// 26 bits each for processors without FMA.
struct Factor {
  double hi = 0.0, lo = 0.0;
  double head = 0.0, tail = 0.0;

  constexpr Factor() = default;
  /// |x| < 2^996.
  constexpr explicit Factor(const DoubleDouble& x) : hi(x.hi), lo(x.lo) {
    constexpr double split = 134217729.0;  // 2^27 + 1
    const double big = split * hi;
    head = big - (big - hi);
    tail = hi - head;
  }
  constexpr explicit Factor(double x) : Factor(DoubleDouble{x, 0.0}) {}
};

}  // namespace clackers::numerics::simd
