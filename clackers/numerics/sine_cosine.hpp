#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace clackers::numerics {

struct SineAndCosine {
  double sine, cosine;
};

/// sin x and cos x of any x, error at most 2^-52. Without a branch for |x| < 8e5, so that a
/// processor computes several at once. The kernels are those of FDLIBM (Sun Microsystems, 1993):
/// polynomials of degrees 13 and 14 on [-pi/4, pi/4].
inline SineAndCosine sine_cosine(double x) {
  if (!(std::abs(x) < 8e5)) return {std::sin(x), std::cos(x)};
  // The nearest multiple k of pi/2; the sum ends in the bits of k. k < 2^20 times the first 33 bits of
  // pi/2 is exact.
  constexpr double shift = 6755399441055744.0;  // 1.5 * 2^52
  constexpr double half_pi = 1.57079632673412561417, rest = 6.07710050650619224932e-11;
  const double shifted = x * 0.636619772367581343 + shift, k = shifted - shift;
  const auto quadrant = std::bit_cast<std::uint64_t>(shifted);
  const double r = (x - k * half_pi) - k * rest;

  const double z = r * r, zz = z * z;
  const double s = (-1.66666666666666324348e-01 + z * 8.33333333332248946124e-03) +
                   zz * ((-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06) +
                         zz * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10));
  const double c = (4.16666666666666019037e-02 - z * 1.38888888888741095749e-03) +
                   zz * ((2.48015872894767294178e-05 - z * 2.75573143513906633035e-07) +
                         zz * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11));
  const double sine = r + r * z * s, cosine = 1.0 - (0.5 * z - zz * c);

  // An odd quadrant exchanges them; the second bit is a sign.
  const std::uint64_t exchange = std::uint64_t(0) - (quadrant & 1);
  const auto a = std::bit_cast<std::uint64_t>(sine), b = std::bit_cast<std::uint64_t>(cosine);
  const std::uint64_t both = (a ^ b) & exchange;
  return {std::bit_cast<double>(a ^ both ^ ((quadrant & 2) << 62)),
          std::bit_cast<double>(b ^ both ^ (((quadrant + 1) & 2) << 62))};
}

}  // namespace clackers::numerics
