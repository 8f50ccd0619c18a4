#include "benchmarks/banded_newmark.hpp"

#include <utility>

namespace clackers::benchmarks {

BandedNewmark::BandedNewmark(Tridiagonal mass, Tridiagonal stiffness, double sigma, double h,
                             std::vector<double> u, std::vector<double> v)
    : mass_(std::move(mass)),
      stiffness_(std::move(stiffness)),
      factor_(u.size()),
      sigma_(sigma),
      h_(h),
      u_(std::move(u)),
      v_(std::move(v)),
      a_(u_.size()),
      f_(u_.size()) {
  const double m = 1.0 + h * sigma, k = 0.25 * h * h;
  for (std::size_t i = 0; i < u_.size(); ++i) {
    double pivot = m * mass_.diagonal[i] + k * stiffness_.diagonal[i];
    if (i > 0) {
      const double entry = m * mass_.below[i] + k * stiffness_.below[i];
      factor_.below[i] = entry * factor_.diagonal[i - 1];
      pivot -= entry * factor_.below[i];
    }
    factor_.diagonal[i] = 1.0 / pivot;
  }
}

void BandedNewmark::step() {
  const std::size_t n = u_.size();
  for (std::size_t i = 0; i < n; ++i) {
    u_[i] += h_ * v_[i] + 0.25 * h_ * h_ * a_[i];
    v_[i] += 0.5 * h_ * a_[i];
  }
  const double c = 2.0 * sigma_;
  for (std::size_t i = 0; i < n; ++i) {
    double f = -c * mass_.diagonal[i] * v_[i] - stiffness_.diagonal[i] * u_[i];
    if (i > 0) f -= c * mass_.below[i] * v_[i - 1] + stiffness_.below[i] * u_[i - 1];
    if (i + 1 < n) f -= c * mass_.below[i + 1] * v_[i + 1] + stiffness_.below[i + 1] * u_[i + 1];
    f_[i] = f;
  }
  for (std::size_t i = 1; i < n; ++i) f_[i] -= factor_.below[i] * f_[i - 1];
  a_[n - 1] = f_[n - 1] * factor_.diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;)
    a_[i] = f_[i] * factor_.diagonal[i] - factor_.below[i + 1] * a_[i + 1];
  for (std::size_t i = 0; i < n; ++i) {
    u_[i] += 0.25 * h_ * h_ * a_[i];
    v_[i] += 0.5 * h_ * a_[i];
  }
}

}  // namespace clackers::benchmarks
