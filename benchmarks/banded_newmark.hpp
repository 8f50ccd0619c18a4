#pragma once

#include <cstddef>
#include <vector>

namespace clackers::benchmarks {

/// A symmetric tridiagonal matrix.
struct Tridiagonal {
  std::vector<double> diagonal, below;  ///< below[i] is entry (i, i - 1)
  explicit Tridiagonal(std::size_t n) : diagonal(n), below(n) {}
};

/// Newmark's average acceleration for M a + 2 sigma M v + K u = 0 with tridiagonal matrices, as one
/// would write it in C: predictor, residual, one back-substitution with a factorization made once,
/// corrector.
class BandedNewmark {
 public:
  BandedNewmark(Tridiagonal mass, Tridiagonal stiffness, double sigma, double h,
                std::vector<double> u, std::vector<double> v);
  void step();
  const std::vector<double>& u() const { return u_; }

 private:
  Tridiagonal mass_, stiffness_, factor_;  // L D L^T, the diagonal inverted
  double sigma_, h_;
  std::vector<double> u_, v_, a_, f_;
};

}  // namespace clackers::benchmarks
