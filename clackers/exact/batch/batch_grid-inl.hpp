// The states of a pair on a uniform grid. Compiled once for every target.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "clackers/exact/batch/batch_block-inl.hpp"
#include "clackers/exact/batch/batch_stage-inl.hpp"

#if defined(CLACKERS_BATCH_GRID) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_BATCH_GRID
#undef CLACKERS_BATCH_GRID
#else
#define CLACKERS_BATCH_GRID
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {

inline constexpr std::size_t fresh_after = 64;  ///< blocks

// One state by the scalar closed form, in the kernel's order.
inline void exact_state(const PairBatch& batch, const numerics::DoubleDouble& t, Block& block,
                        std::size_t i) {
  const auto [u1, u2, v1, v2] = pair_state(batch.flight(), t, flight_phase(batch.flight(), t));
  const bool swap = batch.constants().exchanged;
  block.values[0][i] = swap ? u2 : u1;
  block.values[1][i] = swap ? u1 : u2;
  block.values[2][i] = swap ? v2 : v1;
  block.values[3][i] = swap ? v1 : v2;
}

/// The block of anchor `lane` with the samples whose flight is not certain done by the closed form;
/// its first sample is `first` of the grid.
HWY_NOINLINE inline void careful_block(const PairBatch& batch, const UniformGrid& grid,
                                       const TurnTable& table, const Anchors& a, std::size_t lane,
                                       Vector side, std::size_t first, std::size_t count,
                                       Block& block) {
  SlowMass state(side);
  const BlockWriter writer{&block};
  auto slow = writer.half<0>(0);
  auto fast = writer.half<1>(0);
  run_lines<BlockWriter>(table, a, lane, state, slow, fast);
  for (std::size_t i = 0; i < count; ++i)
    if (!(std::abs(block.values[0][i]) > a.certain[lane]))
      exact_state(batch, instant(grid, double(first + i)), block, i);
}

/// The instants `first`, first + 1, ... of a grid.
HWY_INLINE Times instants(const UniformGrid& grid, std::size_t first) {
  const Vector k = Add(constant(double(first)), hn::Iota(Doubles(), 0.0));
  const auto travel = simd::two_product(Factor(grid.step), simd::multiplicand(k));
  const auto sum = simd::two_sum(constant(grid.start), travel.hi);
  const auto t = simd::quick_two_sum(sum.hi, Add(sum.lo, travel.lo));
  return {simd::multiplicand(t.hi), t.lo};
}

/// What direct_block knows of its samples besides their stage.
struct Direct {
  bool plain;  ///< otherwise the results are to be multiplied by `scale` (see start_deep)
  HWY_ALIGN double phase[block_size], scale[2][block_size];
};

template <class Kind>
HWY_NOINLINE void start_block(const BatchConstants& c, const UniformGrid& grid, std::size_t first,
                              std::size_t count, Stage& stage, Direct& direct) {
  const Doubles d;
  for (std::size_t j = 0; j < count; j += hn::Lanes(d)) {
    const Times t[1] = {instants(grid, first + j)};
    Vectors<1> y;
    if (direct.plain) {
      start<Kind, 1>(c, t, stage, j, y);
    } else {
      Vectors<2> scale;
      start_deep<Kind>(c, t[0], stage, j, y[0], scale);
      for (int i = 0; i < 2; ++i) hn::Store(scale[i], d, direct.scale[i] + j);
    }
    hn::Store(y[0], d, direct.phase + j);
  }
}

/// A block of samples, each from its own phase.
template <class Kind>
void direct_block(const PairBatch& batch, const UniformGrid& grid, std::size_t first,
                  std::size_t count, Block& block) {
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d), whole = (count + lanes - 1) / lanes * lanes;
  const auto& c = batch.constants();
  Stage stage;
  Direct direct;
  // A step more, for what the product rounds.
  direct.plain = grid.start + double(first + block_size + 1) * grid.step <= c.plain_end;
  start_block<Kind>(c, grid, first, count, stage, direct);
  finish_all<0>(c.slow, stage, whole, block.values[0], block.values[2]);
  finish_all<1>(c.fast, stage, whole, block.values[1], block.values[3]);
  if (!direct.plain)
    for (auto& values : block.values)
      for (std::size_t j = 0; j < whole; j += lanes) {
        const Vectors<2> scale = {hn::Load(d, direct.scale[0] + j),
                                  hn::Load(d, direct.scale[1] + j)};
        hn::Store(lower(hn::Load(d, values + j), scale), d, values + j);
      }
  for (std::size_t i = 0; i < count; ++i)
    if (!(std::abs(direct.phase[i]) < c.certain) || c.eta == 0.0)
      exact_state(batch, instant(grid, double(first + i)), block, i);
}

/// Samples `first` to `last` of a grid one by one.
template <class Sink>
void run_direct(const PairBatch& batch, const UniformGrid& grid, std::size_t first,
                std::size_t last, Sink& sink) {
  const auto& c = batch.constants();
  Block block;
  for (std::size_t i = first; i < last; i += block_size) {
    const std::size_t count = std::min(block_size, last - i);
    const bool elastic = c.log2_eta.hi == 0.0;
    if (c.long_phase)
      elastic ? direct_block<Kind<true, true, true>>(batch, grid, i, count, block)
              : direct_block<Kind<true, false, true>>(batch, grid, i, count, block);
    else
      elastic ? direct_block<Kind<false, true, true>>(batch, grid, i, count, block)
              : direct_block<Kind<false, false, true>>(batch, grid, i, count, block);
    sink.take_some(i, block, count);
  }
}

/// For fewer samples the table takes longer than one by one would.
inline constexpr std::size_t fewest = 2 * block_size;

/// The number of samples, from the first of the grid on, that blocks may be used for.
inline std::size_t count_for_blocks(const BatchConstants& c, const UniformGrid& grid) {
  const bool elastic = c.log2_eta.hi == 0.0;
  const double halvings = c.decay.hi * grid.step * double(block_size);
  if (!elastic || halvings > 13.0 || grid.start > c.plain_end || grid.count < fewest) return 0;
  const double steps = (c.plain_end - grid.start) / grid.step;
  if (steps >= double(grid.count)) return grid.count;
  // Two less, for what the division rounds.
  return steps > 2.0 ? static_cast<std::size_t>(steps) - 2 : 0;
}

/// Gives `sink` the samples from `first` on, in order.
template <class Sink>
void run_grid(const PairBatch& batch, const UniformGrid& grid, std::size_t first, Sink& sink) {
  const Doubles d;
  const auto& c = batch.constants();
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t last = std::max(first, count_for_blocks(c, grid));
  if (first < last) {
    const Vector side = And(constant(c.slow.b.hi), constant(-0.0));
    TurnTable table;
    fill_table(all_lanes(pair_turn(batch.flight(), {grid.step, 0.0})), table);
    // Exact: 64 is a power of two.
    Turns step = all_lanes(pair_turn(batch.flight(), {grid.step * double(block_size), 0.0}));
    const Turns lane = lane_turns(step);
    const Turns twice = multiply(step, step);
    Turns now[2];
    Anchors anchors;
    Block block;
    std::size_t at = first;
    for (std::size_t number = 0; at < last; number = (number + 2 * lanes) % fresh_after) {
      if (number == 0) {
        now[0] = multiply(lane, all_lanes(pair_turn(batch.flight(), instant(grid, double(at)))));
        now[1] = multiply(now[0], step);
      } else {
        for (auto& each : now) each = multiply(each, twice);
      }
      make_anchors(c, now, anchors);
      for (std::size_t i = 0; i < 2 * lanes && at < last; ++i, at += block_size) {
        const std::size_t count = std::min(block_size, last - at);
        if (count == block_size && HWY_LIKELY(run_block(table, anchors, i, side, at, sink)))
          continue;
        careful_block(batch, grid, table, anchors, i, side, at, count, block);
        sink.take_some(at, block, count);
      }
    }
  }
  run_direct(batch, grid, last, grid.count, sink);
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
