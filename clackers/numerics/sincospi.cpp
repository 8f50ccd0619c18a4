#include "clackers/numerics/sincospi.hpp"

#include <array>

namespace clackers::numerics {
namespace {

// Taylor's series at 0 <= x <= pi/2; the 20th term is below 2^-110. Dividing by whole numbers is
// exact to 2^-104, as one Newton step from the double quotient is.
constexpr DoubleDouble divide(const DoubleDouble& x, double whole) {
  const double head = x.hi / whole;
  const auto back = two_product(head, whole);
  return quick_two_sum(head, ((x.hi - back.hi) - back.lo + x.lo) / whole);
}

constexpr DoubleDouble sine(const DoubleDouble& x) {
  const auto square = x * x;
  DoubleDouble term = x, sum = x;
  for (int n = 3; n < 41; n += 2) {
    term = -divide(term * square, double(n) * double(n - 1));
    sum = sum + term;
  }
  return sum;
}

// From the first quarter, so that the symmetries and the zeros are exact.
constexpr std::array<DoubleDouble, 321> make_sines() {
  std::array<DoubleDouble, 321> table{};
  for (std::size_t i = 0; i <= 64; ++i) {
    const auto s = i == 64 ? DoubleDouble{1.0, 0.0} : sine(pi * (double(i) / 128.0));
    table[i] = table[128 - i] = s;
    table[128 + i] = table[256 - i] = -s;
  }
  for (std::size_t i = 0; i <= 64; ++i) table[256 + i] = table[i];
  return table;
}

}  // namespace

namespace detail {
constinit const std::array<DoubleDouble, 321> sine_table = make_sines();
}

// The angle is below pi/256: terms left out are below 2^-130. Each rounding is 2^-103 of a product below 1.
SineCosine precise_sincospi(const DoubleDouble& y) {
  const auto [s, c, z] = detail::tabled(y);
  const auto square = z * z;
  DoubleDouble sine{1.0, 0.0}, cosine{1.0, 0.0};
  for (int n = 14; n > 0; n -= 2) {
    sine = DoubleDouble{1.0, 0.0} - divide(square * sine, double(n) * double(n + 1));
    cosine = DoubleDouble{1.0, 0.0} - divide(square * cosine, double(n) * double(n - 1));
  }
  sine = sine * z;
  return {s * cosine + c * sine, c * cosine - s * sine};
}

}  // namespace clackers::numerics
