#pragma once

#include "clackers/numerics/bounded.hpp"

namespace clackers::exact {

/// The modulus k of elliptic functions with its complement: k^2 + k'^2 = 1, 0 <= k < 1. Both are given, since
/// either loses digits beside the other.
struct Modulus {
  numerics::Bounded k, complement;
};

/// The complete integral of the first kind, pi/2 over the arithmetic-geometric mean of 1 and k'.
numerics::Bounded quarter_period(const Modulus& modulus);

/// Jacobi's functions of a real argument, by Landen's descending transformation: with k1 = k^2/(1 + k')^2
/// and s1, c1, d1 those of u/(1 + k1), k1
///
///     sn = (1 + k1) s1/(1 + k1 s1^2),  cn = c1 d1/(1 + k1 s1^2),  dn = (1 - k1 s1^2)/(1 + k1 s1^2)
///
/// until the modulus has no effect. Source: M. Abramowitz, I. A. Stegun (1964), 16.12, 16.13.
struct Jacobi {
  numerics::Bounded sn, cn, dn;
};
Jacobi jacobi(const numerics::Bounded& u, const Modulus& modulus);

}  // namespace clackers::exact
