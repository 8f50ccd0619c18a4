#include "clackers/numerics/exp2.hpp"

namespace clackers::numerics::detail {
namespace {

// exp(x) for 0 <= x <= ln 2 by Taylor's series in Horner's form; the first term left out is
// below 2^-108. 1/n as a double-double from one Newton step.
constexpr DoubleDouble exponential(const DoubleDouble& x) {
  DoubleDouble sum{1.0, 0.0};
  for (int n = 26; n >= 1; --n) {
    const double head = 1.0 / n;
    const auto back = two_product(head, double(n));
    const DoubleDouble reciprocal{head, ((1.0 - back.hi) - back.lo) / n};
    sum = DoubleDouble{1.0, 0.0} + x * reciprocal * sum;
  }
  return sum;
}

constexpr std::array<DoubleDouble, 64> make_powers() {
  std::array<DoubleDouble, 64> table{};
  for (std::size_t i = 0; i < 64; ++i) table[i] = exponential(ln2 * (double(i) / 64.0));
  return table;
}

}  // namespace

constinit const std::array<DoubleDouble, 64> power_table = make_powers();

}  // namespace clackers::numerics::detail
