#include "clackers/exact/pair/sampling.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/pair/sampling.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "clackers/numerics/simd/double_double-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace simd = numerics::simd::HWY_NAMESPACE;

using simd::constant;
using simd::Doubles;
using simd::Pair;
using simd::Vector;

// What the loop over times hands to those over masses. Loops of their own over many times, so that a
// processor, which looks only so many operations ahead, sees some that do not wait for each other.
struct Block {
  HWY_ALIGN double y_hi[most_in_block], y_lo[most_in_block];  ///< theta / pi
  HWY_ALIGN double e_hi[most_in_block], e_lo[most_in_block];  ///< E without a power of two
  HWY_ALIGN double scale[most_in_block];                      ///< and that
};

// Omega t / pi less the nearest whole number k, as ClosedForm::phase_at().
HWY_INLINE Pair phase(const FlightConstants& c, Vector t, Vector& k) {
  const auto first = simd::two_product(constant(c.turns.hi), t);
  const auto second = simd::two_product(constant(c.turns.mid), t);
  const auto middle = simd::two_sum(first.lo, second.hi);
  const Vector rest = Add(middle.lo, Add(second.lo, Mul(constant(c.turns.lo), t)));
  const auto top = simd::quick_two_sum(first.hi, middle.hi);
  const auto low = simd::two_sum(top.lo, rest);
  const auto head = simd::quick_two_sum(top.hi, low.hi);
  k = simd::nearest_whole(head.hi);
  const auto sum = simd::two_sum(Sub(head.hi, k), head.lo);
  return simd::quick_two_sum(sum.hi, Add(sum.lo, low.lo));
}

// Fills the block for the vector of times at `at`. Returns which of them are to be left out.
HWY_INLINE std::uint64_t start(const FlightConstants& c, Vector t, std::size_t at, Block& block) {
  const Doubles d;
  Vector k, scale;
  const auto y = phase(c, t, k);
  const auto halvings =
      simd::subtract(simd::multiply(constant(c.log2_eta), c.collides ? k : hn::Zero(d)),
                     simd::multiply(constant(c.decay), t));
  auto e = simd::exp2(halvings, scale);
  // Without a stop an odd number of half turns changes the sign.
  if (!c.collides) {
    const Vector half = Mul(k, constant(0.5));
    const Vector sign =
        Sub(constant(1.0), Mul(constant(4.0), Abs(Sub(half, simd::nearest_whole(half)))));
    scale = Mul(scale, sign);
  }
  hn::Store(y.hi, d, block.y_hi + at);
  hn::Store(y.lo, d, block.y_lo + at);
  hn::Store(e.hi, d, block.e_hi + at);
  hn::Store(e.lo, d, block.e_lo + at);
  hn::Store(scale, d, block.scale + at);
  // Written so that NaN is left out. The distance from an impact is as in ClosedForm::flight_at().
  auto plain = And(hn::Ge(t, hn::Zero(d)), hn::Le(t, constant(c.end)));
  plain = And(plain,
              hn::Gt(Sub(constant(0.5), Abs(y.hi)), Mul(Add(k, constant(2.0)), constant(0x1p-52))));
  plain = And(plain, hn::Ge(halvings.hi, constant(-1000.0)));
  if (c.eta == 0.0) plain = And(plain, hn::Eq(k, hn::Zero(d)));
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, hn::Not(plain), bits);
  return std::uint64_t(bits[0]) << at;
}

template <bool with_a>
HWY_INLINE void finish(const MassConstants& m, const Block& block, std::size_t count,
                       double (*out)[most_in_block]) {
  const Doubles d;
  const auto b = constant(m.b), v_cos = constant(m.v_cos), v_sin = constant(m.v_sin);
  for (std::size_t at = 0; at < count; at += hn::Lanes(d)) {
    const Pair y{hn::Load(d, block.y_hi + at), hn::Load(d, block.y_lo + at)};
    const Pair e{hn::Load(d, block.e_hi + at), hn::Load(d, block.e_lo + at)};
    const Vector scale = hn::Load(d, block.scale + at);
    Pair sine, cosine;
    simd::sincospi(simd::multiply(y, constant(m.multiple)), sine, cosine);
    const auto ec = simd::multiply(e, cosine), es = simd::multiply(e, sine);
    const auto put = [&](Vector x, double* to) HWY_ATTR {
      hn::Store(Add(Mul(x, scale), hn::Zero(d)), d, to + at);  // never -0
    };
    put(simd::multiply(b, ec).hi, out[0]);
    put(simd::add(simd::multiply(v_cos, ec), simd::multiply(v_sin, es)).hi, out[1]);
    if constexpr (with_a)
      put(simd::add(simd::multiply(constant(m.a_cos), ec), simd::multiply(constant(m.a_sin), es))
              .hi,
          out[2]);
  }
}

std::uint64_t sample(const FlightConstants& c, const double* times, std::size_t count, double* u,
                     double* v, double* a) {
  const Doubles d;
  Block block;
  HWY_ALIGN double t[most_in_block], values[3][most_in_block];
  std::copy_n(times, count, t);
  const std::size_t lanes = hn::Lanes(d), whole = (count + lanes - 1) / lanes * lanes;
  std::fill(t + count, t + whole, times[0]);
  std::uint64_t left_out = 0;
  for (std::size_t at = 0; at < whole; at += lanes)
    left_out |= start(c, hn::Load(d, t + at), at, block);
  const std::size_t masses = c.masses.size();
  for (std::size_t i = 0; i < masses; ++i) {
    a != nullptr ? finish<true>(c.masses[i], block, whole, values)
                 : finish<false>(c.masses[i], block, whole, values);
    double* const to[3] = {u + i, v + i, a == nullptr ? nullptr : a + i};
    for (int part = 0; part < (a != nullptr ? 3 : 2); ++part)
      for (std::size_t j = 0; j < count; ++j) to[part][j * masses] = values[part][j];
  }
  return count == 64 ? left_out : left_out & ((std::uint64_t(1) << count) - 1);
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

HWY_EXPORT(sample);

std::uint64_t sample_block(const FlightConstants& c, const double* times, std::size_t count,
                           double* u, double* v, double* a) {
  return HWY_DYNAMIC_DISPATCH(sample)(c, times, count, u, v, a);
}

}  // namespace clackers::exact
#endif
