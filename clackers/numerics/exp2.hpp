#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "clackers/numerics/double_double.hpp"

namespace clackers::numerics {

/// significand * 2^exponent, 1/2 <= significand < 3: a range that no decay leaves.
struct Scaled {
  DoubleDouble significand;
  int exponent = 0;
};

namespace detail {
/// 2^(i/64) for i = 0, ..., 63.
extern const std::array<DoubleDouble, 64> power_table;
}  // namespace detail

inline constexpr DoubleDouble ln2{0.693147180559945286, 2.319046813846299558e-17};

/// 2^x for |x| < 2^24. Relative error at most 2^-66.
inline Scaled exp2(const DoubleDouble& x) {
  const double nearest = nearest_whole(x.hi * 64.0);
  const auto whole = static_cast<int>(nearest);
  const DoubleDouble head = detail::power_table[static_cast<std::size_t>(whole & 63)];
  const auto w = quick_two_sum(x.hi - nearest * 0.015625, x.lo) * ln2;

  // |w| <= ln 2 / 128. The first term left out is w^8/8! < 2^-75; the square is rounded to
  // 2^-53 w^2/2 < 2^-69.
  const double rest =
      w.lo + w.hi * w.hi *
                 (1.0 / 2 +
                  w.hi * (1.0 / 6 +
                          w.hi * (1.0 / 24 +
                                  w.hi * (1.0 / 120 + w.hi * (1.0 / 720 + w.hi * (1.0 / 5040))))));
  const auto step = two_product(head.hi, w.hi);
  const auto sum = quick_two_sum(head.hi, step.hi);
  return {quick_two_sum(sum.hi, sum.lo + (head.lo + step.lo + head.lo * w.hi + head.hi * rest)),
          whole >> 6};
}

/// x * 2^exponent rounded once, into the subnormal range too: x should be normal or zero.
inline double scale(double x, int exponent) {
  if (exponent < -1022 || exponent > 1023) return std::ldexp(x, exponent);
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// 2^x rounded to a double, 0 where it is below all of them; x < 1024.
inline double exp2_rounded(const DoubleDouble& x) {
  if (x.hi < -1100.0) return 0.0;
  const auto [significand, exponent] = exp2(x);
  return scale(significand.hi, exponent);
}

}  // namespace clackers::numerics
