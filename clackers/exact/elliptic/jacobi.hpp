#pragma once

namespace clackers::exact {

/// The modulus k of elliptic functions with its complement: k^2 + k'^2 = 1, 0 <= k < 1. Both are given, since
/// either loses digits beside the other. Here and below in numbers that bound their errors: numerics::Bounded or
/// certified::Ball.
template <class Real>
struct Modulus {
  Real k, complement;
};

/// The complete integral of the first kind, pi/2 over the arithmetic-geometric mean of 1 and k'.
template <class Real>
Real quarter_period(const Modulus<Real>& modulus) {
  return Real::pi() / (Real(2.0) * agm(Real(1.0), modulus.complement));
}

template <class Real>
struct Jacobi {
  Real sn, cn, dn;
};
/// Jacobi's functions of a real argument, by Landen's descending transformation: with k1 = k^2/(1 + k')^2
/// and s1, c1, d1 those of u/(1 + k1), k1
///
///     sn = (1 + k1) s1/(1 + k1 s1^2),  cn = c1 d1/(1 + k1 s1^2),  dn = (1 - k1 s1^2)/(1 + k1 s1^2)
///
/// until the modulus has no effect. Source: M. Abramowitz, I. A. Stegun (1964), 16.12, 16.13.
template <class Real>
Jacobi<Real> jacobi(const Real& u, const Modulus<Real>& modulus) {
  const Real one = 1.0, square = modulus.k * modulus.k;
  if (square.is_negligible()) {
    // To first order in k^2: sn = sin u - k^2/4 (u - sin u cos u) cos u, dn = 1 - k^2/2 sin^2 u.
    const Real error = square * (one + abs(u));
    return {widened(sin(u), error), widened(cos(u), error), widened(one, error)};
  }
  const Real sum = one + modulus.complement, k1 = square / (sum * sum);
  const auto low = jacobi<Real>(u / (one + k1), {k1, Real(2.0) * sqrt(modulus.complement) / sum});
  const Real part = k1 * low.sn * low.sn, below = one + part;
  return {(one + k1) * low.sn / below, low.cn * low.dn / below, (one - part) / below};
}

}  // namespace clackers::exact
