#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/digits.hpp"

#include <flint/fmpz.h>
#include <fmt/format.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::certified {
namespace {

class Whole {
 public:
  Whole() { fmpz_init(x_); }
  ~Whole() { fmpz_clear(x_); }
  Whole(const Whole&) = delete;
  Whole& operator=(const Whole&) = delete;
  fmpz* get() { return x_; }
  std::string text() const {
    std::string digits(fmpz_sizeinbase(x_, 10) + 2, '\0');
    fmpz_get_str(digits.data(), 10, x_);
    digits.resize(digits.find('\0'));
    return digits;
  }

 private:
  fmpz_t x_;
};

Ball floor_of(const Ball& x) {
  Ball whole;
  arb_floor(whole.get(), x.get(), WorkingBits::now());
  return whole;
}

bool is_whole(const Ball& x) { return arb_is_int(x.get()) != 0; }

// x 10^p
Ball shifted(const Ball& x, long long p) {
  const Ball tens = power(Ball(10.0), static_cast<unsigned long>(std::abs(p)));
  return p < 0 ? x / tens : x * tens;
}

// The largest e with 10^e <= x, or up to two below it.
long long low_exponent(const Ball& x) {
  const WorkingBits scope(128);
  Ball logarithm, log_10;
  arb_log(logarithm.get(), x.get(), WorkingBits::now());
  arb_const_log10(log_10.get(), WorkingBits::now());
  const double e = (logarithm / log_10).middle();
  constexpr double most = 1e15;  // doubles hold neighbouring exponents apart
  if (!(std::abs(e) < most))
    throw InputError(
        fmt::format("digits: a value is about 10^({:.3g}); allowed: 1e-1000000000000000 to "
                    "1e1000000000000000. Ask for times before the motion has decayed so far.",
                    e),
        "out-of-range");
  return static_cast<long long>(std::floor(e)) - 1;
}

// Whether z, no farther than its radius from a half, is that half: z^2 and the half's square are
// fractions with denominators below 2^bits 100^max(0, -p) and 4, so they are equal or farther apart
// than 1 over the product, and z is then farther from the half than that over 3 z < 3 100 10^digits.
bool must_be_half(const Ball& z, const Fraction& fraction, int digits, long long p) {
  const double log2_10 = std::log2(10.0);
  const double apart = fraction.bits + 2.0 * log2_10 * double(std::max(0LL, -p)) +
                       log2_10 * double(digits + 2) + 8.0;
  return apart < 1e15 && radius(z) < scaled(Ball(1.0), -std::lround(apart));
}

// z > 0 as a whole number, half to even, or nothing.
std::optional<std::string> rounded(const Ball& z, const std::optional<Fraction>& fraction,
                                   int digits, long long p) {
  const Ball raised = floor_of(z + 0.5);
  Whole n;
  bool half = false;
  if (arb_get_unique_fmpz(n.get(), raised.get()) != 0) {
    half = is_whole(z + 0.5);  // only when exact
  } else {
    // Between two whole numbers: the upper one is the whole number that z + 1/2 may be.
    if (!fraction || !must_be_half(z, *fraction, digits, p)) return {};
    if (arb_get_unique_fmpz(n.get(), floor_of(middle(z + 0.5) + 0.5).get()) == 0) return {};
    half = true;
  }
  if (half && fmpz_is_odd(n.get()) != 0) fmpz_sub_ui(n.get(), n.get(), 1);
  return n.text();
}

std::string written(bool negative, const std::string& digits, long long exponent) {
  const auto n = static_cast<long long>(digits.size());
  const std::string sign = negative ? "-" : "";
  if (exponent < -5 || exponent >= n)
    return fmt::format("{}{}{}{}e{:+03d}", sign, digits[0], n > 1 ? "." : "", digits.substr(1),
                       exponent);
  if (exponent < 0)
    return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  const auto whole = static_cast<std::size_t>(exponent + 1);
  return sign + digits.substr(0, whole) + (whole < digits.size() ? "." : "") + digits.substr(whole);
}

}  // namespace

std::optional<std::string> decimals(const Ball& value, int n,
                                    const std::optional<Fraction>& fraction) {
  if (value.is_zero()) return "0";
  if (value.holds_zero()) return {};
  const WorkingBits scope(WorkingBits::now() + 128);
  const Ball size = abs(value);
  const auto length = static_cast<std::size_t>(n);
  for (auto exponent = low_exponent(size);; ++exponent) {
    const long long p = n - 1 - exponent;
    const auto digits = rounded(shifted(size, p), fraction, n, p);
    if (!digits) return {};
    if (digits->size() == length) return written(value.is_negative(), *digits, exponent);
    // Too many digits: the exponent is larger. What was rounded up to a power of ten is so again.
  }
}

}  // namespace clackers::certified

#endif
