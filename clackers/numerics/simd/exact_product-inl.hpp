// Error-free sums and products of vectors, and products with constants of more than 53 bits.
// Compiled once for every target, hence no `#pragma once`.
#include <hwy/highway.h>

#include "clackers/numerics/simd/factor.hpp"
#include "clackers/numerics/simd/vector-inl.hpp"

#if defined(CLACKERS_SIMD_EXACT_PRODUCT) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_SIMD_EXACT_PRODUCT
#undef CLACKERS_SIMD_EXACT_PRODUCT
#else
#define CLACKERS_SIMD_EXACT_PRODUCT
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::numerics::simd::HWY_NAMESPACE {

/// The unevaluated sum hi + lo.
struct Pair {
  Vector hi, lo;
};

/// a + b without error, for |a| >= |b|, a = 0, or a a multiple of the last bit of b.
HWY_INLINE Pair quick_two_sum(Vector a, Vector b) {
  const Vector sum = Add(a, b);
  return {sum, Sub(b, Sub(sum, a))};
}

/// a + b without error.
HWY_INLINE Pair two_sum(Vector a, Vector b) {
  const Vector sum = Add(a, b);
  const Vector b_seen = Sub(sum, a);
  return {sum, Add(Sub(a, Sub(sum, b_seen)), Sub(b, b_seen))};
}

#if !HWY_NATIVE_FMA
/// x cut into 26 and 27 bits.
HWY_INLINE Pair cut(Vector x) {
  const Vector head = And(x, hn::BitCast(Doubles(), hn::Set(Words(), ~((1ull << 27) - 1))));
  return {head, Sub(x, head)};
}
#endif

/// A vector that is multiplied by several factors: without FMA its halves are kept.
struct Multiplicand {
  Vector x;
#if !HWY_NATIVE_FMA
  Pair halves;
#endif
};

HWY_INLINE Multiplicand multiplicand(Vector x) {
#if HWY_NATIVE_FMA
  return {x};
#else
  return {x, cut(x)};
#endif
}

/// f.hi * x without error (T. J. Dekker, Numer. Math. 18, 224-242 (1971) without FMA).
HWY_INLINE Pair two_product(const Factor& f, const Multiplicand& m) {
  const Vector a = constant(f.hi);
  const Vector product = Mul(a, m.x);
#if HWY_NATIVE_FMA
  return {product, MulSub(a, m.x, product)};
#else
  const Vector head = constant(f.head), tail = constant(f.tail);
  const Vector most = Sub(Mul(head, m.halves.hi), product);
  const Vector more = Add(Add(most, Mul(head, m.halves.lo)), Mul(tail, m.halves.hi));
  return {product, Add(more, Mul(tail, m.halves.lo))};
#endif
}

/// a * b without error.
HWY_INLINE Pair two_product(Vector a, Vector b) {
  const Vector product = Mul(a, b);
#if HWY_NATIVE_FMA
  return {product, MulSub(a, b, product)};
#else
  const auto p = cut(a), q = cut(b);
  // Halves of 27 bits on both sides would lose a bit: the last product is below 2^-104 of the
  // whole, and so is its rounding.
  const Vector more = Add(Add(Sub(Mul(p.hi, q.hi), product), Mul(p.hi, q.lo)), Mul(p.lo, q.hi));
  return {product, Add(more, Mul(p.lo, q.lo))};
#endif
}

/// x y of double-double numbers, relative error below 2^-102.
HWY_INLINE Pair multiply(const Pair& x, const Pair& y) {
  const auto product = two_product(x.hi, y.hi);
  return quick_two_sum(product.hi, Add(product.lo, MulAdd(x.hi, y.lo, Mul(x.lo, y.hi))));
}

/// a b + c d of double-double numbers, error below 2^-102 (|a b| + |c d|).
HWY_INLINE Pair dot(const Pair& a, const Pair& b, const Pair& c, const Pair& e) {
  const auto p = two_product(a.hi, b.hi), q = two_product(c.hi, e.hi);
  const auto sum = two_sum(p.hi, q.hi);
  const Vector cross =
      Add(MulAdd(a.hi, b.lo, Mul(a.lo, b.hi)), MulAdd(c.hi, e.lo, Mul(c.lo, e.hi)));
  return quick_two_sum(sum.hi, Add(sum.lo, Add(Add(p.lo, q.lo), cross)));
}

/// The whole number nearest to x (ties to even), for |x| < 2^51.
HWY_INLINE Vector nearest_whole(Vector x) {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
  const Vector shift = constant(6755399441055744.0);  // 1.5 * 2^52
  return Sub(Add(x, shift), shift);
#else
  return Round(x);
#endif
}

}  // namespace clackers::numerics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
