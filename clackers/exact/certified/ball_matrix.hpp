#pragma once

#include <cstddef>
#include <vector>

#include "clackers/exact/certified/ball.hpp"

namespace clackers::certified {

using BallVector = std::vector<Ball>;

/// X with A X = B; both row by row. Throws InputError (no-enclosure) where A is nearly singular.
BallVector solved(const BallVector& a, const BallVector& b);
/// Of a matrix, row by row, and a vector.
BallVector product(const BallVector& a, const BallVector& x);
/// A bound on the size of every entry.
Ball largest(const BallVector& x);
/// The entries of n velocities behind n displacements.
inline BallVector velocities(const BallVector& y, std::size_t n) {
  return {y.begin() + long(n), y.begin() + long(2 * n)};
}

}  // namespace clackers::certified
