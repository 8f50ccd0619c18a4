#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace clackers::numerics {
namespace bounded {

using std::abs, std::acos, std::atan, std::cos, std::cosh, std::exp, std::expm1, std::sin,
    std::sinh, std::sqrt;

/// A number with a bound on its error: running error analysis in the floating-point type Real.
/// Each operation adds a unit of `rounding`, twice what the operation itself rounds, which covers the
/// rounding of the bound; elementary functions add two units, as the C library's documentation asks.
/// An error that leaves a quotient or a square root undefined becomes infinite.
/// Source: J. H. Wilkinson, Rounding Errors in Algebraic Processes (1963); N. J. Higham, Accuracy and
/// Stability of Numerical Algorithms, 2nd ed., SIAM (2002), section 3.3.
template <class Real>
struct BoundedOf {
  using Bounded = BoundedOf;

  Real value = 0;
  Real error = 0;  ///< |value - true| <= error

  BoundedOf() = default;
  BoundedOf(double exact) : value(exact) {}  // NOLINT(google-explicit-constructor)
  BoundedOf(Real v, Real e) : value(v), error(e) {}

  friend Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    return rounded(a.value * b.value,
                   abs(a.value) * b.error + abs(b.value) * a.error + a.error * b.error);
  }
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const Real least = abs(b.value) - b.error;
    const Real quotient = a.value / b.value;
    return rounded(quotient, least > Real(0) ? (a.error + abs(quotient) * b.error) / least
                                             : std::numeric_limits<Real>::infinity());
  }
  friend Bounded abs(const Bounded& x) { return {abs(x.value), x.error}; }
  friend Bounded min(const Bounded& a, const Bounded& b) {
    return {std::min(a.value, b.value), std::max(a.error, b.error)};
  }
  /// The larger of x and 0.
  friend Bounded positive_part(const Bounded& x) { return {std::max(Real(0), x.value), x.error}; }
  friend Bounded sin(const Bounded& x) { return rounded(sin(x.value), x.error, 2); }
  friend Bounded cos(const Bounded& x) { return rounded(cos(x.value), x.error, 2); }
  friend Bounded atan(const Bounded& x) {
    const Real least = std::max(Real(0), abs(x.value) - x.error);
    return rounded(atan(x.value), x.error / (Real(1) + least * least), 2);
  }
  friend Bounded exp(const Bounded& x) {
    const Real e = exp(x.value);
    return rounded(e, e * expm1(x.error), 2);
  }
  friend Bounded expm1(const Bounded& x) {
    return rounded(expm1(x.value), exp(x.value) * expm1(x.error), 2);
  }
  friend Bounded sinh(const Bounded& x) {
    return rounded(sinh(x.value), cosh(abs(x.value) + x.error) * x.error, 2);
  }
  friend Bounded sqrt(const Bounded& x) {
    const Real root = sqrt(x.value);
    return rounded(root, x.error < x.value    ? x.error / (root + sqrt(x.value - x.error))
                         : x.error == Real(0) ? Real(0)
                                              : std::numeric_limits<Real>::infinity());
  }

  /// The arithmetic-geometric mean of two positive numbers.
  friend Bounded agm(Bounded a, Bounded b) {
    const Bounded half = 0.5;
    const auto apart = [&] { return abs(a.value - b.value); };
    while (apart() > Real(1e-10) * a.value) {
      const auto mean = half * (a + b);
      b = sqrt(a * b);
      a = mean;
    }
    // The next mean; the one after it differs by the square of this difference.
    return widened(half * (a + b), Bounded(apart() * apart() / a.value, Real(0)));
  }
  /// The value without its error.
  friend Bounded middle(const Bounded& x) { return {x.value, Real(0)}; }
  /// At least |x|, without an error.
  friend Bounded upper(const Bounded& x) { return {abs(x.value) + x.error, Real(0)}; }
  /// With an error larger by |more|.
  friend Bounded widened(const Bounded& x, const Bounded& more) {
    return {x.value, x.error + abs(more.value) + more.error};
  }
  bool is_positive() const { return value > error; }  ///< certainly > 0
  /// Whether 1 + x is 1 to a part of the rounding.
  bool is_negligible() const {
    return abs(value) + error < std::numeric_limits<Real>::epsilon() * Real(0x1p-10);
  }

  static Bounded pi() { return rounded(acos(Real(-1)), Real(0)); }
  /// The double nearest to the value; never -0.
  double nearest() const { return static_cast<double>(value) + 0.0; }
  /// Bound on the error of nearest().
  double nearest_error() const {
    return static_cast<double>(error * Real(1.0 + 0x1p-20)) + 0x1.000002p-53 * std::abs(nearest()) +
           std::numeric_limits<double>::denorm_min();
  }

 private:
  static Bounded rounded(const Real& value, const Real& error, int units = 1) {
    return {value, error + units * std::numeric_limits<Real>::epsilon() * abs(value)};
  }
};

}  // namespace bounded

template <class Real>
using BoundedOf = bounded::BoundedOf<Real>;
/// In the widest type of the processor.
using Bounded = BoundedOf<long double>;

}  // namespace clackers::numerics
