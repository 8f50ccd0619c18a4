#include "clackers/exact/batch/batch.hpp"
#include "clackers/numerics/simd/wanted.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/batch/batch_reduce.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "clackers/exact/batch/batch_grid-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {

/// The largest magnitude and the sum of squares of one component.
struct Component {
  Vector largest, squares;

  // Written out, so that it is compiled for the target.
  HWY_INLINE Component() : largest(constant(0.0)), squares(largest) {}
  /// Squares of a line are summed apart: the running sum then waits once a line for itself.
  template <int n>
  HWY_INLINE void add(const Vector (&x)[n]) {
    Vector line_squares = Mul(x[0], x[0]);
    for (int i = 1; i < n; ++i) line_squares = MulAdd(x[i], x[i], line_squares);
    // NaN stays in the sum, while the largest forgets it.
    squares = Add(squares, line_squares);
    for (int i = 0; i < n; ++i) largest = hn::Max(largest, hn::Abs(x[i]));
  }
};

/// One mass of a block, less given states.
template <bool given>
struct HalfReducer {
  const double *u_from, *v_from;
  Component u, v;

  HWY_INLINE HalfReducer(const double* u_given, const double* v_given)
      : u_from(u_given), v_from(v_given) {}
  template <int n>
  HWY_INLINE void take(std::size_t at, Vector (&x)[n], Vector (&y)[n]) {
    if constexpr (given) subtract(u_from + at, x), subtract(v_from + at, y);
    u.add(x);
    v.add(y);
  }
  template <int n>
  static HWY_INLINE void subtract(const double* from, Vector (&x)[n]) {
    const Doubles d;
    for (std::size_t i = 0; i < std::size_t(n); ++i)
      x[i] = Sub(x[i], hn::LoadU(d, from + i * hn::Lanes(d)));
  }
};

/// Takes the largest magnitude and the sum of squares of the states, less given ones. Blocks are
/// summed apart, so that rounding grows with their number.
template <bool given>
struct Reducer {
  static constexpr bool signs = given, apart = true;
  const double* from[4];  ///< the given states in the kernel's order
  Vectors<4> largest, squares;

  HWY_INLINE explicit Reducer(const double* const (&values)[4]) {
    for (int i = 0; i < 4; ++i) {
      from[i] = values[i];
      largest[i] = squares[i] = constant(0.0);
    }
  }
  template <int mass>
  HWY_INLINE HalfReducer<given> half(std::size_t at) const {
    if constexpr (given) return {from[mass] + at, from[2 + mass] + at};
    return {nullptr, nullptr};
  }
  template <int mass>
  HWY_INLINE void keep(const HalfReducer<given>& part) {
    keep(mass, part.u);
    keep(2 + mass, part.v);
  }
  HWY_INLINE void keep(int i, const Component& part) {
    largest[i] = hn::Max(largest[i], part.largest);
    squares[i] = Add(squares[i], part.squares);
  }
  void take_some(std::size_t at, const Block& block, std::size_t count) {
    const Doubles d;
    HWY_ALIGN double x[hn::MaxLanes(Doubles())];
    for (int c = 0; c < 4; ++c) {
      Component own;
      for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        for (std::size_t j = 0; j < hn::Lanes(d); ++j) {
          const bool in = i + j < count;
          x[j] = in ? block.values[c][i + j] : 0.0;
          if constexpr (given)
            if (in) x[j] -= from[c][at + i + j];
        }
        const Vectors<1> one = {hn::Load(d, x)};
        own.add(one);
      }
      keep(c, own);
    }
  }
};

template <bool given>
void reduce(const PairBatch& batch, const UniformGrid& grid, const double* const (&from)[4],
            double* largest, double* squares) {
  const Doubles d;
  Reducer<given> sink(from);
  run_grid(batch, grid, 0, sink);
  for (int i = 0; i < 4; ++i) {
    squares[i] = hn::GetLane(hn::SumOfLanes(d, sink.squares[i]));
    const double most = hn::GetLane(hn::MaxOfLanes(d, sink.largest[i]));
    largest[i] = squares[i] != squares[i] ? squares[i] : most;
  }
}

std::int64_t reduce_grid(const PairBatch& batch, const UniformGrid& grid, const PairValues* given,
                         PairReduction& result) {
  const bool swap = batch.constants().exchanged;
  double l[4], s[4];
  const double* from[4] = {};
  if (given) {
    from[swap ? 1 : 0] = given->u1.data();
    from[swap ? 0 : 1] = given->u2.data();
    from[swap ? 3 : 2] = given->v1.data();
    from[swap ? 2 : 3] = given->v2.data();
    reduce<true>(batch, grid, from, l, s);
  } else {
    reduce<false>(batch, grid, from, l, s);
  }
  const auto ordered = [&](const double* x) {
    return swap ? PairState{x[1], x[0], x[3], x[2]} : PairState{x[0], x[1], x[2], x[3]};
  };
  result.largest = ordered(l);
  result.squares = ordered(s);
  return HWY_TARGET;
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

HWY_EXPORT(reduce_grid);

PairReduction PairBatch::errors(const UniformGrid& grid, const PairValues& given) const {
  require_size(given, grid.count);
  require_grid(grid, constants_.end);
  PairReduction result;
  result.ran = {HWY_DYNAMIC_DISPATCH(reduce_grid)(*this, grid, &given, result)};
  return result;
}

PairReduction PairBatch::norms(const UniformGrid& grid) const {
  require_grid(grid, constants_.end);
  PairReduction result;
  result.ran = {HWY_DYNAMIC_DISPATCH(reduce_grid)(*this, grid, nullptr, result)};
  return result;
}

}  // namespace clackers::exact
#endif
