// Names for the vectors of a target. Compiled once for every target; functions such as Add, used
// without a namespace in the kernels, are Highway's.
#include <hwy/highway.h>

#if defined(CLACKERS_SIMD_VECTOR) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_SIMD_VECTOR
#undef CLACKERS_SIMD_VECTOR
#else
#define CLACKERS_SIMD_VECTOR
#endif

// Before a loop: GCC would unroll it whole and then keep more values than there are registers.
#ifndef CLACKERS_ROLLED
#if defined(__GNUC__) && !defined(__clang__)
#define CLACKERS_ROLLED _Pragma("GCC unroll 1")
#else
#define CLACKERS_ROLLED
#endif
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::numerics::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Words = hn::RebindToUnsigned<Doubles>;
using Vector = hn::Vec<Doubles>;

// Kernels work on n vectors in step: each line does one thing to all of them, so that a processor
// sees n independent operations in the stretch that it looks ahead (one vector alone leaves half
// of the arithmetic units waiting), and constants are loaded once for all.
template <int n>
using Vectors = Vector[n];

/// All lanes x.
HWY_INLINE Vector constant(double x) { return hn::Set(Doubles(), x); }

/// Two terms of a polynomial, high x + low. Not a lambda in the loops over n: GCC 12 fails on it.
HWY_INLINE Vector terms(double high, Vector x, double low) {
  return MulAdd(constant(high), x, constant(low));
}

}  // namespace clackers::numerics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
