// Phases and decay of a pair at vectors of times. Compiled once for every target.
#include <hwy/highway.h>

#include "clackers/exact/batch/batch_constants.hpp"
#include "clackers/numerics/simd/exact_product-inl.hpp"

#if defined(CLACKERS_BATCH_FLIGHT) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_BATCH_FLIGHT
#undef CLACKERS_BATCH_FLIGHT
#else
#define CLACKERS_BATCH_FLIGHT
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace simd = numerics::simd::HWY_NAMESPACE;

using numerics::simd::Factor;
using simd::constant;
using simd::Doubles;
using simd::Pair;
using simd::Vector;
using simd::Vectors;

/// Times t + low [s].
struct Times {
  simd::Multiplicand t;
  Vector low;
};

/// Adding it rounds to a whole number n, which then stands in the last bits; |x| < 2^51. Half of it
/// rounds to n / 2.
inline constexpr double whole_shift = 0x1.8p52;

/// A kind of motion, for which kernels are compiled apart.
template <bool long_phase_, bool elastic_, bool low_>
struct Kind {
  static constexpr bool long_phase = long_phase_;  ///< see BatchConstants
  static constexpr bool elastic = elastic_;        ///< eta = 1, or 0 before the first collision
  static constexpr bool low = low_;                ///< Times::low is not 0
};

/// theta / pi in [-1/2, 1/2] and the flight k; where |theta / pi| is above
/// BatchConstants::certain k may be wrong by one.
template <class Kind>
HWY_INLINE Pair phase_at(const BatchConstants& c, const Times& time, Vector& k) {
  const auto turns = simd::two_product(c.turns, time.t);
  k = simd::nearest_whole(turns.hi);
  const Vector part = Sub(turns.hi, k);
  if constexpr (Kind::long_phase) {
    const auto middle = simd::two_product(Factor(c.turns.lo), time.t);
    auto more = simd::two_sum(turns.lo, middle.hi);
    more.lo = Add(more.lo, MulAdd(constant(c.turns_lo), time.t.x, middle.lo));
    if constexpr (Kind::low) {
      const auto rest = simd::two_product(c.turns, simd::multiplicand(time.low));
      const auto sum = simd::two_sum(more.hi, rest.hi);
      more = {sum.hi, Add(Add(more.lo, rest.lo), sum.lo)};
    }
    const auto top = simd::two_sum(part, more.hi);
    return simd::quick_two_sum(top.hi, (Add(top.lo, more.lo)));
  } else {
    Vector more = MulAdd(constant(c.turns.lo), time.t.x, turns.lo);
    if constexpr (Kind::low) more = MulAdd(constant(c.turns.hi), time.low, more);
    // The difference is a multiple of the last bit of turns.hi, beside which `more` is small.
    return simd::quick_two_sum(part, more);
  }
}

/// -log2 E = w.hi + w.lo.
template <class Kind>
HWY_INLINE Pair halvings(const BatchConstants& c, const Times& time, Vector k) {
  auto w = simd::two_product(c.decay, time.t);
  w.lo = MulAdd(constant(c.decay.lo), time.t.x, w.lo);
  if constexpr (Kind::low) w.lo = MulAdd(constant(c.decay.hi), time.low, w.lo);
  if constexpr (!Kind::elastic) {
    auto gain = simd::two_product(c.log2_eta, simd::multiplicand(k));
    gain.lo = MulAdd(constant(c.log2_eta.lo), k, gain.lo);
    const auto sum = simd::two_sum(w.hi, (Neg(gain.hi)));
    w = {sum.hi, Add(sum.lo, Sub(w.lo, gain.lo))};
  }
  return w;
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
