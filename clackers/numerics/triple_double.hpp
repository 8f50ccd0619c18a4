#pragma once

#include "clackers/numerics/double_double.hpp"

namespace clackers::numerics {

/// The unevaluated sum of three doubles in falling magnitude: about 159 bits. For constants that
/// are multiplied by long times.
struct TripleDouble {
  double hi = 0.0, mid = 0.0, lo = 0.0;
};

/// x * y with relative error below 2^-150, for products between 1e-250 and 1e299 or zero; each
/// part is at most an ulp of the one before it.
constexpr TripleDouble operator*(const TripleDouble& x, double y) {
  const auto first = two_product(x.hi, y);
  const auto second = two_product(x.mid, y);
  const auto middle = two_sum(first.lo, second.hi);
  // middle.lo <= 2^-106 of the product, second.lo and x.lo * y too, so rounding these sums costs
  // less than 2^-156 of it.
  const double rest = middle.lo + (second.lo + x.lo * y);
  const auto top = quick_two_sum(first.hi, middle.hi);
  const auto low = two_sum(top.lo, rest);
  const auto head = quick_two_sum(top.hi, low.hi);
  return {head.hi, head.lo, low.lo};
}

/// A real number seen from the doubles: the nearest one, and on which side of it the number lies.
struct Neighbour {
  double nearest = 0.0;
  double beyond = 0.0;  ///< the number minus `nearest`, to a few digits
};

/// `x` as the product above returns it, so that mid is at most half an ulp of hi.
constexpr Neighbour nearest_double(const TripleDouble& x) {
  // Half way between two doubles (hi and hi + 2 mid) only the last part decides.
  const auto next = two_sum(x.hi, 2.0 * x.mid);
  if (x.mid != 0.0 && next.lo == 0.0 && x.lo * x.mid > 0.0) return {next.hi, x.lo - x.mid};
  return {x.hi, x.mid + x.lo};
}

}  // namespace clackers::numerics
