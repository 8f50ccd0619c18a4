// The state of a pair at vectors of times. Compiled once for every target.
#include <hwy/highway.h>

#include "clackers/exact/batch_constants.hpp"
#include "clackers/numerics/simd/half_turns-inl.hpp"
#include "clackers/numerics/simd/power_of_two-inl.hpp"

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

/// Displacements and velocities of the slow mass (0) and of the fast one (1).
template <int n>
struct States {
  Vectors<n> u[2], v[2];
};

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

/// theta / pi and multiple theta / pi, and E as hi + lo, of n vectors of times.
template <int n>
struct Start {
  Vectors<n> phase;  ///< theta / pi in double precision
  Vectors<2 * n> y, y_low;
  Vectors<n> w, w_low;  ///< -log2 E, later E
};

template <class Kind, int n>
HWY_INLINE void start(const BatchConstants& c, const Times (&time)[n], Start<n>& s) {
  for (int i = 0; i < n; ++i) {
    Vector k;
    const auto slow = phase_at<Kind>(c, time[i], k);
    s.phase[i] = s.y[i] = slow.hi;
    s.y_low[i] = slow.lo;
    const auto w = halvings<Kind>(c, time[i], k);
    s.w[i] = w.hi;
    s.w_low[i] = w.lo;
  }
  for (int i = 0; i < n; ++i) {
    const auto fast = simd::two_product(c.multiple, simd::multiplicand(s.y[i]));
    s.y[n + i] = fast.hi;
    s.y_low[n + i] = MulAdd(constant(c.multiple.hi), s.y_low[i], fast.lo);
  }
}

/// E = 2^(-w - w_low) for w < 1000.
template <int n>
HWY_INLINE void raise(Start<n>& s) {
  Vectors<n> shifted, r, r_low, scale;
  for (int i = 0; i < n; ++i) {
    shifted[i] = Sub(constant(whole_shift), s.w[i]);
    // -w - w_low = r + r_low less a whole number, |r| <= 1/2.
    const Vector part = Sub(Sub(constant(whole_shift), shifted[i]), s.w[i]);
    r[i] = Sub(part, s.w_low[i]);
    r_low[i] = Sub(Sub(part, r[i]), s.w_low[i]);
    scale[i] = simd::whole_power_of_two(BitCast(simd::Words(), shifted[i]));
  }
  simd::power_of_two<n>(r, r_low, s.w, s.w_low);
  for (int i = 0; i < n; ++i) s.w[i] = Mul(s.w[i], scale[i]);
  for (int i = 0; i < n; ++i) s.w_low[i] = Mul(s.w_low[i], scale[i]);
}

/// u and v of one mass per unit of E.
HWY_INLINE void per_unit(const BatchMass& mass, Vector sine, Vector cosine, Vector& u, Vector& v) {
  u = MulAdd(constant(mass.b.hi), cosine, Mul(constant(mass.b.lo), cosine));
  // The low parts first, then what is the smaller term for light damping.
  const Vector low = MulAdd(constant(mass.v_sin.lo), sine, Mul(constant(mass.v_cos.lo), cosine));
  v = MulAdd(constant(mass.v_sin.hi), sine, MulAdd(constant(mass.v_cos.hi), cosine, low));
}

/// States per unit of E from the phases.
template <int n>
HWY_INLINE void swing(const BatchConstants& c, const Start<n>& s, States<n>& out) {
  Vectors<2 * n> shifted, z, z_low, sine, cosine;
  for (int i = 0; i < 2 * n; ++i) {
    shifted[i] = Add(s.y[i], constant(0.5 * whole_shift));
    // Exact: the nearest half and y are multiples of the last bit of y, and close.
    const Vector rest = Sub(s.y[i], Sub(shifted[i], constant(0.5 * whole_shift)));
    const auto normal = simd::quick_two_sum(rest, s.y_low[i]);
    z[i] = normal.hi;
    z_low[i] = normal.lo;
  }
  simd::sine_cosine_of_quarter<2 * n>(z, z_low, sine, cosine);
  for (int i = 0; i < 2 * n; ++i) simd::turn_by_quarters(shifted[i], sine[i], cosine[i]);
  for (int i = 0; i < n; ++i) per_unit(c.slow, sine[i], cosine[i], out.u[0][i], out.v[0][i]);
  for (int i = 0; i < n; ++i)
    per_unit(c.fast, sine[n + i], cosine[n + i], out.u[1][i], out.v[1][i]);
}

HWY_INLINE Vector product(Vector hi, Vector lo, Vector x) { return MulAdd(hi, x, Mul(lo, x)); }

/// Each component at most 1.6 units of 2^-52 of its envelope from the truth, if E > 2^-1000.
/// `phase` becomes theta / pi.
template <class Kind, int n>
HWY_INLINE void states_at(const BatchConstants& c, const Times (&time)[n], States<n>& out,
                          Vectors<n>& phase) {
  Start<n> s;
  start<Kind, n>(c, time, s);
  raise<n>(s);
  swing<n>(c, s, out);
  for (int i = 0; i < n; ++i) phase[i] = s.phase[i];
  for (int m = 0; m < 2; ++m)
    for (int i = 0; i < n; ++i) {
      out.u[m][i] = product(s.w[i], s.w_low[i], out.u[m][i]);
      out.v[m][i] = product(s.w[i], s.w_low[i], out.v[m][i]);
    }
}

/// The same for any E.
template <class Kind>
HWY_INLINE void deep_states_at(const BatchConstants& c, const Times& time, States<1>& out,
                               Vector& phase) {
  Start<1> s;
  start<Kind, 1>(c, {time}, s);
  swing<1>(c, s, out);
  phase = s.phase[0];
  // Below 2^-4080 every product with a constant is nearer to 0 than to the smallest subnormal.
  const Vector w = Min(s.w[0], constant(4080.0));
  const Vector back = simd::nearest_whole(w), part = Sub(back, w);
  // There the low part may be any number.
  const Vector low = IfThenElse(Lt(s.w[0], constant(4080.0)), s.w_low[0], constant(0.0));
  const Vectors<1> r = {Sub(part, low)}, r_low = {Sub(Sub(part, r[0]), low)};
  Vectors<1> e, e_low;
  simd::power_of_two<1>(r, r_low, e, e_low);
  // 2^-back in four normal factors, applied to the results: with the significand alone the first
  // ones could leave the normal numbers before a large constant has had its say.
  const Vector fourth = simd::nearest_whole(Mul(back, constant(-0.25)));
  const Vector last = Sub(Mul(constant(-3.0), fourth), back);
  const auto whole_power = [](Vector x) HWY_ATTR {
    return simd::whole_power_of_two(BitCast(simd::Words(), Add(x, constant(whole_shift))));
  };
  const Vector f = whole_power(fourth), g = whole_power(last);
  for (int m = 0; m < 2; ++m)
    for (Vector* x : {&out.u[m][0], &out.v[m][0]})
      *x = Mul(Mul(Mul(Mul(product(e[0], e_low[0], *x), f), f), f), g);
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
