#include "clackers/input/text/printed_digits.hpp"

namespace clackers::input {

double PrintedDigits::half_unit() const {
  if (!(largest_ > 0.0)) return 0.0;
  // Half a unit in the last place of a float of that size is at most 2^-24 of it.
  if (single_precision()) return std::ldexp(largest_, -24);
  if (digits_ >= std::numeric_limits<double>::max_digits10) return 0.0;
  // From the decimal text of a number 10^e <= x < 10^(e+1) with n digits; floor(log10) may err by
  // one next to a power of ten, which errs by a factor 10 only for that one size.
  const int exponent = static_cast<int>(std::floor(std::log10(largest_)));
  return 0.5 * std::pow(10.0, exponent - digits_ + 1);
}

}  // namespace clackers::input
