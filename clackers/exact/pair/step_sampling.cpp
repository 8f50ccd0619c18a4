// Equidistant times. Between impacts z = E exp(i p theta) of a mass is multiplied in each step by the same number, and u, v, a
// are the real parts of W z with complex numbers W. At every 64th time, an anchor, W z is evaluated as at any time; the next 63
// states are its products with tabulated factors r, the z of j steps over that of none.
//
// Rounding: W z and r are split into parts, multiples of 2^-26 of a power of two of at most 4 |W z| and of 1, and their rests.
// Products of parts and differences of such products are exact. The sum of the products with rests is rounded to 2^-75 |W z|,
// which is 2^-63 of the envelope after the decay in a block (most_halvings), and the whole sum once. W z and r
// carry each the errors of sincospi() and exp2(), together 2^-61.3. A time lies delta beyond its place, anchor + j steps;
// r' delta is added to the rest of r, which leaves out (omega delta)^2 / 2 < 2^-63. With half a unit for the
// last rounding below 0.503 units of 2^-52, as at times by themselves.
#include "clackers/exact/pair/sampling.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/pair/step_sampling.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "clackers/numerics/simd/double_double-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace simd = numerics::simd::HWY_NAMESPACE;

using simd::constant;
using simd::Doubles;
using simd::Pair;
using simd::Vector;

// e cos(p pi y) and e sin(p pi y).
HWY_INLINE void turned(const Pair& y, const Pair& e, double multiple, Pair& cosine, Pair& sine) {
  simd::sincospi(simd::multiply(y, constant(multiple)), sine, cosine);
  cosine = simd::multiply(e, cosine);
  sine = simd::multiply(e, sine);
}

// For shift = 1.5 * 2^n and |x| < 2^n / 2 a multiple of 2^(n - 52) and the rest.
HWY_INLINE Pair split(const Pair& x, Vector shift) {
  const Vector most = Sub(Add(x.hi, shift), shift);
  return {most, Add(Sub(x.hi, most), x.lo)};
}

HWY_INLINE Pair load(const double* hi, const double* lo, std::size_t at) {
  return {hn::Load(Doubles(), hi + at), hn::Load(Doubles(), lo + at)};
}

void tabulate(const FlightConstants& c, const FlightBlock& block, StepTable& table) {
  const Doubles d;
  for (std::size_t i = 0; i < c.masses.size(); ++i) {
    const auto& mass = c.masses[i];
    auto& factor = table.factors[i];
    // r' = (-sigma + i p Omega) r
    const Vector growth = constant(mass.v_cos.hi / mass.b.hi);
    const Vector turning = constant(-mass.v_sin.hi / mass.b.hi);
    for (std::size_t at = 0; at < most_in_block; at += hn::Lanes(d)) {
      const Vector scale = hn::Load(d, block.scale + at);
      auto e = load(block.e_hi, block.e_lo, at);
      e = {Mul(e.hi, scale), Mul(e.lo, scale)};
      const auto y = simd::add(load(block.y_hi, block.y_lo, at), constant({0.5, 0.0}));
      Pair cosine, sine;
      turned(y, e, mass.multiple, cosine, sine);
      const auto put = [&](const Pair& x, double* most, double* rest) HWY_ATTR {
        const auto parts = split(x, constant(0x1.8p26));
        hn::Store(parts.hi, d, most + at);
        hn::Store(parts.lo, d, rest + at);
      };
      put(cosine, factor.cosine, factor.cosine_rest);
      put(sine, factor.sine, factor.sine_rest);
      hn::Store(Sub(Mul(growth, cosine.hi), Mul(turning, sine.hi)), d, factor.cosine_rate + at);
      hn::Store(Add(Mul(growth, sine.hi), Mul(turning, cosine.hi)), d, factor.sine_rate + at);
    }
  }
}

// W z of u, v and a of a mass at the anchors, before the next impact and after it.
struct Anchors {
  // Real part, its rest, imaginary part, its rest.
  alignas(64) double parts[3][2][4][most_anchors];
};

template <int components>
HWY_INLINE void begin(const FlightConstants& c, const MassConstants& m, const FlightBlock& block,
                      std::size_t count, Anchors& anchors) {
  const Doubles d;
  for (std::size_t at = 0; at < count; at += hn::Lanes(d)) {
    Pair cosine, sine;
    turned(load(block.y_hi, block.y_lo, at), load(block.e_hi, block.e_lo, at), m.multiple, cosine,
           sine);
    const auto put = [&](int component, const numerics::DoubleDouble& of_cosine,
                         const numerics::DoubleDouble& of_sine, double envelope) HWY_ATTR {
      const auto x = constant(of_cosine), y = constant(of_sine);
      auto real = simd::add(simd::multiply(x, cosine), simd::multiply(y, sine));
      auto imaginary = simd::subtract(simd::multiply(x, sine), simd::multiply(y, cosine));
      const Vector shift = constant(std::ldexp(0x1.8p28, std::ilogb(envelope)));
      for (auto& parts : anchors.parts[component]) {
        const auto a = split(real, shift), b = split(imaginary, shift);
        hn::Store(a.hi, d, parts[0] + at);
        hn::Store(a.lo, d, parts[1] + at);
        hn::Store(b.hi, d, parts[2] + at);
        hn::Store(b.lo, d, parts[3] + at);
        real = simd::multiply(real, constant(-c.eta));
        imaginary = simd::multiply(imaginary, constant(-c.eta));
      }
    };
    put(0, m.b, {}, m.u_envelope);
    put(1, m.v_cos, m.v_sin, m.v_envelope);
    if constexpr (components == 3) put(2, m.a_cos, m.a_sin, m.a_envelope);
  }
}

// The 64 times from an anchor on: what each lies beyond its place and whether it is behind an impact.
struct Places {
  alignas(64) double delta[most_in_block];
  alignas(64) double after[most_in_block];  // not negative: behind it
  std::uint64_t behind = 0, left_out = 0;   // a bit each
};

HWY_INLINE void place(const FlightConstants& c, const StepTable& table, const double* times,
                      double y, double k, Places& places) {
  const Doubles d;
  const Vector first = constant(-times[0]), half = constant(0.5);
  const Vector distance =
      constant(c.collides ? 0.5 - 0x1p-29 - 0x1p-52 * (k + table.whole + 3.0) : 2.0);
  std::uint64_t behind = 0, left_out = 0;
  for (std::size_t at = 0; at < most_in_block; at += hn::Lanes(d)) {
    const Vector t = hn::LoadU(d, times + at);
    const auto since = simd::two_sum(t, first);
    const Vector delta = Add(Sub(since.hi, hn::Load(d, table.t + at)), since.lo);
    const Vector after = c.collides ? Add(constant(y), hn::Load(d, table.y + at)) : constant(-0.5);
    hn::Store(delta, d, places.delta + at);
    hn::Store(after, d, places.after + at);
    // Written so that NaN is left out.
    auto plain = And(hn::Ge(t, hn::Zero(d)), hn::Le(t, constant(c.end)));
    plain = And(plain, hn::Le(Abs(delta), constant(table.most_delta)));
    plain = And(plain, hn::Lt(Abs(Sub(Abs(after), half)), distance));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Not(plain), bits);
    left_out |= std::uint64_t(bits[0]) << at;
    hn::StoreMaskBits(d, hn::Ge(after, hn::Zero(d)), bits);
    behind |= std::uint64_t(bits[0]) << at;
  }
  places.behind = behind;
  places.left_out = left_out;
}

template <int components>
HWY_INLINE void turn(const StepTable::Factor& factor, const Places& places, const Anchors& anchors,
                     std::size_t anchor, double power, const auto& put) {
  const Doubles d;
  const Vector scale = constant(power);
  const std::uint64_t lanes = (std::uint64_t(1) << hn::Lanes(d)) - 1;
  for (std::size_t at = 0; at < most_in_block; at += hn::Lanes(d)) {
    const Vector delta = hn::Load(d, places.delta + at);
    const auto rest = [&](const double* x, const double* rate) HWY_ATTR {
      return Add(hn::Load(d, x + at), Mul(delta, hn::Load(d, rate + at)));
    };
    const Vector cosine = hn::Load(d, factor.cosine + at), sine = hn::Load(d, factor.sine + at);
    const Vector cosine_rest = rest(factor.cosine_rest, factor.cosine_rate);
    const Vector sine_rest = rest(factor.sine_rest, factor.sine_rate);
    const Vector all_cosine = Add(cosine, cosine_rest), all_sine = Add(sine, sine_rest);
    const auto value = [&](int component, bool is_behind) HWY_ATTR {
      const auto& parts = anchors.parts[component][is_behind];
      const Vector x = constant(parts[0][anchor]), x_rest = constant(parts[1][anchor]);
      const Vector y = constant(parts[2][anchor]), y_rest = constant(parts[3][anchor]);
      const Vector small = Sub(Add(Mul(x, cosine_rest), Mul(x_rest, all_cosine)),
                               Add(Mul(y, sine_rest), Mul(y_rest, all_sine)));
      const Vector sum = Add(Sub(Mul(x, cosine), Mul(y, sine)), small);
      return Add(Mul(sum, scale), hn::Zero(d));  // never -0
    };
    const auto behind = (places.behind >> at) & lanes;
    for (int component = 0; component < components; ++component) {
      Vector x = value(component, behind != 0);
      if (behind != 0 && behind != lanes)
        x = hn::IfThenElse(hn::Ge(hn::Load(d, places.after + at), hn::Zero(d)), x,
                           value(component, false));
      put(component, at, x);
    }
  }
}

template <int components>
HWY_INLINE void step(const FlightConstants& c, const StepTable& table, const double* times,
                     std::size_t count, double* const* to, std::uint64_t* left_out) {
  const Doubles d;
  FlightBlock block;
  double first[most_anchors] = {};
  for (std::size_t i = 0; i < count; ++i) first[i] = times[i * most_in_block];
  const auto bad = flight_block(c, first, count, block);
  const std::size_t masses = c.masses.size();
  Anchors anchors[2];
  for (std::size_t j = 0; j < masses; ++j)
    begin<components>(c, c.masses[j], block, hwy::RoundUpTo(count, hn::Lanes(d)), anchors[j]);
  Places places;
  HWY_ALIGN double values[components][most_in_block];
  for (std::size_t i = 0; i < count; ++i) {
    left_out[i] = ~std::uint64_t(0);
    if ((bad >> i & 1) != 0) continue;
    place(c, table, times + i * most_in_block, block.y_hi[i], block.flight[i], places);
    left_out[i] = places.left_out;
    if (~places.left_out == 0) continue;
    const std::size_t row = i * most_in_block;
    const auto turn_mass = [&](std::size_t j, const auto& put) HWY_ATTR {
      turn<components>(table.factors[j], places, anchors[j], i, block.scale[i], put);
    };
    if (masses == 1) {
      turn_mass(0, [&](int component, std::size_t at, Vector x)
                       HWY_ATTR { hn::StoreU(x, d, to[component] + row + at); });
      continue;
    }
    turn_mass(0, [&](int component, std::size_t at, Vector x)
                     HWY_ATTR { hn::Store(x, d, values[component] + at); });
    turn_mass(1, [&](int component, std::size_t at, Vector x) HWY_ATTR {
      hn::StoreInterleaved2(hn::Load(d, values[component] + at), x, d,
                            to[component] + 2 * (row + at));
    });
  }
}

void step_blocks(const FlightConstants& c, const StepTable& table, const double* times,
                 std::size_t count, double* const* to, std::uint64_t* left_out) {
  to[2] != nullptr ? step<3>(c, table, times, count, to, left_out)
                   : step<2>(c, table, times, count, to, left_out);
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

HWY_EXPORT(tabulate);
HWY_EXPORT(step_blocks);

bool tabulate_steps(const FlightConstants& c, std::span<const double> times, StepTable& table) {
  constexpr auto n = most_in_block;
  if (times.size() < least_equidistant || (c.collides && c.eta == 0.0)) return false;
  const double step = (times[n] - times[0]) / double(n);
  double fastest = 0.0;
  for (const auto& m : c.masses) fastest = std::max(fastest, m.v_envelope / m.u_envelope);
  table.most_delta = 0x1p-31 / fastest;
  // Of a later block, since the rounding of the first times often cancels in the step.
  const auto is_in_place = [&, later = times.subspan(least_equidistant - n)](std::size_t j) {
    return std::abs(later[j] - later[0] - double(j) * step) <= table.most_delta;
  };
  if (!(step > 0.0 && times[0] >= 0.0 && times[n] <= c.end && is_in_place(1) && is_in_place(n - 1)))
    return false;
  // Counted from an impact, so that the phase is rounded down to whole half turns.
  FlightConstants turning;
  turning.collides = c.collides;
  turning.eta = c.eta;
  turning.first_impact = 1.0;
  turning.turns = c.turns;
  turning.decay = c.decay;
  turning.log2_eta = c.log2_eta;
  for (std::size_t j = 0; j < n; ++j) table.t[j] = double(j) * step;
  FlightBlock block;
  flight_block(turning, table.t, n, block);
  table.whole = block.flight[n - 1];
  constexpr double most_halvings = 12.0;
  const double gone =
      c.decay.hi * table.t[n - 1] - (c.collides ? c.log2_eta.hi * (table.whole + 1.0) : 0.0);
  if (!(gone <= most_halvings)) return false;
  std::ranges::copy(block.y_hi, table.y);
  HWY_DYNAMIC_DISPATCH(tabulate)(c, block, table);
  return true;
}

bool sample_steps(const FlightConstants& c, const StepTable& table, const double* times,
                  std::size_t blocks, double* u, double* v, double* a, std::uint64_t* left_out) {
  double* const to[] = {u, v, a};
  HWY_DYNAMIC_DISPATCH(step_blocks)(c, table, times, blocks, to, left_out);
  return std::any_of(left_out, left_out + blocks,
                     [](std::uint64_t bits) { return std::popcount(bits) < 32; });
}

}  // namespace clackers::exact
#endif
