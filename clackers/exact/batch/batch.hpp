#pragma once

#include <cstddef>
#include <span>

#include "clackers/exact/batch/batch_constants.hpp"
#include "clackers/exact/batch/batch_flight.hpp"
#include "clackers/numerics/simd/target.hpp"

namespace clackers::exact {

/// Where a batch writes, or what it is compared with: displacements [m] and velocities [m/s] of
/// both masses, as many as there are times.
template <class Number>
struct PairArrays {
  std::span<Number> u1, u2, v1, v2;
};
using PairBuffers = PairArrays<double>;
using PairValues = PairArrays<const double>;

/// The instants start + k step, k = 0, 1, ..., count - 1, as real numbers: not rounded to doubles.
struct UniformGrid {
  double start = 0.0;  ///< [s], not negative
  double step = 0.0;   ///< [s], positive
  std::size_t count = 0;
};

/// What is left of many values: of each component the largest magnitude and the sum of squares
/// (relative error below (count / 64 + 100) 2^-53: 64 samples are summed apart; infinite if a square
/// exceeds the doubles). NaN among the values makes both NaN.
struct PairReduction {
  PairState largest;
  PairState squares;
  numerics::simd::Target ran;
};

/// The motion of a pair at many times at once, with the widest vectors of the processor. Const,
/// without allocation after construction, safe to share between threads.
///
/// Errors are in units of 2^-52 of each component's envelope (ClosedForm::envelope); beside them
/// two subnormal spacings are allowed. The flight is that which truly holds.
class PairBatch {
 public:
  /// Copies the constants. Throws InputError unless there are two masses that collide.
  explicit PairBatch(const FlightConstants& constants);

  /// The states at `times`, in any order, each within [0, end]; error at most 1.6 units for eta = 1
  /// and 0, 1.8 between. Where a time is the double nearest to a collision, `side` chooses the
  /// flight. Throws InputError for times outside (what was written then is undefined), and unless
  /// all arrays have one size. Returns what ran.
  numerics::simd::Target sample(std::span<const double> times, model::Side side,
                                const PairBuffers& out) const;

  /// The states on a grid; error at most 2.2 units. Outputs of more than 8 MiB go past the cache if
  /// all four arrays lie equally to the vector size. Throws InputError for a grid outside [0, end],
  /// and unless all arrays have its size. Returns what ran.
  numerics::simd::Target sample(const UniformGrid& grid, const PairBuffers& out) const;

  /// |exact - given| on a grid, without storing the exact.
  PairReduction errors(const UniformGrid& grid, const PairValues& given) const;

  /// |exact| on a grid.
  PairReduction norms(const UniformGrid& grid) const;

  const FlightConstants& flight() const { return flight_; }
  const BatchConstants& constants() const { return constants_; }

 private:
  FlightConstants flight_;
  BatchConstants constants_;
};

/// Throws InputError unless all four arrays have `size` elements.
template <class Number>
void require_size(const PairArrays<Number>& arrays, std::size_t size);

/// Throws InputError unless the grid lies within [0, end].
void require_grid(const UniformGrid& grid, double end);

/// The instant k of a grid.
numerics::DoubleDouble instant(const UniformGrid& grid, double k);

/// What turns a state by a duration, without regard to collisions: exp(-sigma t) cos(p Omega t) and
/// the sine, p = 1 and the fast mass's multiple, but both multiplied by (-1)^j with some whole j.
struct PairTurn {
  numerics::DoubleDouble cosine[2], sine[2];
};

/// The turn by t.hi + t.lo >= 0, error at most 2^-62 exp(-sigma t), which must be above 2^-960.
PairTurn pair_turn(const FlightConstants& c, const numerics::DoubleDouble& t);

}  // namespace clackers::exact
