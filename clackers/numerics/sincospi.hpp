#pragma once

#include <array>
#include <cstddef>

#include "clackers/numerics/double_double.hpp"

namespace clackers::numerics {

struct SineCosine {
  DoubleDouble sine, cosine;
};

namespace detail {
/// sin(pi i / 128) for i = 0, ..., 320: a whole turn, and a quarter more for the cosine.
extern const std::array<DoubleDouble, 321> sine_table;
}  // namespace detail

inline constexpr DoubleDouble pi{3.141592653589793116, 1.2246467991473531772e-16};

namespace detail {
/// Of a multiple of pi/128 the sine and the cosine, and the angle from there to pi y.
struct Tabled {
  DoubleDouble sine, cosine, rest;
};
inline Tabled tabled(const DoubleDouble& y) {
  const double nearest = nearest_whole(y.hi * 128.0);
  const auto index = static_cast<std::size_t>(static_cast<long long>(nearest) & 255);
  // The difference is exact: both are multiples of ulp(y.hi) or of 1/128 and cancel.
  return {sine_table[index], sine_table[index + 64],
          quick_two_sum(y.hi - nearest * 0.0078125, y.lo) * pi};
}
}  // namespace detail

/// sin(pi y) and cos(pi y) for |y| < 2^43, a count of half turns. Error at most 2^-63, and where
/// the true value is zero, at whole or half y, exactly zero.
inline SineCosine sincospi(const DoubleDouble& y) {
  const auto [s, c, z] = detail::tabled(y);

  // |z| <= pi/256. Terms left out: z^9/9! < 2^-75 and z^8/8! < 2^-66. The square is rounded to
  // 2^-53 z^2 < 2^-65 and drops 2 z.hi z.lo < 2^-65, half of which enters the cosine.
  const double zz = z.hi * z.hi;
  const double sine_rest = z.lo + z.hi * zz * (-1.0 / 6 + zz * (1.0 / 120 - zz * (1.0 / 5040)));
  const double cosine_rest = zz * (-0.5 + zz * (1.0 / 24 - zz * (1.0 / 720)));

  // sin(a + z) = s + [c sin z + s (cos z - 1)], cos(a + z) = c + [-s sin z + c (cos z - 1)]; the
  // brackets are below 2^-6 and their rounded parts below 2^-13, so rounding costs below 2^-65.
  const auto cz = two_product(c.hi, z.hi), sz = two_product(s.hi, z.hi);
  const auto sine = two_sum(s.hi, cz.hi), cosine = two_sum(c.hi, -sz.hi);
  return {quick_two_sum(sine.hi, sine.lo + (s.lo + cz.lo + c.lo * z.hi +
                                            (c.hi * sine_rest + s.hi * cosine_rest))),
          quick_two_sum(cosine.hi, cosine.lo + (c.lo - sz.lo - s.lo * z.hi +
                                                (c.hi * cosine_rest - s.hi * sine_rest)))};
}

/// The same with an error of at most 2^-98.
SineCosine precise_sincospi(const DoubleDouble& y);

}  // namespace clackers::numerics
