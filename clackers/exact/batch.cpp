#include "clackers/exact/batch.hpp"

#include "clackers/numerics/simd/wanted.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/batch.cpp"
#include <fmt/format.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/batch_flight-inl.hpp"
#include "clackers/numerics/half_turns.hpp"
#include "clackers/numerics/power_of_two.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {

inline constexpr std::size_t most_lanes = hn::MaxLanes(Doubles());

template <int n>
HWY_INLINE void store(const States<n>& s, const PairBuffers& out, std::size_t at) {
  const Doubles d;
  for (int i = 0; i < n; ++i, at += hn::Lanes(d)) {
    hn::StoreU(s.u[0][i], d, out.u1.data() + at);
    hn::StoreU(s.u[1][i], d, out.u2.data() + at);
    hn::StoreU(s.v[0][i], d, out.v1.data() + at);
    hn::StoreU(s.v[1][i], d, out.v2.data() + at);
  }
}

// Some times are outside, in decayed motion or next to a collision: all by the path for any E,
// then one by one those whose flight is not certain. Rare, so it must not be inlined.
template <class Kind>
HWY_NOINLINE void sample_rare(const PairBatch& batch, model::Side side, const double* times,
                              const PairBuffers& out, std::size_t at) {
  const Doubles d;
  const auto& c = batch.constants();
  States<1> s;
  Vector y;
  deep_states_at<Kind>(c, {simd::multiplicand(hn::LoadU(d, times)), hn::Zero(d)}, s, y);
  store<1>(s, out, at);
  HWY_ALIGN double phase[most_lanes];
  hn::Store(y, d, phase);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    const double t = times[i];
    if (!(t >= 0.0 && t <= c.end))
      refuse("motion", "t", t, fmt::format("0 <= t <= {} (the end of the motion, in s)", c.end), {},
             "time-outside");
    if (c.eta > 0.0 && phase[i] < c.certain && phase[i] > -c.certain) continue;
    const auto [u1, u2, v1, v2] =
        pair_state(batch.flight(), {t, 0.0}, flight_phase(batch.flight(), t, side));
    out.u1[at + i] = c.exchanged ? u2 : u1;
    out.u2[at + i] = c.exchanged ? u1 : u2;
    out.v1[at + i] = c.exchanged ? v2 : v1;
    out.v2[at + i] = c.exchanged ? v1 : v2;
  }
}

template <class Kind, int n>
HWY_INLINE void sample_some(const PairBatch& batch, model::Side side, const double* times,
                            const PairBuffers& out, std::size_t at) {
  const auto& c = batch.constants();
  const Doubles d;
  const auto lanes = hn::Lanes(d);
  Times t[n];
  for (int i = 0; i < n; ++i) {
    const Vector x = hn::LoadU(d, times + std::size_t(i) * lanes);
    t[i] = {simd::multiplicand(x), x};
  }
  States<n> s;
  Vectors<n> y;
  states_at<Kind, n>(c, t, s, y);
  store<n>(s, out, at);
  // Written so that NaN is not plain.
  auto plain = hn::Lt(hn::Abs(y[0]), constant(c.certain));
  for (int i = 0; i < n; ++i) {
    if (i > 0) plain = hn::And(plain, hn::Lt(hn::Abs(y[i]), constant(c.certain)));
    plain = hn::And(plain, hn::Ge(t[i].t.x, hn::Zero(d)));
    plain = hn::And(plain, hn::Le(t[i].t.x, constant(c.plain_end)));
  }
  if (HWY_LIKELY(hn::AllTrue(d, plain))) return;
  for (std::size_t i = 0; i < n; ++i)
    sample_rare<Kind>(batch, side, times + i * lanes, out, at + i * lanes);
}

template <bool long_phase, bool elastic>
void sample_all(const PairBatch& batch, model::Side side, const double* times, std::size_t count,
                const PairBuffers& out) {
  using Plain = Kind<long_phase, elastic, false>;
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + 2 * lanes <= count; i += 2 * lanes)
    sample_some<Plain, 2>(batch, side, times + i, out, i);
  for (; i + lanes <= count; i += lanes) sample_some<Plain, 1>(batch, side, times + i, out, i);
  if (i == count) return;
  // The rest, filled up with its first time.
  HWY_ALIGN double t[most_lanes], values[4][most_lanes];
  for (std::size_t j = 0; j < lanes; ++j) t[j] = times[i + j < count ? i + j : i];
  const PairBuffers part{values[0], values[1], values[2], values[3]};
  sample_some<Plain, 1>(batch, side, t, part, 0);
  for (std::size_t j = 0; i + j < count; ++j) {
    out.u1[i + j] = values[0][j];
    out.u2[i + j] = values[1][j];
    out.v1[i + j] = values[2][j];
    out.v2[i + j] = values[3][j];
  }
}

std::int64_t sample_batch(const PairBatch& batch, model::Side side, const double* times,
                          std::size_t count, const PairBuffers& out) {
  const bool elastic = batch.constants().log2_eta.hi == 0.0;
  if (batch.constants().long_phase)
    elastic ? sample_all<true, true>(batch, side, times, count, out)
            : sample_all<true, false>(batch, side, times, count, out);
  else
    elastic ? sample_all<false, true>(batch, side, times, count, out)
            : sample_all<false, false>(batch, side, times, count, out);
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
  const auto [e, exponent] = numerics::power_of_two(-(c.decay * t));
  const double scale = numerics::scale(1.0, exponent);
  const DoubleDouble power{e.hi * scale, e.lo * scale};
  PairTurn turn;
  const bool exchanged = c.masses[0].multiple > c.masses[1].multiple;
  for (std::size_t m = 0; m < 2; ++m) {
    const auto& mass = c.masses[exchanged ? 1 - m : m];
    const auto [sine, cosine] = numerics::sine_cosine_of_half_turns(y * mass.multiple);
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
  PairBuffers slow_first = out;
  if (constants_.exchanged) {
    std::swap(slow_first.u1, slow_first.u2);
    std::swap(slow_first.v1, slow_first.v2);
  }
  return {HWY_DYNAMIC_DISPATCH(sample_batch)(*this, side, times.data(), times.size(), slow_first)};
}

}  // namespace clackers::exact
#endif
