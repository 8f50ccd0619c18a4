#include "clackers/exact/testing/real.hpp"

#include <array>
#include <stdexcept>

namespace clackers::exact::testing_oracle {

Real Real::value(auto function, const auto&... arguments) {
  Real result;
  function(result.x_, arguments..., MPFR_RNDN);
  return result;
}

Real::Real(const std::string& decimals) : Real() {
  char* end = nullptr;
  mpfr_strtofr(x_, decimals.c_str(), &end, 10, MPFR_RNDN);
  if (decimals.empty() || *end != '\0') throw std::invalid_argument("no number: " + decimals);
}

Real Real::operator-() const { return value(mpfr_neg, x_); }
Real operator+(const Real& a, const Real& b) { return Real::value(mpfr_add, a.x_, b.x_); }
Real operator-(const Real& a, const Real& b) { return Real::value(mpfr_sub, a.x_, b.x_); }
Real operator*(const Real& a, const Real& b) { return Real::value(mpfr_mul, a.x_, b.x_); }
Real operator/(const Real& a, const Real& b) { return Real::value(mpfr_div, a.x_, b.x_); }

Real abs(const Real& x) { return Real::value(mpfr_abs, x.x_); }
Real sqrt(const Real& x) { return Real::value(mpfr_sqrt, x.x_); }
Real exp(const Real& x) { return Real::value(mpfr_exp, x.x_); }
Real log(const Real& x) { return Real::value(mpfr_log, x.x_); }
Real sin(const Real& x) { return Real::value(mpfr_sin, x.x_); }
Real cos(const Real& x) { return Real::value(mpfr_cos, x.x_); }
Real tan(const Real& x) { return Real::value(mpfr_tan, x.x_); }
Real asin(const Real& x) { return Real::value(mpfr_asin, x.x_); }
Real acos(const Real& x) { return Real::value(mpfr_acos, x.x_); }
Real atan(const Real& x) { return Real::value(mpfr_atan, x.x_); }
Real atan2(const Real& y, const Real& x) { return Real::value(mpfr_atan2, y.x_, x.x_); }
Real pow(const Real& x, long power) { return Real::value(mpfr_pow_si, x.x_, power); }
Real ldexp(const Real& x, long power) { return Real::value(mpfr_mul_2si, x.x_, power); }
Real floor(const Real& x) {
  Real result;
  mpfr_floor(result.x_, x.x_);
  return result;
}
void sin_cos(const Real& x, Real& sine, Real& cosine) {
  mpfr_sin_cos(sine.x_, cosine.x_, x.x_, MPFR_RNDN);
}

std::ostream& operator<<(std::ostream& out, const Real& x) {
  std::array<char, 2 * Real::digits> text;
  mpfr_snprintf(text.data(), text.size(), "%.*Rg", static_cast<int>(out.precision()), x.x_);
  return out << text.data();
}

Real pi() {
  static const Real value = 2 * asin(Real(1));
  return value;
}

}  // namespace clackers::exact::testing_oracle
