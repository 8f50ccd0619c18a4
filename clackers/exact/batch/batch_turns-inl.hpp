// Turns of a pair's state by many steps at once. Compiled once for every target.
#include <hwy/highway.h>

#include <cstddef>

#include "clackers/exact/batch/batch.hpp"
#include "clackers/exact/batch/batch_flight-inl.hpp"

#if defined(CLACKERS_BATCH_TURNS) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_BATCH_TURNS
#undef CLACKERS_BATCH_TURNS
#else
#define CLACKERS_BATCH_TURNS
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {

inline constexpr std::size_t block_size = 64;

struct TurnTable {
  HWY_ALIGN double cosine[2][block_size], sine[2][block_size];
};

/// Turns, one a lane, of both masses.
struct Turns {
  Pair cosine[2], sine[2];
};

HWY_INLINE Turns all_lanes(const PairTurn& turn) {
  Turns t;
  for (int m = 0; m < 2; ++m) {
    t.cosine[m] = {constant(turn.cosine[m].hi), constant(turn.cosine[m].lo)};
    t.sine[m] = {constant(turn.sine[m].hi), constant(turn.sine[m].lo)};
  }
  return t;
}

HWY_INLINE Pair minus(const Pair& x) { return {Neg(x.hi), Neg(x.lo)}; }

HWY_INLINE Turns multiply(const Turns& x, const Turns& y) {
  Turns z;
  for (int m = 0; m < 2; ++m) {
    z.cosine[m] = simd::dot(x.cosine[m], y.cosine[m], minus(x.sine[m]), y.sine[m]);
    z.sine[m] = simd::dot(x.sine[m], y.cosine[m], x.cosine[m], y.sine[m]);
  }
  return z;
}

/// Lane i is turned i times by `step`, whose lanes are alike; `step` becomes the turn by all.
HWY_NOINLINE inline Turns lane_turns(Turns& step) {
  const Doubles d;
  const hn::RebindToSigned<Doubles> di;
  const auto number = hn::Iota(di, 0);
  Turns result = all_lanes({{{1.0, 0.0}, {1.0, 0.0}}, {{0.0, 0.0}, {0.0, 0.0}}});
  for (std::size_t bit = 1; bit < hn::Lanes(d); bit *= 2) {
    const auto chosen = hn::RebindMask(d, hn::TestBit(number, hn::Set(di, std::int64_t(bit))));
    const Turns turned = bit == 1 ? step : multiply(result, step);
    for (int m = 0; m < 2; ++m) {
      const auto choose = [&](Pair& old, const Pair& now) HWY_ATTR {
        old.hi = hn::IfThenElse(chosen, now.hi, old.hi);
        old.lo = hn::IfThenElse(chosen, now.lo, old.lo);
      };
      choose(result.cosine[m], turned.cosine[m]);
      choose(result.sine[m], turned.sine[m]);
    }
    step = multiply(step, step);
  }
  return result;
}

HWY_NOINLINE inline void fill_table(Turns step, TurnTable& table) {
  const Doubles d;
  constexpr std::size_t most = block_size;
  Turns all[most];
  all[0] = lane_turns(step);
  // By doubling: the products of a round do not wait for each other.
  const std::size_t count = block_size / hn::Lanes(d);
  for (std::size_t have = 1; have < count; have *= 2) {
    for (std::size_t j = 0; j < have; ++j) all[have + j] = multiply(all[j], step);
    step = multiply(step, step);
  }
  for (std::size_t j = 0; j < count; ++j)
    for (int m = 0; m < 2; ++m) {
      hn::Store(all[j].cosine[m].hi, d, table.cosine[m] + j * hn::Lanes(d));
      hn::Store(all[j].sine[m].hi, d, table.sine[m] + j * hn::Lanes(d));
    }
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
