#pragma once

#include <arb.h>

#include <string>
#include <utility>

namespace clackers::certified {

/// The bits that operations on balls of this thread carry, for as long as this lives. Without one
/// they carry 64.
class WorkingBits {
 public:
  explicit WorkingBits(long bits) : before_(std::exchange(bits_, bits)) {}
  ~WorkingBits() { bits_ = before_; }
  WorkingBits(const WorkingBits&) = delete;
  WorkingBits& operator=(const WorkingBits&) = delete;
  static long now() { return bits_; }

 private:
  inline static thread_local long bits_ = 64;
  long before_;
};

/// An interval [mid - rad, mid + rad] of real numbers, by Arb (F. Johansson, IEEE Trans. Comput.
/// 66 (8), 1281-1292 (2017)): each operation holds every result for every number of its operands.
/// Exponents have no bounds.
class Ball {
 public:
  Ball() { arb_init(x_); }
  Ball(double exactly) : Ball() { arb_set_d(x_, exactly); }  // NOLINT: a double is a ball
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  Ball& operator=(Ball other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  static Ball pi() {
    Ball c;
    arb_const_pi(c.get(), WorkingBits::now());
    return c;
  }

  arb_ptr get() { return x_; }
  arb_srcptr get() const { return x_; }

  bool is_zero() const { return arb_is_zero(x_) != 0; }           ///< exactly 0
  bool is_positive() const { return arb_is_positive(x_) != 0; }   ///< certainly > 0
  bool is_negative() const { return arb_is_negative(x_) != 0; }   ///< certainly < 0
  bool holds_zero() const { return arb_contains_zero(x_) != 0; }  ///< perhaps 0
  bool holds(double value) const { return arb_contains(x_, Ball(value).x_) != 0; }
  /// Whether 1 + x is 1 to a part of the rounding.
  bool is_negligible() const {
    return arb_is_zero(x_) || arf_cmpabs_2exp_si(arb_midref(x_), -WorkingBits::now() - 10) < 0;
  }
  /// Certain bits: -log2 of the radius relative to the middle; huge when exact.
  long accuracy() const { return arb_rel_accuracy_bits(x_); }
  /// The middle to the nearest double.
  double middle() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }

 private:
  arb_t x_;
};

inline Ball operator+(const Ball& a, const Ball& b) {
  Ball c;
  arb_add(c.get(), a.get(), b.get(), WorkingBits::now());
  return c;
}
inline Ball operator-(const Ball& a, const Ball& b) {
  Ball c;
  arb_sub(c.get(), a.get(), b.get(), WorkingBits::now());
  return c;
}
inline Ball operator*(const Ball& a, const Ball& b) {
  Ball c;
  arb_mul(c.get(), a.get(), b.get(), WorkingBits::now());
  return c;
}
inline Ball operator/(const Ball& a, const Ball& b) {
  Ball c;
  arb_div(c.get(), a.get(), b.get(), WorkingBits::now());
  return c;
}
inline Ball operator-(const Ball& a) {
  Ball c;
  arb_neg(c.get(), a.get());
  return c;
}
/// Certainly smaller.
inline bool operator<(const Ball& a, const Ball& b) { return arb_lt(a.get(), b.get()) != 0; }
inline bool operator>(const Ball& a, const Ball& b) { return b < a; }

inline Ball abs(const Ball& a) {
  Ball c;
  arb_abs(c.get(), a.get());
  return c;
}
inline Ball sqrt(const Ball& a) {
  Ball c;
  arb_sqrt(c.get(), a.get(), WorkingBits::now());
  return c;
}
inline Ball exp(const Ball& a) {
  Ball c;
  arb_exp(c.get(), a.get(), WorkingBits::now());
  return c;
}
inline Ball expm1(const Ball& a) {
  Ball c;
  arb_expm1(c.get(), a.get(), WorkingBits::now());
  return c;
}
inline Ball sinh(const Ball& a) {
  Ball c;
  arb_sinh(c.get(), a.get(), WorkingBits::now());
  return c;
}
inline Ball sin(const Ball& a) {
  Ball c;
  arb_sin(c.get(), a.get(), WorkingBits::now());
  return c;
}
inline Ball cos(const Ball& a) {
  Ball c;
  arb_cos(c.get(), a.get(), WorkingBits::now());
  return c;
}
inline Ball atan(const Ball& a) {
  Ball c;
  arb_atan(c.get(), a.get(), WorkingBits::now());
  return c;
}
/// The arithmetic-geometric mean of two positive numbers.
inline Ball agm(const Ball& a, const Ball& b) {
  Ball c;
  arb_agm(c.get(), a.get(), b.get(), WorkingBits::now());
  return c;
}
inline Ball power(const Ball& a, unsigned long n) {
  Ball c;
  arb_pow_ui(c.get(), a.get(), n, WorkingBits::now());
  return c;
}
/// The middle, exactly.
inline Ball middle(const Ball& a) {
  Ball c;
  arb_get_mid_arb(c.get(), a.get());
  return c;
}
/// How far the numbers of a are from its middle at most.
inline Ball radius(const Ball& a) {
  Ball c;
  arb_get_rad_arb(c.get(), a.get());
  return c;
}
/// A number without a radius that is at least |x| for every x of a.
inline Ball upper(const Ball& a) {
  Ball c;
  arb_get_abs_ubound_arf(arb_midref(c.get()), a.get(), WorkingBits::now());
  return c;
}
/// With a radius larger by the numbers of |more|.
inline Ball widened(Ball a, const Ball& more) {
  arb_add_error(a.get(), more.get());
  return a;
}
/// a 2^n, exactly.
inline Ball scaled(const Ball& a, long n) {
  Ball c;
  arb_mul_2exp_si(c.get(), a.get(), n);
  return c;
}

}  // namespace clackers::certified
