#pragma once

#include <cmath>
#include <type_traits>

#ifdef __FAST_MATH__
#error "-ffast-math removes the rounding errors that double-double numbers are made of"
#endif

namespace clackers::numerics {

/// The unevaluated sum hi + lo of two doubles, |lo| <= ulp(hi)/2: about 106 bits. All functions
/// here assume rounding to nearest and results between 1e-290 and 1e299 in magnitude, or zero;
/// smaller ones lose the low part.
struct DoubleDouble {
  double hi = 0.0, lo = 0.0;
};

/// a + b without error, for |a| >= |b| or a = 0.
constexpr DoubleDouble quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b without error (D. E. Knuth, TAOCP 2, 4.2.2).
constexpr DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_seen = sum - a;
  return {sum, (a - (sum - b_seen)) + (b - b_seen)};
}

/// a * b without error, for |a|, |b| < 2^996 (T. J. Dekker, Numer. Math. 18, 224-242 (1971)).
constexpr DoubleDouble two_product(double a, double b) {
  const double product = a * b;
#ifdef __FP_FAST_FMA
  if (!std::is_constant_evaluated()) return {product, __builtin_fma(a, b, -product)};
#endif
  constexpr double split = 134217729.0;  // 2^27 + 1: halves of 26 bits, whose products are exact
  const double big_a = split * a, big_b = split * b;
  const double a_hi = big_a - (big_a - a), a_lo = a - a_hi;
  const double b_hi = big_b - (big_b - b), b_lo = b - b_hi;
  return {product, ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

constexpr DoubleDouble operator-(const DoubleDouble& x) { return {-x.hi, -x.lo}; }

/// Error at most 2^-105 |x + y| for equal signs and at most 2^-104 (|x| + |y|) always.
constexpr DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
  const auto sum = two_sum(x.hi, y.hi);
  return quick_two_sum(sum.hi, sum.lo + (x.lo + y.lo));
}

constexpr DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + -y; }

/// Relative error at most 2^-104 x 2 (the low product is dropped, two sums are rounded).
constexpr DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
  const auto product = two_product(x.hi, y.hi);
  return quick_two_sum(product.hi, product.lo + (x.hi * y.lo + x.lo * y.hi));
}

constexpr DoubleDouble operator*(const DoubleDouble& x, double y) {
  const auto product = two_product(x.hi, y);
  return quick_two_sum(product.hi, product.lo + x.lo * y);
}

/// Relative error at most 2^-100.
constexpr DoubleDouble operator/(const DoubleDouble& x, const DoubleDouble& y) {
  const double first = x.hi / y.hi;
  return quick_two_sum(first, (x - y * first).hi / y.hi);
}

/// Relative error at most 2^-100, of x >= 0.
inline DoubleDouble sqrt(const DoubleDouble& x) {
  if (x.hi == 0.0) return {};
  const double first = std::sqrt(x.hi);
  return quick_two_sum(first, (x - two_product(first, first)).hi / (2.0 * first));
}

/// The whole number nearest to x (ties to even), for |x| < 2^51. A library call would cost as
/// much as the rest of an evaluation.
constexpr double nearest_whole(double x) {
  constexpr double shift = 6755399441055744.0;  // 1.5 * 2^52, where doubles are the whole numbers
  return (x + shift) - shift;
}

}  // namespace clackers::numerics
