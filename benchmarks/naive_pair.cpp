// Compiled with -O3 and without -ffast-math, for the processor that the package is built for.
#include "benchmarks/naive_pair.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::benchmarks {
namespace {

struct State {
  double u1, u2, v1, v2;
};

inline double sgn(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

struct Formula {
  explicit Formula(const NaivePair& pair)
      : xi1(pair.xi1),
        omega(std::sqrt(1.0 - pair.xi1 * pair.xi1)),
        omega2(pair.X * omega),
        d2(-3.0 / pair.X) {}

  State operator()(double t) const {
    const double c1 = std::cos(omega * t), s1 = std::sin(omega * t);
    const double c2 = std::cos(omega2 * t), s2 = std::sin(omega2 * t);
    const double e = sgn(c1) * std::exp(-xi1 * t);
    return {c1 * e, d2 * c2 * e, -(xi1 * c1 + omega * s1) * e, -d2 * (xi1 * c2 + omega2 * s2) * e};
  }

  double xi1, omega, omega2, d2;
};

inline void put(const State& s, const NaiveArrays& out, std::size_t i) {
  out.u1[i] = s.u1;
  out.u2[i] = s.u2;
  out.v1[i] = s.v1;
  out.v2[i] = s.v2;
}

inline void take(const State& s, NaiveReduction& all) {
  const double x[4] = {s.u1, s.u2, s.v1, s.v2};
  for (int i = 0; i < 4; ++i) {
    all.largest[i] = std::max(all.largest[i], std::abs(x[i]));
    all.squares[i] += x[i] * x[i];
  }
}

}  // namespace

void naive_sample(const NaivePair& pair, const double* times, std::size_t count,
                  const NaiveArrays& out) {
  const Formula state(pair);
  for (std::size_t i = 0; i < count; ++i) put(state(times[i]), out, i);
}

void naive_grid(const NaivePair& pair, double start, double step, std::size_t count,
                const NaiveArrays& out) {
  const Formula state(pair);
  for (std::size_t i = 0; i < count; ++i) put(state(start + double(i) * step), out, i);
}

NaiveReduction naive_norms(const NaivePair& pair, double start, double step, std::size_t count) {
  const Formula state(pair);
  NaiveReduction all;
  for (std::size_t i = 0; i < count; ++i) take(state(start + double(i) * step), all);
  return all;
}

NaiveReduction naive_errors(const NaivePair& pair, double start, double step, std::size_t count,
                            const NaiveArrays& given) {
  const Formula state(pair);
  NaiveReduction all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto s = state(start + double(i) * step);
    take({s.u1 - given.u1[i], s.u2 - given.u2[i], s.v1 - given.v1[i], s.v2 - given.v2[i]}, all);
  }
  return all;
}

}  // namespace clackers::benchmarks
