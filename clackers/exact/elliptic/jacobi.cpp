#include "clackers/exact/elliptic/jacobi.hpp"

#include <cmath>

namespace clackers::exact {

using numerics::Bounded;

Bounded quarter_period(const Modulus& modulus) {
  Bounded a = 1.0, b = modulus.complement;
  const Bounded half = 0.5;
  while (std::abs(a.value - b.value) > 1e-10L * a.value) {
    const auto mean = half * (a + b);
    b = sqrt(a * b);
    a = mean;
  }
  // The next mean; the one after it differs by the square of this difference.
  auto mean = half * (a + b);
  const long double apart = a.value - b.value;
  mean.error += apart * apart / a.value;
  return half * Bounded::pi() / mean;
}

Jacobi jacobi(const Bounded& u, const Modulus& modulus) {
  if (modulus.k.value < 1e-11L) {
    // To first order in k^2: sn = sin u - k^2/4 (u - sin u cos u) cos u, dn = 1 - k^2/2 sin^2 u.
    Jacobi now{sin(u), cos(u), 1.0};
    const long double square = modulus.k.value + modulus.k.error,
                      error = square * square * (1.0L + std::abs(u.value));
    now.sn.error += error;
    now.cn.error += error;
    now.dn.error += error;
    return now;
  }
  const Bounded one = 1.0;
  const auto sum = one + modulus.complement, k1 = modulus.k * modulus.k / (sum * sum);
  const auto low = jacobi(u / (one + k1), {k1, Bounded(2.0) * sqrt(modulus.complement) / sum});
  const auto square = k1 * low.sn * low.sn, below = one + square;
  return {(one + k1) * low.sn / below, low.cn * low.dn / below, (one - square) / below};
}

}  // namespace clackers::exact
