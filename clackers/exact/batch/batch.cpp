#include "clackers/exact/batch/batch.hpp"

#include "clackers/numerics/simd/wanted.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/batch/batch.cpp"
#include <fmt/format.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/batch/batch_stage-inl.hpp"
#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {

inline constexpr std::size_t most_lanes = hn::MaxLanes(Doubles());

// Where a batch writes, in the kernel's order: u of the slow and of the fast mass, v of both.
using Places = double* const[4];

// Some times are outside, in decayed motion or next to a collision: all by the path for any E,
// then one by one those whose flight is not certain. Rare, so it must not be inlined.
template <class Kind>
HWY_NOINLINE void sample_rare(const PairBatch& batch, model::Side side, const double* times,
                              std::size_t at, const Places& to) {
  const Doubles d;
  const auto& c = batch.constants();
  Stage stage;
  Vector y;
  Vectors<2> scale;
  start_deep<Kind>(c, {simd::multiplicand(hn::LoadU(d, times + at)), hn::Zero(d)}, stage, 0, y,
                   scale);
  Vectors<1> u[2], v[2];
  finish<0, 1>(c.slow, stage, 0, u[0], v[0]);
  finish<1, 1>(c.fast, stage, 0, u[1], v[1]);
  for (int m = 0; m < 2; ++m) {
    hn::StoreU(lower(u[m][0], scale), d, to[m] + at);
    hn::StoreU(lower(v[m][0], scale), d, to[2 + m] + at);
  }
  HWY_ALIGN double phase[most_lanes];
  hn::Store(y, d, phase);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    const double t = times[at + i];
    if (!(t >= 0.0 && t <= c.end))
      refuse("motion", "t", t, fmt::format("0 <= t <= {} (the end of the motion, in s)", c.end), {},
             "time-outside");
    if (c.eta > 0.0 && phase[i] < c.certain && phase[i] > -c.certain) continue;
    const auto [u1, u2, v1, v2] =
        pair_state(batch.flight(), {t, 0.0}, flight_phase(batch.flight(), t, side));
    to[0][at + i] = c.exchanged ? u2 : u1;
    to[1][at + i] = c.exchanged ? u1 : u2;
    to[2][at + i] = c.exchanged ? v2 : v1;
    to[3][at + i] = c.exchanged ? v1 : v2;
  }
}

// The first step for n vectors. Returns where `plain` holds and these times are plain as well.
template <class Kind, int n>
HWY_INLINE hn::Mask<Doubles> start_some(const BatchConstants& c, const double* times,
                                        std::size_t at, Stage& stage, hn::Mask<Doubles> plain) {
  const Doubles d;
  Times time[n];
  for (int i = 0; i < n; ++i) {
    const Vector t = hn::LoadU(d, times + at + std::size_t(i) * hn::Lanes(d));
    time[i] = {simd::multiplicand(t), hn::Zero(d)};
  }
  Vectors<n> y;
  start<Kind, n>(c, time, stage, at, y);
  for (int i = 0; i < n; ++i) {
    // Written so that NaN is not plain.
    plain = hn::And(plain, hn::Lt(hn::Abs(y[i]), constant(c.certain)));
    plain = hn::And(plain, hn::Ge(time[i].t.x, hn::Zero(d)));
    plain = hn::And(plain, hn::Le(time[i].t.x, constant(c.plain_end)));
  }
  return plain;
}

// The first step for `count` times, whole vectors. False unless all are plain.
template <class Kind>
HWY_NOINLINE bool start_all(const BatchConstants& c, const double* times, std::size_t count,
                            Stage& stage) {
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d);
  auto plain = hn::Eq(hn::Zero(d), hn::Zero(d));
  std::size_t at = 0;
  CLACKERS_ROLLED
  for (; at + in_step * lanes <= count; at += in_step * lanes)
    plain = start_some<Kind, in_step>(c, times, at, stage, plain);
  CLACKERS_ROLLED
  for (; at < count; at += lanes) plain = start_some<Kind, 1>(c, times, at, stage, plain);
  return hn::AllTrue(d, plain);
}

// At most as many times as a stage holds, whole vectors.
template <class Kind>
void sample_some(const PairBatch& batch, model::Side side, const double* times, std::size_t count,
                 const Places& to) {
  const auto& c = batch.constants();
  Stage stage;
  if (HWY_LIKELY(start_all<Kind>(c, times, count, stage))) {
    finish_all<0>(c.slow, stage, count, to[0], to[2]);
    finish_all<1>(c.fast, stage, count, to[1], to[3]);
    return;
  }
  for (std::size_t i = 0; i < count; i += hn::Lanes(Doubles()))
    sample_rare<Kind>(batch, side, times, i, to);
}

template <bool long_phase, bool elastic>
void sample_all(const PairBatch& batch, model::Side side, const double* times, std::size_t count,
                const Places& to) {
  using Plain = Kind<long_phase, elastic, false>;
  const std::size_t lanes = hn::Lanes(Doubles()), whole = count - count % lanes;
  for (std::size_t i = 0; i < whole; i += stage_size)
    sample_some<Plain>(batch, side, times + i, std::min(stage_size, whole - i),
                       {to[0] + i, to[1] + i, to[2] + i, to[3] + i});
  if (whole == count) return;
  // The rest, filled up with its first time.
  double t[most_lanes], values[4][most_lanes];
  for (std::size_t j = 0; j < lanes; ++j) t[j] = times[whole + j < count ? whole + j : whole];
  sample_some<Plain>(batch, side, t, lanes, {values[0], values[1], values[2], values[3]});
  for (int i = 0; i < 4; ++i) std::copy_n(values[i], count - whole, to[i] + whole);
}

std::int64_t sample_batch(const PairBatch& batch, model::Side side, const double* times,
                          std::size_t count, const PairBuffers& out) {
  const auto& c = batch.constants();
  const bool elastic = c.log2_eta.hi == 0.0, swap = c.exchanged;
  const Places to = {(swap ? out.u2 : out.u1).data(), (swap ? out.u1 : out.u2).data(),
                     (swap ? out.v2 : out.v1).data(), (swap ? out.v1 : out.v2).data()};
  if (c.long_phase)
    elastic ? sample_all<true, true>(batch, side, times, count, to)
            : sample_all<true, false>(batch, side, times, count, to);
  else
    elastic ? sample_all<false, true>(batch, side, times, count, to)
            : sample_all<false, false>(batch, side, times, count, to);
  return HWY_TARGET;
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

using numerics::DoubleDouble;

HWY_EXPORT(sample_batch);

template <class Number>
void require_size(const PairArrays<Number>& arrays, std::size_t size) {
  if (arrays.u1.size() != size || arrays.u2.size() != size || arrays.v1.size() != size ||
      arrays.v2.size() != size)
    throw InputError(
        fmt::format(
            "batch: arrays for u1, u2, v1, v2 hold {}, {}, {}, {} numbers; allowed: {} each, "
            "one a time.",
            arrays.u1.size(), arrays.u2.size(), arrays.v1.size(), arrays.v2.size(), size),
        "wrong-size");
}
template void require_size(const PairArrays<double>&, std::size_t);
template void require_size(const PairArrays<const double>&, std::size_t);

void require_grid(const UniformGrid& grid, double end) {
  require_step("grid", grid.step);
  const auto outside = [&](const char* name, double t) {
    refuse("grid", name, t, fmt::format("0 <= t <= {} (the end of the motion, in s)", end), {},
           "time-outside");
  };
  if (!(grid.start >= 0.0 && grid.start <= end)) outside("start", grid.start);
  if (grid.count == 0) return;
  const auto last = instant(grid, static_cast<double>(grid.count - 1));
  if (last.hi > end || (last.hi == end && last.lo > 0.0)) outside("last instant", last.hi);
}

DoubleDouble instant(const UniformGrid& grid, double k) {
  return numerics::two_product(grid.step, k) + DoubleDouble{grid.start, 0.0};
}

PairTurn pair_turn(const FlightConstants& c, const DoubleDouble& t) {
  // Whole half turns change the signs of all, as the multiples are odd.
  const auto y = flight_phase(c, t).half_turns;
  const auto [e, exponent] = numerics::exp2(-(c.decay * t));
  const double scale = numerics::scale(1.0, exponent);
  const DoubleDouble power{e.hi * scale, e.lo * scale};
  PairTurn turn;
  const bool exchanged = c.masses[0].multiple > c.masses[1].multiple;
  for (std::size_t m = 0; m < 2; ++m) {
    const auto& mass = c.masses[exchanged ? 1 - m : m];
    const auto [sine, cosine] = numerics::sincospi(y * mass.multiple);
    turn.cosine[m] = power * cosine;
    turn.sine[m] = power * sine;
  }
  return turn;
}

PairBatch::PairBatch(const FlightConstants& constants)
    : flight_(constants), constants_(batch_constants(constants)) {}

numerics::simd::Target PairBatch::sample(std::span<const double> times, model::Side side,
                                         const PairBuffers& out) const {
  require_size(out, times.size());
  return {HWY_DYNAMIC_DISPATCH(sample_batch)(*this, side, times.data(), times.size(), out)};
}

}  // namespace clackers::exact
#endif
