#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/ball_matrix.hpp"

#include <arb_mat.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::certified {

BallVector solved(const BallVector& a, const BallVector& b) {
  const auto n = long(std::llround(std::sqrt(double(a.size())))), m = long(b.size()) / n;
  arb_mat_t left, right;
  arb_mat_init(left, n, n);
  arb_mat_init(right, n, m);
  for (long i = 0; i < n; ++i) {
    for (long j = 0; j < n; ++j)
      arb_set(arb_mat_entry(left, i, j), a[std::size_t(i * n + j)].get());
    for (long j = 0; j < m; ++j)
      arb_set(arb_mat_entry(right, i, j), b[std::size_t(i * m + j)].get());
  }
  const bool is_found = arb_mat_solve(right, left, right, WorkingBits::now()) != 0;
  BallVector x(b.size());
  for (long i = 0; i < n; ++i)
    for (long j = 0; j < m; ++j)
      arb_swap(x[std::size_t(i * m + j)].get(), arb_mat_entry(right, i, j));
  arb_mat_clear(left);
  arb_mat_clear(right);
  if (!is_found)
    throw InputError(
        "digits: a mass matrix or contacts that are nearly "
        "singular; allowed: others.",
        "no-enclosure");
  return x;
}

BallVector product(const BallVector& a, const BallVector& x) {
  BallVector y(a.size() / x.size());
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j)
      if (const Ball& entry = a[i * x.size() + j]; !entry.is_zero() && !x[j].is_zero())
        arb_addmul(y[i].get(), entry.get(), x[j].get(), WorkingBits::now());
  return y;
}

Ball largest(const BallVector& x) {
  Ball most;
  for (const auto& value : x)
    if (const Ball now = upper(value); most < now) most = now;
  return most;
}

}  // namespace clackers::certified

#endif
