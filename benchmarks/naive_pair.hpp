#pragma once

#include <cstddef>

namespace clackers::benchmarks {

/// The parameters of Eq. (25), X standing for 4N + 1.
struct NaivePair {
  double xi1, X;
};

/// Eq. (26) and its derivative, typed in as it is printed, with the sine and cosine of <cmath>: u and
/// v of both masses, row-major (time, mass).
void naive_sample(const NaivePair& pair, const double* times, std::size_t count, double* u,
                  double* v);

}  // namespace clackers::benchmarks
