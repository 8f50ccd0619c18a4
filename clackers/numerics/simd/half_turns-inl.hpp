// Sine and cosine of a reduced count of half turns. Compiled once for every target.
#include <hwy/highway.h>

#include "clackers/numerics/simd/exact_product-inl.hpp"

#if defined(CLACKERS_SIMD_HALF_TURNS) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_SIMD_HALF_TURNS
#undef CLACKERS_SIMD_HALF_TURNS
#else
#define CLACKERS_SIMD_HALF_TURNS
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::numerics::simd::HWY_NAMESPACE {

inline constexpr double pi = 3.141592653589793, pi_low = 1.2246467991473532e-16;
// In 26 bits, and what is left.
inline constexpr double pi_head = 0x1.921fb5p+1, pi_tail = (pi - pi_head) + pi_low;

/// Sine of pi z, and its cosine less 1, for |z| <= 1/4. The polynomials are those of
/// tools/polynomials.py. Errors in units of 2^-52: sine at most 0.4 (1/4 rounding of the result, 0.1
/// of the tail, 0.007 polynomial), cosine at most 0.3 (1/8 result, 1/8 polynomial's value, 0.05
/// square).
template <int n>
HWY_INLINE void sine_cosine_of_quarter(const Vectors<n>& z, Vectors<n>& sine,
                                       Vectors<n>& cosine_less_one) {
  Vectors<n> x, x2, s, c, next;
  for (int i = 0; i < n; ++i) x[i] = Mul(z[i], z[i]);
  for (int i = 0; i < n; ++i) x2[i] = Mul(x[i], x[i]);
  // Pairs of terms, so that the chains are short.
  for (int i = 0; i < n; ++i) s[i] = terms(0x1.e3c4e5bfebaa9p-12, x[i], -0x1.e2ffe293c193dp-8);
  for (int i = 0; i < n; ++i) next[i] = terms(0x1.50782f35505d8p-4, x[i], -0x1.32d2cce2380e7p-1);
  for (int i = 0; i < n; ++i) s[i] = MulAdd(s[i], x2[i], next[i]);
  for (int i = 0; i < n; ++i) next[i] = terms(0x1.466bc67757e00p+1, x[i], -0x1.4abbce625be3cp+2);
  for (int i = 0; i < n; ++i) c[i] = terms(-0x1.afee49aac6a0bp-14, x[i], 0x1.f9c3d3ca71cf2p-10);
  for (int i = 0; i < n; ++i) s[i] = MulAdd(s[i], x2[i], next[i]);
  for (int i = 0; i < n; ++i) next[i] = terms(-0x1.a6d1e138ce9d6p-6, x[i], 0x1.e1f506749a42fp-3);
  for (int i = 0; i < n; ++i) c[i] = MulAdd(c[i], x2[i], next[i]);
  for (int i = 0; i < n; ++i) next[i] = terms(-0x1.55d3c7e3bf5abp+0, x[i], 0x1.03c1f081b5a4fp+2);
  for (int i = 0; i < n; ++i) c[i] = MulAdd(c[i], x2[i], next[i]);
  for (int i = 0; i < n; ++i) c[i] = MulAdd(c[i], x[i], constant(-0x1.3bd3cc9be45dep+2));
#if HWY_NATIVE_FMA
  for (int i = 0; i < n; ++i) s[i] = MulAdd(s[i], x[i], constant(pi_low));
  for (int i = 0; i < n; ++i) s[i] = Mul(s[i], z[i]);
  for (int i = 0; i < n; ++i) sine[i] = MulAdd(constant(pi), z[i], s[i]);
#else
  // pi in 26 bits and the rest; the first product is exact.
  for (int i = 0; i < n; ++i) s[i] = MulAdd(s[i], x[i], constant(pi_tail));
  for (int i = 0; i < n; ++i) s[i] = Mul(s[i], z[i]);
  for (int i = 0; i < n; ++i) {
    const auto halves = cut(z[i]);
    sine[i] = MulAdd(constant(pi_head), halves.hi, MulAdd(constant(pi_head), halves.lo, s[i]));
  }
#endif
  for (int i = 0; i < n; ++i) cosine_less_one[i] = Mul(c[i], x[i]);
}

/// The sine and cosine of pi (m / 2 + z) from those of pi z, but with the wrong signs if m is 2 or 3
/// more than a multiple of 4 (see half_turn_sign). `shifted` holds the whole number m in its last
/// bits, as m + 1.5 * 2^52 does.
HWY_INLINE void turn_by_quarters(Vector shifted, Vector& sine, Vector& cosine) {
  const Doubles d;
  const auto odd = hn::ShiftLeft<63>(BitCast(Words(), shifted));
  const Vector sign = BitCast(d, odd);
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
  // There a choice by sign compares with 0, and -0 is not negative.
  const auto swap = BitCast(d, BroadcastSignBit(BitCast(hn::RebindToSigned<Doubles>(), odd)));
  const Vector s = IfVecThenElse(swap, cosine, sine);
  const Vector c = IfVecThenElse(swap, sine, cosine);
#else
  const Vector s = IfNegativeThenElse(sign, cosine, sine);
  const Vector c = IfNegativeThenElse(sign, sine, cosine);
#endif
  sine = s;
  cosine = Xor(c, sign);
}

/// x, or -x if m of turn_by_quarters is 2 or 3 more than a multiple of 4.
HWY_INLINE Vector half_turn_sign(Vector shifted, Vector x) {
  const auto half = hn::ShiftLeft<62>(BitCast(Words(), shifted));
  return Xor(x, BitCast(Doubles(), And(half, hn::Set(Words(), 1ull << 63))));
}

}  // namespace clackers::numerics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
