// Blocks of samples on a uniform grid. Compiled once for every target.
#include <hwy/highway.h>

#include <cstddef>

#include "clackers/exact/batch/batch_turns-inl.hpp"

#if defined(CLACKERS_BATCH_BLOCK) == defined(HWY_TARGET_TOGGLE)
#ifdef CLACKERS_BATCH_BLOCK
#undef CLACKERS_BATCH_BLOCK
#else
#define CLACKERS_BATCH_BLOCK
#endif

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {

// A grid is cut into blocks of 64 samples. The state at a block's first sample (its anchor), times
// a table of turns by 0, 1, ..., 63 steps, gives all of them: two multiplications and two additions
// for each mass and value, rounded as follows, in units of 2^-52 of the envelope: anchor 1/2, table
// 0.36, product 1/2, sum 1/2, together below 1.9. The anchors, as double-double numbers, are turned
// by 64 steps at a time, and come from the scalar closed form afresh every 4096 samples; both
// together are off by 2^-56.

/// One block of states in the kernel's order: u of the slow and of the fast mass, v of both.
struct Block {
  HWY_ALIGN double values[4][block_size];
};

// What a block's samples are made from, one a lane: for each mass u = uc C + us S, v = vc C + vs S
// with C and S from the table.
struct Anchors {
  static constexpr std::size_t most = 2 * hn::MaxLanes(Doubles());
  HWY_ALIGN double uc[2][most], us[2][most], vc[2][most], vs[2][most];
  // Where the slow mass is nearer to 0 the flight is not certain. Within a block E falls by 2^14 at
  // most, so |cos theta| >= 2^-32 is certain and more than 2^-18 never called uncertain.
  HWY_ALIGN double certain[most];
};

HWY_INLINE Pair all_lanes(const Factor& f) { return {constant(f.hi), constant(f.lo)}; }

/// The anchors of twice as many blocks as there are lanes: one turn alone would wait for itself.
HWY_NOINLINE inline void make_anchors(const BatchConstants& c, const Turns (&now)[2], Anchors& a) {
  const Doubles d;
  const BatchMass* const mass[2] = {&c.slow, &c.fast};
  for (int m = 0; m < 2; ++m) {
    const Pair b = all_lanes(mass[m]->b), v_cos = all_lanes(mass[m]->v_cos),
               v_sin = all_lanes(mass[m]->v_sin);
    for (std::size_t g = 0; g < 2; ++g) {
      const Pair &cosine = now[g].cosine[m], &sine = now[g].sine[m];
      const std::size_t at = g * hn::Lanes(d);
      const Vector uc = simd::multiply(b, cosine).hi, us = simd::multiply(b, sine).hi;
      hn::Store(uc, d, a.uc[m] + at);
      hn::Store(Neg(us), d, a.us[m] + at);
      if (m == 0)
        hn::Store(Mul(constant(0x1p-32), Add(hn::Abs(uc), hn::Abs(us))), d, a.certain + at);
      hn::Store(simd::dot(v_cos, cosine, v_sin, sine).hi, d, a.vc[m] + at);
      hn::Store(simd::dot(v_sin, cosine, minus(v_cos), sine).hi, d, a.vs[m] + at);
    }
  }
}

// A sink gives, for the block at `at`, a half<mass>(at) for the slow mass (0) and then for the fast
// one (1); its take(j, u, v) is given vectors of displacements and velocities from sample at + j on.
// keep<mass>(half) makes that final. take_some(at, block, count) is given the beginning of a block.
// Unless `signs` is set, signs may be wrong. Members of halves are no arrays, which GCC would leave
// in memory.

/// As many vectors as fill a line of the cache, so that streams are written by whole lines.
inline constexpr int line = hn::MaxLanes(Doubles()) < 8 ? int(8 / hn::MaxLanes(Doubles())) : 1;

/// The anchor of one mass in one block.
struct Anchor {
  Vector uc, us, vc, vs;
  HWY_INLINE Anchor(const Anchors& a, int mass, std::size_t lane)
      : uc(constant(a.uc[mass][lane])),
        us(constant(a.us[mass][lane])),
        vc(constant(a.vc[mass][lane])),
        vs(constant(a.vs[mass][lane])) {}
};

/// What a block's slow mass tells: the side it keeps to, how small its displacement gets.
struct SlowMass {
  Vector side, least;
  HWY_INLINE explicit SlowMass(Vector own_side) : side(own_side), least(constant(1e300)) {}
};

/// Samples j, j + 1, ... of one mass, a line of the cache. The slow mass finds the `flips` of signs
/// for the other.
template <int mass, bool signs, class Half>
HWY_INLINE void run_line(const TurnTable& table, const Anchor& a, std::size_t j, SlowMass& slow,
                         Vectors<line>& flips, Half& half) {
  const Doubles d;
  Vectors<line> u, v;
  for (int i = 0; i < line; ++i) {
    const std::size_t at = j + std::size_t(i) * hn::Lanes(d);
    const Vector c = hn::Load(d, table.cosine[mass] + at), s = hn::Load(d, table.sine[mass] + at);
    u[i] = MulAdd(a.uc, c, Mul(a.us, s));
    v[i] = MulAdd(a.vc, c, Mul(a.vs, s));
    if constexpr (mass == 0) {
      slow.least = Min(slow.least, hn::Abs(u[i]));
      // Each collision turns all signs, and the slow mass keeps to its side.
      if constexpr (signs) flips[i] = Xor(And(u[i], constant(-0.0)), slow.side);
    }
    if constexpr (signs) {
      u[i] = Xor(u[i], flips[i]);
      v[i] = Xor(v[i], flips[i]);
    }
  }
  half.template take<line>(j, u, v);
}

/// All samples of a block; for sinks that are `apart` one mass after the other.
template <class Sink, class Slow, class Fast>
HWY_INLINE void run_lines(const TurnTable& table, const Anchors& anchors, std::size_t lane,
                          SlowMass& state, Slow& slow, Fast& fast) {
  const Doubles d;
  const std::size_t step = line * hn::Lanes(d);
  const Anchor a(anchors, 0, lane), b(anchors, 1, lane);
  if constexpr (Sink::apart) {
    HWY_ALIGN double kept[block_size];
    CLACKERS_ROLLED
    for (std::size_t j = 0; j < block_size; j += step) {
      Vectors<line> flips;
      run_line<0, Sink::signs>(table, a, j, state, flips, slow);
      if constexpr (Sink::signs)
        for (std::size_t i = 0; i < line; ++i) hn::Store(flips[i], d, kept + j + i * hn::Lanes(d));
    }
    CLACKERS_ROLLED
    for (std::size_t j = 0; j < block_size; j += step) {
      Vectors<line> flips;
      if constexpr (Sink::signs)
        for (std::size_t i = 0; i < line; ++i) flips[i] = hn::Load(d, kept + j + i * hn::Lanes(d));
      run_line<1, Sink::signs>(table, b, j, state, flips, fast);
    }
  } else {
    CLACKERS_ROLLED
    for (std::size_t j = 0; j < block_size; j += step) {
      Vectors<line> flips;
      run_line<0, Sink::signs>(table, a, j, state, flips, slow);
      run_line<1, Sink::signs>(table, b, j, state, flips, fast);
    }
  }
}

/// Gives `sink` the block of anchor `lane`, in which every flight begins with the slow mass on its
/// own side. False, and nothing is kept, where a sample lies so close to a collision that its flight
/// is not certain.
template <class Sink>
HWY_NOINLINE bool run_block(const TurnTable& table, const Anchors& a, std::size_t lane, Vector side,
                            std::size_t at, Sink& sink) {
  SlowMass state(side);
  auto slow = sink.template half<0>(at);
  auto fast = sink.template half<1>(at);
  run_lines<Sink>(table, a, lane, state, slow, fast);
  const Vector certain = constant(a.certain[lane]);
  if (HWY_UNLIKELY(!hn::AllTrue(Doubles(), hn::Gt(state.least, certain)))) return false;
  sink.template keep<0>(slow);
  sink.template keep<1>(fast);
  return true;
}

/// Writes one mass into arrays; `stream` goes past the cache and needs aligned places.
template <bool stream>
struct HalfWriter {
  double *u_to, *v_to;
  template <int n>
  HWY_INLINE void take(std::size_t at, const Vector (&u)[n], const Vector (&v)[n]) const {
    put(u_to + at, u);
    put(v_to + at, v);
  }
  template <int n>
  static HWY_INLINE void put(double* array, const Vector (&x)[n]) {
    const Doubles d;
    for (std::size_t i = 0; i < std::size_t(n); ++i)
      if constexpr (stream)
        hn::Stream(x[i], d, array + i * hn::Lanes(d));
      else
        hn::StoreU(x[i], d, array + i * hn::Lanes(d));
  }
};

/// Writes into a block.
struct BlockWriter {
  static constexpr bool signs = true, apart = false;
  Block* block;
  template <int mass>
  HWY_INLINE HalfWriter<false> half(std::size_t at) const {
    return {block->values[mass] + at, block->values[2 + mass] + at};
  }
};

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
