// Powers of two. Compiled once for every target.
#include <hwy/highway.h>

#include "clackers/numerics/simd/exact_product-inl.hpp"

#if defined(CLACKERS_SIMD_POWER_OF_TWO) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_SIMD_POWER_OF_TWO
#undef CLACKERS_SIMD_POWER_OF_TWO
#else
#define CLACKERS_SIMD_POWER_OF_TWO
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::numerics::simd::HWY_NAMESPACE {

/// 2^r = power + low, |r| <= 1/2, |low| at most half an ulp. Error at most 0.37 units of 2^-52 of the
/// result, 0.55 without FMA: 0.18 for the rounding of what is added to 1, without FMA 0.18 for that
/// of its product, 0.12 for the other terms, 0.07 for the polynomial (tools/polynomials.py), all
/// relative to results from 0.707.
template <int n>
HWY_INLINE void exp2(const Vectors<n>& r, Vectors<n>& power, Vectors<n>& low) {
  Vectors<n> r2, r4, a, b, c;
  for (int i = 0; i < n; ++i) r2[i] = Mul(r[i], r[i]);
  for (int i = 0; i < n; ++i) a[i] = terms(0x1.b524ed5dbbffdp-24, r[i], 0x1.62bfe460aa99cp-20);
  for (int i = 0; i < n; ++i) b[i] = terms(0x1.ffcbfc6c2151fp-17, r[i], 0x1.4309130378684p-13);
  for (int i = 0; i < n; ++i) r4[i] = Mul(r2[i], r2[i]);
  for (int i = 0; i < n; ++i) c[i] = terms(0x1.e9ec0bff910d4p-32, r[i], 0x1.e5e9f62203676p-28);
  for (int i = 0; i < n; ++i) b[i] = MulAdd(a[i], r2[i], b[i]);
  for (int i = 0; i < n; ++i) a[i] = terms(0x1.5d87fe78a472dp-10, r[i], 0x1.3b2ab6fba385fp-7);
  for (int i = 0; i < n; ++i) b[i] = MulAdd(c[i], r4[i], b[i]);
  for (int i = 0; i < n; ++i) c[i] = terms(0x1.c6b08d704a0c3p-5, r[i], 0x1.ebfbdff82c590p-3);
  for (int i = 0; i < n; ++i) c[i] = MulAdd(a[i], r2[i], c[i]);
  for (int i = 0; i < n; ++i) c[i] = MulAdd(b[i], r4[i], c[i]);
  for (int i = 0; i < n; ++i) c[i] = Mul(c[i], r2[i]);
  for (int i = 0; i < n; ++i) c[i] = MulAdd(constant(0.6931471805599453), r[i], c[i]);
  for (int i = 0; i < n; ++i) power[i] = Add(c[i], constant(1.0));
  for (int i = 0; i < n; ++i) low[i] = Sub(c[i], Sub(power[i], constant(1.0)));
}

/// 2^n for -1022 <= n <= 1023; `bits` holds n in its last bits, as it does in n + 1.5 * 2^52.
HWY_INLINE Vector whole_power_of_two(hn::Vec<Words> bits) {
  return BitCast(Doubles(), hn::ShiftLeft<52>(Add(bits, hn::Set(Words(), 1023))));
}

/// 2^n x, n as above, for x > 0 if both are normal numbers; without a multiplication.
HWY_INLINE Vector scale_by_power_of_two(hn::Vec<Words> bits, Vector x) {
  return BitCast(Doubles(), Add(BitCast(Words(), x), hn::ShiftLeft<52>(bits)));
}

}  // namespace clackers::numerics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
