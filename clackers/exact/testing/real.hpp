#pragma once

#include <mpfr.h>

#include <Eigen/Core>
#include <concepts>
#include <limits>
#include <ostream>
#include <string>

// For tests: numbers of 90 digits by MPFR. A class of its own, because Boost's templates of the same
// took most of the time in which the tests compile.
namespace clackers::exact::testing_oracle {

class Real {
 public:
  static constexpr int digits = 90, bits = 301;

  Real() { mpfr_custom_init_set(x_, MPFR_ZERO_KIND, 0, bits, limbs_); }
  Real(const Real& other) : Real() { mpfr_set(x_, other.x_, MPFR_RNDN); }
  Real(std::integral auto x) : Real() { mpfr_set_si(x_, static_cast<long>(x), MPFR_RNDN); }
  Real(double x) : Real() { mpfr_set_d(x_, x, MPFR_RNDN); }
  /// Throws std::invalid_argument unless all of it is a number.
  explicit Real(const std::string& decimals);
  Real& operator=(const Real& other) {
    mpfr_set(x_, other.x_, MPFR_RNDN);
    return *this;
  }

  explicit operator double() const { return mpfr_get_d(x_, MPFR_RNDN); }

  Real& operator+=(const Real& b) { return *this = *this + b; }
  Real& operator-=(const Real& b) { return *this = *this - b; }
  Real& operator*=(const Real& b) { return *this = *this * b; }
  Real& operator/=(const Real& b) { return *this = *this / b; }
  Real operator-() const;
  friend Real operator+(const Real& a, const Real& b);
  friend Real operator-(const Real& a, const Real& b);
  friend Real operator*(const Real& a, const Real& b);
  friend Real operator/(const Real& a, const Real& b);
  friend bool operator==(const Real& a, const Real& b) { return mpfr_equal_p(a.x_, b.x_) != 0; }
  friend bool operator<(const Real& a, const Real& b) { return mpfr_less_p(a.x_, b.x_) != 0; }
  friend bool operator>(const Real& a, const Real& b) { return b < a; }
  friend bool operator<=(const Real& a, const Real& b) { return mpfr_lessequal_p(a.x_, b.x_) != 0; }
  friend bool operator>=(const Real& a, const Real& b) { return b <= a; }

  friend Real abs(const Real& x);
  friend Real floor(const Real& x);
  friend Real sqrt(const Real& x);
  friend Real exp(const Real& x);
  friend Real log(const Real& x);
  friend Real sin(const Real& x);
  friend Real cos(const Real& x);
  friend Real tan(const Real& x);
  friend Real asin(const Real& x);
  friend Real acos(const Real& x);
  friend Real atan(const Real& x);
  friend Real atan2(const Real& y, const Real& x);
  friend void sin_cos(const Real& x, Real& sine, Real& cosine);
  friend Real pow(const Real& x, long power);
  friend Real ldexp(const Real& x, long power);
  friend bool isfinite(const Real& x) { return mpfr_number_p(x.x_) != 0; }
  friend bool isinf(const Real& x) { return mpfr_inf_p(x.x_) != 0; }
  friend bool isnan(const Real& x) { return mpfr_nan_p(x.x_) != 0; }
  friend std::ostream& operator<<(std::ostream& out, const Real& x);

 private:
  static Real value(auto function, const auto&... arguments);

  // Not on the heap, and nothing to destroy.
  mp_limb_t limbs_[(bits - 1) / GMP_NUMB_BITS + 1];
  mpfr_t x_;
};

Real pi();

using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

}  // namespace clackers::exact::testing_oracle

template <>
struct std::numeric_limits<clackers::exact::testing_oracle::Real> {
  using Real = clackers::exact::testing_oracle::Real;
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false;
  static constexpr int digits = Real::bits, digits10 = Real::digits;
  static Real epsilon() { return ldexp(Real(1), 1 - digits); }
  static Real min() { return ldexp(Real(1), -(1L << 30)); }
  static Real max() { return ldexp(Real(1), 1L << 30); }
  static Real lowest() { return -max(); }
  static Real infinity() { return numeric_limits<double>::infinity(); }
  static Real quiet_NaN() { return numeric_limits<double>::quiet_NaN(); }
};

template <>
struct Eigen::NumTraits<clackers::exact::testing_oracle::Real>
    : Eigen::GenericNumTraits<clackers::exact::testing_oracle::Real> {
  enum { RequireInitialization = 1, ReadCost = 10, AddCost = 30, MulCost = 90 };
};
