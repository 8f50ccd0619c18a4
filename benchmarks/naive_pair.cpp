// Compiled with -O3 and without -ffast-math, for the processor that the package is built for.
#include "benchmarks/naive_pair.hpp"

#include <cmath>

namespace clackers::benchmarks {

void naive_sample(const NaivePair& pair, const double* times, std::size_t count, double* u,
                  double* v) {
  const double xi1 = pair.xi1, omega = std::sqrt(1.0 - xi1 * xi1), omega2 = pair.X * omega;
  const double d2 = -3.0 / pair.X;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = times[i];
    const double c1 = std::cos(omega * t), s1 = std::sin(omega * t);
    const double c2 = std::cos(omega2 * t), s2 = std::sin(omega2 * t);
    const double sgn = c1 > 0.0 ? 1.0 : c1 < 0.0 ? -1.0 : 0.0, e = sgn * std::exp(-xi1 * t);
    u[2 * i] = c1 * e;
    u[2 * i + 1] = d2 * c2 * e;
    v[2 * i] = -(xi1 * c1 + omega * s1) * e;
    v[2 * i + 1] = -d2 * (xi1 * c2 + omega2 * s2) * e;
  }
}

}  // namespace clackers::benchmarks
