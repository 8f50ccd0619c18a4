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

// Omega t / pi less the nearest whole number k, as natural_phase().
HWY_INLINE Pair phase(const FlightConstants& c, Vector t, Vector& k) {
  const auto first = simd::two_product(constant(c.turns.hi), t);
  const auto second = simd::two_product(constant(c.turns.mid), t);
  const auto middle = simd::two_sum(first.lo, second.hi);
  const Vector rest = Add(middle.lo, Add(second.lo, Mul(constant(c.turns.lo), t)));
  const auto top = simd::quick_two_sum(first.hi, middle.hi);
  const auto low = simd::two_sum(top.lo, rest);
  const auto head = simd::quick_two_sum(top.hi, low.hi);
  const double start = c.first_impact - 0.5;
  k = simd::nearest_whole(Sub(head.hi, constant(start)));
  const auto sum = simd::two_sum(Sub(head.hi, k), head.lo);
  const auto y = simd::quick_two_sum(sum.hi, Add(sum.lo, low.lo));
  return start == 0.0 ? y : simd::add(y, constant(numerics::DoubleDouble{-start, 0.0}));
}

// Fills the block for the vector of times at `at`. Returns which of them are to be left out.
HWY_INLINE std::uint64_t start(const FlightConstants& c, Vector t, std::size_t at,
                               FlightBlock& block) {
  const Doubles d;
  Vector k, scale;
  const auto y = phase(c, t, k);
  const auto halvings =
      simd::subtract(simd::multiply(constant(c.log2_eta), c.collides ? k : hn::Zero(d)),
                     simd::multiply(constant(c.decay), t));
  auto e = simd::exp2(halvings, scale);
  // Without a stop an odd number of half turns changes the sign.
  if (!c.collides) scale = Mul(scale, simd::sign_of_power(k));
  hn::Store(k, d, block.flight + at);
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
HWY_INLINE void finish(const MassConstants& m, const FlightBlock& block, std::size_t count,
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

// Loops of their own over times and over masses, so that a processor, which looks only so many
// operations ahead, sees some that do not wait for each other.
HWY_INLINE std::uint64_t flights(const FlightConstants& c, const double* times, std::size_t count,
                                 FlightBlock& block) {
  const Doubles d;
  HWY_ALIGN double t[most_in_block];
  std::copy_n(times, count, t);
  const std::size_t whole = hwy::RoundUpTo(count, hn::Lanes(d));
  std::fill(t + count, t + whole, times[0]);
  std::uint64_t left_out = 0;
  for (std::size_t at = 0; at < whole; at += hn::Lanes(d))
    left_out |= start(c, hn::Load(d, t + at), at, block);
  return count == 64 ? left_out : left_out & ((std::uint64_t(1) << count) - 1);
}

std::uint64_t start_block(const FlightConstants& c, const double* times, std::size_t count,
                          FlightBlock& block) {
  return flights(c, times, count, block);
}

std::uint64_t sample(const FlightConstants& c, const double* times, std::size_t count, double* u,
                     double* v, double* a) {
  FlightBlock block;
  HWY_ALIGN double values[3][most_in_block];
  const auto left_out = flights(c, times, count, block);
  const std::size_t whole = hwy::RoundUpTo(count, hn::Lanes(Doubles()));
  const std::size_t masses = c.masses.size();
  for (std::size_t i = 0; i < masses; ++i) {
    a != nullptr ? finish<true>(c.masses[i], block, whole, values)
                 : finish<false>(c.masses[i], block, whole, values);
    double* const to[3] = {u + i, v + i, a == nullptr ? nullptr : a + i};
    for (int part = 0; part < (a != nullptr ? 3 : 2); ++part)
      for (std::size_t j = 0; j < count; ++j) to[part][j * masses] = values[part][j];
  }
  return left_out;
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

HWY_EXPORT(start_block);
HWY_EXPORT(sample);

std::uint64_t flight_block(const FlightConstants& c, const double* times, std::size_t count,
                           FlightBlock& block) {
  return HWY_DYNAMIC_DISPATCH(start_block)(c, times, count, block);
}

std::uint64_t sample_block(const FlightConstants& c, const double* times, std::size_t count,
                           double* u, double* v, double* a) {
  return HWY_DYNAMIC_DISPATCH(sample)(c, times, count, u, v, a);
}

}  // namespace clackers::exact
#endif
