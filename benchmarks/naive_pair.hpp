#pragma once

#include <cstddef>

namespace clackers::benchmarks {

/// The parameters of Eq. (25), X standing for 4N + 1.
struct NaivePair {
  double xi1, X;
};

/// Displacements and velocities of both masses.
struct NaiveArrays {
  double *u1, *u2, *v1, *v2;
};

/// The largest magnitudes and the sums of squares of u1, u2, v1, v2.
struct NaiveReduction {
  double largest[4] = {}, squares[4] = {};
};

/// Eq. (26) and its derivative, typed in as it is printed, with the sine and cosine of <cmath>.
void naive_sample(const NaivePair& pair, const double* times, std::size_t count,
                  const NaiveArrays& out);
/// The same at start + k step.
void naive_grid(const NaivePair& pair, double start, double step, std::size_t count,
                const NaiveArrays& out);
/// The same, reduced and not stored.
NaiveReduction naive_norms(const NaivePair& pair, double start, double step, std::size_t count);
NaiveReduction naive_errors(const NaivePair& pair, double start, double step, std::size_t count,
                            const NaiveArrays& given);

}  // namespace clackers::benchmarks
