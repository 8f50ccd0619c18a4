// double_double.hpp, sincospi.hpp and exp2.hpp for vectors: the same operations in the same order, so
// that every lane holds the bits of the scalar functions. Compiled once for every target, hence no
// `#pragma once`; functions such as Add, used without a namespace, are Highway's.
#include <hwy/highway.h>

#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"

#if defined(CLACKERS_SIMD_DOUBLE_DOUBLE) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_SIMD_DOUBLE_DOUBLE
#undef CLACKERS_SIMD_DOUBLE_DOUBLE
#else
#define CLACKERS_SIMD_DOUBLE_DOUBLE
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::numerics::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Words = hn::RebindToUnsigned<Doubles>;
using Vector = hn::Vec<Doubles>;

/// The unevaluated sum hi + lo.
struct Pair {
  Vector hi, lo;
};

/// All lanes x.
HWY_INLINE Vector constant(double x) { return hn::Set(Doubles(), x); }
HWY_INLINE Pair constant(const DoubleDouble& x) { return {constant(x.hi), constant(x.lo)}; }

HWY_INLINE Pair quick_two_sum(Vector a, Vector b) {
  const Vector sum = Add(a, b);
  return {sum, Sub(b, Sub(sum, a))};
}

HWY_INLINE Pair two_sum(Vector a, Vector b) {
  const Vector sum = Add(a, b);
  const Vector b_seen = Sub(sum, a);
  return {sum, Add(Sub(a, Sub(sum, b_seen)), Sub(b, b_seen))};
}

HWY_INLINE Pair two_product(Vector a, Vector b) {
  const Vector product = Mul(a, b);
#if HWY_NATIVE_FMA
  return {product, MulSub(a, b, product)};
#else
  const Vector split = constant(134217729.0);  // 2^27 + 1
  const Vector big_a = Mul(split, a), big_b = Mul(split, b);
  const Vector a_hi = Sub(big_a, Sub(big_a, a)), a_lo = Sub(a, a_hi);
  const Vector b_hi = Sub(big_b, Sub(big_b, b)), b_lo = Sub(b, b_hi);
  const Vector most = Add(Sub(Mul(a_hi, b_hi), product), Mul(a_hi, b_lo));
  return {product, Add(Add(most, Mul(a_lo, b_hi)), Mul(a_lo, b_lo))};
#endif
}

HWY_INLINE Pair add(const Pair& x, const Pair& y) {
  const auto sum = two_sum(x.hi, y.hi);
  return quick_two_sum(sum.hi, Add(sum.lo, Add(x.lo, y.lo)));
}

HWY_INLINE Pair subtract(const Pair& x, const Pair& y) { return add(x, {Neg(y.hi), Neg(y.lo)}); }

HWY_INLINE Pair multiply(const Pair& x, const Pair& y) {
  const auto product = two_product(x.hi, y.hi);
  return quick_two_sum(product.hi, Add(product.lo, Add(Mul(x.hi, y.lo), Mul(x.lo, y.hi))));
}

HWY_INLINE Pair multiply(const Pair& x, Vector y) {
  const auto product = two_product(x.hi, y);
  return quick_two_sum(product.hi, Add(product.lo, Mul(x.lo, y)));
}

/// Adding it rounds |x| < 2^51 to a whole number, which then stands in the last bits.
inline constexpr double whole_shift = 6755399441055744.0;  // 1.5 * 2^52

HWY_INLINE Vector nearest_whole(Vector x) {
  return Sub(Add(x, constant(whole_shift)), constant(whole_shift));
}

/// (-1)^k for a whole number k.
HWY_INLINE Vector sign_of_power(Vector k) {
  const Vector half = Mul(k, constant(0.5));
  return Sub(constant(1.0), Mul(constant(4.0), Abs(Sub(half, nearest_whole(half)))));
}

/// Entry number (the last bits of `shifted` below 2^bits) of a table, `offset` entries on.
template <int bits>
HWY_INLINE Pair look_up(const DoubleDouble* table, Vector shifted, std::size_t offset) {
  const hn::RebindToSigned<Doubles> whole;
  const auto index = hn::BitCast(whole, hn::ShiftLeft<1>(And(hn::BitCast(Words(), shifted),
                                                             hn::Set(Words(), (1u << bits) - 1))));
  const auto* first = reinterpret_cast<const double*>(table + offset);
  static_assert(sizeof(DoubleDouble) == 2 * sizeof(double));
  return {hn::GatherIndex(Doubles(), first, index), hn::GatherIndex(Doubles(), first + 1, index)};
}

HWY_INLINE void sincospi(const Pair& y, Pair& sine_of, Pair& cosine_of) {
  const Vector shifted = Add(Mul(y.hi, constant(128.0)), constant(whole_shift));
  const Vector nearest = Sub(shifted, constant(whole_shift));
  const auto s = look_up<8>(detail::sine_table.data(), shifted, 0);
  const auto c = look_up<8>(detail::sine_table.data(), shifted, 64);
  const auto z =
      multiply(quick_two_sum(Sub(y.hi, Mul(nearest, constant(0.0078125))), y.lo), constant(pi));
  const Vector zz = Mul(z.hi, z.hi);
  const auto next = [zz](Vector x, double low) HWY_ATTR { return Add(constant(low), Mul(zz, x)); };
  const Vector sine_rest =
      Add(z.lo, Mul(Mul(z.hi, zz), next(next(constant(-1.0 / 5040), 1.0 / 120), -1.0 / 6)));
  const Vector cosine_rest = Mul(zz, next(next(constant(-1.0 / 720), 1.0 / 24), -0.5));
  const auto cz = two_product(c.hi, z.hi), sz = two_product(s.hi, z.hi);
  const auto sine = two_sum(s.hi, cz.hi), cosine = two_sum(c.hi, Neg(sz.hi));
  const Vector sine_low = Add(Add(Add(s.lo, cz.lo), Mul(c.lo, z.hi)),
                              Add(Mul(c.hi, sine_rest), Mul(s.hi, cosine_rest)));
  const Vector cosine_low = Add(Sub(Sub(c.lo, sz.lo), Mul(s.lo, z.hi)),
                                Sub(Mul(c.hi, cosine_rest), Mul(s.hi, sine_rest)));
  sine_of = quick_two_sum(sine.hi, Add(sine.lo, sine_low));
  cosine_of = quick_two_sum(cosine.hi, Add(cosine.lo, cosine_low));
}

/// 2^x = significand * scale, for |x| <= 1000.
HWY_INLINE Pair exp2(const Pair& x, Vector& scale) {
  const Vector shifted = Add(Mul(x.hi, constant(64.0)), constant(whole_shift));
  const Vector nearest = Sub(shifted, constant(whole_shift));
  const auto head = look_up<6>(detail::power_table.data(), shifted, 0);
  const auto w =
      multiply(quick_two_sum(Sub(x.hi, Mul(nearest, constant(0.015625))), x.lo), constant(ln2));
  const auto next = [&w](Vector sum, double low)
                        HWY_ATTR { return Add(constant(low), Mul(w.hi, sum)); };
  Vector sum = constant(1.0 / 5040);
  for (const double low : {1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6, 1.0 / 2}) sum = next(sum, low);
  const Vector rest = Add(w.lo, Mul(Mul(w.hi, w.hi), sum));
  const auto step = two_product(head.hi, w.hi);
  const auto all = quick_two_sum(head.hi, step.hi);
  const Vector low = Add(Add(Add(head.lo, step.lo), Mul(head.lo, w.hi)), Mul(head.hi, rest));
  // Down to a multiple of 64, over 64.
  const Vector whole =
      Add(Mul(Sub(nearest, constant(31.5)), constant(0.015625)), constant(whole_shift));
  scale = hn::BitCast(Doubles(),
                      hn::ShiftLeft<52>(Add(hn::BitCast(Words(), whole), hn::Set(Words(), 1023))));
  return quick_two_sum(all.hi, Add(all.lo, low));
}

}  // namespace clackers::numerics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
