#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

namespace clackers::numerics {

/// A number with a bound on its error: running error analysis in the widest floating-point type.
/// Each operation adds a unit of `rounding`, twice what the operation itself rounds, which covers the
/// rounding of the bound; elementary functions add two units, as the C library's documentation asks.
/// An error that leaves a quotient or a square root undefined becomes infinite.
/// Source: J. H. Wilkinson, Rounding Errors in Algebraic Processes (1963); N. J. Higham, Accuracy and
/// Stability of Numerical Algorithms, 2nd ed., SIAM (2002), section 3.3.
struct Bounded {
  static constexpr long double rounding = LDBL_EPSILON;

  long double value = 0.0L;
  long double error = 0.0L;  ///< |value - true| <= error

  Bounded() = default;
  Bounded(double exact) : value(exact) {}  // NOLINT(google-explicit-constructor)
  Bounded(long double v, long double e) : value(v), error(e) {}

  friend Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    return rounded(a.value * b.value,
                   std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
  }
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const long double least = std::abs(b.value) - b.error;
    const long double quotient = a.value / b.value;
    return rounded(quotient, least > 0.0L ? (a.error + std::abs(quotient) * b.error) / least
                                          : std::numeric_limits<long double>::infinity());
  }
  friend Bounded sin(const Bounded& x) { return rounded(std::sin(x.value), x.error, 2); }
  friend Bounded cos(const Bounded& x) { return rounded(std::cos(x.value), x.error, 2); }
  friend Bounded exp(const Bounded& x) {
    const long double e = std::exp(x.value);
    return rounded(e, e * std::expm1(x.error), 2);
  }
  friend Bounded expm1(const Bounded& x) {
    return rounded(std::expm1(x.value), std::exp(x.value) * std::expm1(x.error), 2);
  }
  friend Bounded sinh(const Bounded& x) {
    return rounded(std::sinh(x.value), std::cosh(std::abs(x.value) + x.error) * x.error, 2);
  }
  friend Bounded sqrt(const Bounded& x) {
    const long double root = std::sqrt(x.value);
    return rounded(root, x.error < x.value ? x.error / std::sqrt(x.value - x.error)
                         : x.error == 0.0L ? 0.0L
                                           : std::numeric_limits<long double>::infinity());
  }

  static Bounded pi() { return rounded(std::acos(-1.0L), 0.0L); }
  /// The double nearest to the value; never -0.
  double nearest() const { return static_cast<double>(value) + 0.0; }
  /// Bound on the error of nearest().
  double nearest_error() const {
    return static_cast<double>(error * (1.0L + 0x1p-20L)) + 0x1.000002p-53 * std::abs(nearest()) +
           std::numeric_limits<double>::denorm_min();
  }

 private:
  static Bounded rounded(long double value, long double error, int units = 1) {
    return {value, error + units * rounding * std::abs(value)};
  }
};

}  // namespace clackers::numerics
