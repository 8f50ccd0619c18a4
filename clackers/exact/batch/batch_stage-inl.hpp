// The states of a pair at vectors of times, in two steps. Compiled once for every target.
#include <hwy/highway.h>

#include <cstddef>

#include "clackers/exact/batch/batch_flight-inl.hpp"
#include "clackers/numerics/simd/half_turns-inl.hpp"
#include "clackers/numerics/simd/exp2-inl.hpp"

#if defined(CLACKERS_BATCH_STAGE) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_BATCH_STAGE
#undef CLACKERS_BATCH_STAGE
#else
#define CLACKERS_BATCH_STAGE
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {

// Each step is a loop of its own over many samples: a processor looks only so many operations ahead,
// and with short steps these belong to several samples and do not wait for each other. What one step
// hands to the next lies in the cache.

inline constexpr std::size_t stage_size = 256;
/// How many vectors a loop does in step (see Vectors): of two doubles, four are faster than two.
inline constexpr int in_step = hn::MaxLanes(Doubles()) < 4 ? 4 : 2;

/// Samples between the two steps.
struct Stage {
  HWY_ALIGN double z[2][stage_size];         ///< phases of the slow and fast mass less quarters
  HWY_ALIGN double quarters[2][stage_size];  ///< of a turn, their number in the last bits
  HWY_ALIGN double e[stage_size];            ///< E
#if !HWY_NATIVE_FMA
  HWY_ALIGN double e_low[stage_size];  ///< and what its rounding left: products are rounded there
#endif
};

/// Parts a phase into quarters of a turn and a rest |z| <= 1/4 [half turns], which is rounded: 0.2
/// units of 2^-52 in sine and cosine.
HWY_INLINE void part_quarters(const Pair& phase, Stage& stage, int mass, std::size_t at) {
  const Doubles d;
  const Vector shifted = Add(phase.hi, constant(0.5 * whole_shift));
  // Exact: the nearest half and the phase are multiples of its last bit, and close.
  const Vector rest = Sub(phase.hi, Sub(shifted, constant(0.5 * whole_shift)));
  hn::Store(Add(rest, phase.lo), d, stage.z[mass] + at);
  hn::Store(shifted, d, stage.quarters[mass] + at);
}

/// theta / pi and multiple theta / pi into the stage; theta / pi, too, into `phase`.
template <class Kind, int n>
HWY_INLINE void start_phases(const BatchConstants& c, const Times (&time)[n], Stage& stage,
                             std::size_t at, Vectors<n>& phase, Vectors<n>& k) {
  const std::size_t lanes = hn::Lanes(Doubles());
  Vectors<n> low;
  for (int i = 0; i < n; ++i) {
    const auto slow = phase_at<Kind>(c, time[i], k[i]);
    part_quarters(slow, stage, 0, at + std::size_t(i) * lanes);
    phase[i] = slow.hi;
    low[i] = slow.lo;
  }
  for (int i = 0; i < n; ++i) {
    auto fast = simd::two_product(c.multiple, simd::multiplicand(phase[i]));
    fast.lo = MulAdd(constant(c.multiple.hi), low[i], fast.lo);
    part_quarters(fast, stage, 1, at + std::size_t(i) * lanes);
  }
}

/// The first step, if E > 2^-1000. `phase` becomes theta / pi.
template <class Kind, int n>
HWY_INLINE void start(const BatchConstants& c, const Times (&time)[n], Stage& stage, std::size_t at,
                      Vectors<n>& phase) {
  const Doubles d;
  Vectors<n> k, shifted, r, e, low;
  start_phases<Kind, n>(c, time, stage, at, phase, k);
  for (int i = 0; i < n; ++i) {
    const auto w = halvings<Kind>(c, time[i], k[i]);
    shifted[i] = Sub(constant(whole_shift), w.hi);
    // -log2 E less a whole number.
    r[i] = Sub(Sub(Sub(constant(whole_shift), shifted[i]), w.hi), w.lo);
  }
  simd::exp2<n>(r, e, low);
  for (int i = 0; i < n; ++i) {
    const auto bits = BitCast(simd::Words(), shifted[i]);
    const std::size_t to = at + std::size_t(i) * hn::Lanes(d);
    hn::Store(simd::scale_by_power_of_two(bits, e[i]), d, stage.e + to);
#if !HWY_NATIVE_FMA
    hn::Store(Mul(simd::whole_power_of_two(bits), low[i]), d, stage.e_low + to);
#endif
  }
}

/// The first step for one vector and any E: in the stage is only its significand. The results are to
/// be multiplied by `scale`, which is 2^-back in four normal factors: with the significand alone
/// the first ones could leave the normal numbers before a large constant has had its say.
template <class Kind>
HWY_INLINE void start_deep(const BatchConstants& c, const Times& time, Stage& stage, std::size_t at,
                           Vector& phase, Vectors<2>& scale) {
  const Doubles d;
  Vectors<1> k, y;
  start_phases<Kind, 1>(c, {time}, stage, at, y, k);
  phase = y[0];
  const auto full = halvings<Kind>(c, time, k[0]);
  // Below 2^-4080 every product with a constant is nearer to 0 than to the smallest subnormal, and
  // all that matters is that r stays finite: w is below 2^80 in a motion of 2^50 half periods.
  const Vector w = Min(full.hi, constant(4080.0));
  const Vector back = simd::nearest_whole(w);
  const Vectors<1> r = {Sub(Sub(back, w), full.lo)};
  Vectors<1> e, low;
  simd::exp2<1>(r, e, low);
  hn::Store(e[0], d, stage.e + at);
#if !HWY_NATIVE_FMA
  hn::Store(low[0], d, stage.e_low + at);
#endif
  const auto whole_power = [](Vector x) HWY_ATTR {
    return simd::whole_power_of_two(BitCast(simd::Words(), Add(x, constant(whole_shift))));
  };
  const Vector fourth = simd::nearest_whole(Mul(back, constant(-0.25)));
  scale[0] = whole_power(fourth);
  scale[1] = whole_power(Sub(Mul(constant(-3.0), fourth), back));
}

/// x times the four factors of start_deep.
HWY_INLINE Vector lower(Vector x, const Vectors<2>& scale) {
  return Mul(Mul(Mul(Mul(x, scale[0]), scale[0]), scale[0]), scale[1]);
}

/// The second step: displacements and velocities of one mass from the stage, each at most 1.6 units
/// of 2^-52 of its envelope from the reference.
template <int mass, int n>
HWY_INLINE void finish(const BatchMass& m, const Stage& stage, std::size_t at, Vectors<n>& u,
                       Vectors<n>& v) {
  const Doubles d;
  Vectors<n> z, e, quarters, sine, cosine;
  const auto load = [&](const double* from, int i)
                        HWY_ATTR { return hn::Load(d, from + at + std::size_t(i) * hn::Lanes(d)); };
  for (int i = 0; i < n; ++i) z[i] = load(stage.z[mass], i);
  simd::sine_cosine_of_quarter<n>(z, sine, cosine);
  for (int i = 0; i < n; ++i) quarters[i] = load(stage.quarters[mass], i);
  for (int i = 0; i < n; ++i) e[i] = simd::half_turn_sign(quarters[i], load(stage.e, i));
#if HWY_NATIVE_FMA
  for (int i = 0; i < n; ++i) sine[i] = Mul(e[i], sine[i]);
  for (int i = 0; i < n; ++i) cosine[i] = MulAdd(e[i], cosine[i], e[i]);
#else
  Vectors<n> low;
  for (int i = 0; i < n; ++i) low[i] = simd::half_turn_sign(quarters[i], load(stage.e_low, i));
  for (int i = 0; i < n; ++i) sine[i] = Mul(e[i], sine[i]);
  for (int i = 0; i < n; ++i) cosine[i] = Add(e[i], MulAdd(e[i], cosine[i], low[i]));
#endif
  for (int i = 0; i < n; ++i) simd::turn_by_quarters(quarters[i], sine[i], cosine[i]);
  // The low parts first, then what is the smaller term for light damping.
  for (int i = 0; i < n; ++i) u[i] = Mul(constant(m.b.lo), cosine[i]);
  for (int i = 0; i < n; ++i) v[i] = Mul(constant(m.v_cos.lo), cosine[i]);
  for (int i = 0; i < n; ++i) v[i] = MulAdd(constant(m.v_sin.lo), sine[i], v[i]);
  for (int i = 0; i < n; ++i) u[i] = MulAdd(constant(m.b.hi), cosine[i], u[i]);
  for (int i = 0; i < n; ++i) v[i] = MulAdd(constant(m.v_cos.hi), cosine[i], v[i]);
  for (int i = 0; i < n; ++i) v[i] = MulAdd(constant(m.v_sin.hi), sine[i], v[i]);
}

template <int mass, int n>
HWY_INLINE void finish_some(const BatchMass& m, const Stage& stage, std::size_t at, double* u_to,
                            double* v_to) {
  const Doubles d;
  Vectors<n> u, v;
  finish<mass, n>(m, stage, at, u, v);
  for (std::size_t i = 0; i < n; ++i) hn::StoreU(u[i], d, u_to + at + i * hn::Lanes(d));
  for (std::size_t i = 0; i < n; ++i) hn::StoreU(v[i], d, v_to + at + i * hn::Lanes(d));
}

/// The second step for `count` samples, whole vectors, from the stage's first on.
template <int mass>
HWY_NOINLINE void finish_all(const BatchMass& m, const Stage& stage, std::size_t count,
                             double* u_to, double* v_to) {
  const std::size_t lanes = hn::Lanes(Doubles());
  std::size_t at = 0;
  CLACKERS_ROLLED
  for (; at + in_step * lanes <= count; at += in_step * lanes)
    finish_some<mass, in_step>(m, stage, at, u_to, v_to);
  CLACKERS_ROLLED
  for (; at < count; at += lanes) finish_some<mass, 1>(m, stage, at, u_to, v_to);
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
