#include <cmath>
#include <numbers>

#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/runge_kutta/diagonally_implicit.hpp"

namespace clackers::methods {
namespace {

// Trapezoidal rule over g h, then x1 = x0 + h (q0 x'_0 + q1 x'_g + q2 x'_1).
DiagonallyImplicit composite(double g, double rho) {
  const double q1 = (rho + 1.0) / (2.0 * g * (rho - 1.0) + 4.0);
  const double q0 = (g - 1.0) * q1 + 0.5, q2 = 0.5 - g * q1;
  return {.stages = 3,
          .order = 2.0,
          .radius_at_infinity = rho,
          .table = {{{}, {0.5 * g, 0.5 * g}, {q0, q1, q2}}},
          .b = {q0, q1, q2}};
}

// The splitting with equal effective matrices of both parts.
double equal_parts(double rho) {
  return rho < 1.0 ? (2.0 - std::sqrt(2.0 + 2.0 * rho)) / (1.0 - rho) : 0.5;
}

DiagonallyImplicit implicit_midpoint() {
  return {.stages = 1, .order = 2.0, .radius_at_infinity = 1.0, .table = {{{0.5}}}, .b = {1.0}};
}

DiagonallyImplicit sdirk2() {
  constexpr double g = 1.0 - 0.5 * std::numbers::sqrt2;
  return {.stages = 2,
          .order = 2.0,
          .radius_at_infinity = 0.0,
          .table = {{{g}, {1.0 - g, g}}},
          .b = {1.0 - g, g}};
}

DiagonallyImplicit crouzeix() {
  const double g = 0.5 + std::sqrt(3.0) / 6.0;
  return {.stages = 2,
          .order = 3.0,
          .radius_at_infinity = std::sqrt(3.0) - 1.0,
          .table = {{{g}, {1.0 - 2.0 * g, g}}},
          .b = {0.5, 0.5}};
}

// g is the root of x³ - 3 x² + 3/2 x - 1/6 = 0 between 1/6 and 1/2.
DiagonallyImplicit sdirk3() {
  constexpr double g = 0.43586652150845899942;
  constexpr double b1 = -0.25 * (6.0 * g * g - 16.0 * g + 1.0),
                   b2 = 0.25 * (6.0 * g * g - 20.0 * g + 5.0);
  return {.stages = 3,
          .order = 3.0,
          .radius_at_infinity = 0.0,
          .table = {{{g}, {0.5 * (1.0 - g), g}, {b1, b2, g}}},
          .b = {b1, b2, g}};
}

}  // namespace

Facts DiagonallyImplicit::facts() const {
  return {
      .smooth_order = order, .stability_limit = always, .radius_at_infinity = radius_at_infinity};
}

std::vector<Row> diagonally_implicit_methods() {
  return rows<DiagonallyImplicit>({
      {"bathe",
       "Bathe's composite method: trapezoidal rule, then a backward difference of three points",
       {},
       [](Values) { return composite(0.5, 0.0); },
       R"(Bathe's composite method, two sub-steps of h/2, the equation of motion at the end of each:

    u_g = u0 + h/4 (v0 + v_g),         v_g = v0 + h/4 (a0 + a_g)
    v1  = (u0 - 4 u_g + 3 u1)/h,       a1  = (v0 - 4 v_g + 3 v1)/h

Order       2.
Stability   for every h.
Dissipation of high frequencies; all in one step at infinite omega h.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        two back-substitutions a step; two factorizations for each (system, h).
Source      K. J. Bathe, M. M. I. Baig, Comput. Struct. 83, 2513-2524 (2005).
)"},
      {"rho-infinity-bathe",
       "Bathe's composite method with dissipation set by rho",
       {{"rho", 0.5, 0.0, 1.0, "0 <= rho <= 1",
         "spectral radius at infinite omega h; 1: no dissipation"}},
       [](Values x) { return composite(equal_parts(x[0]), x[0]); },
       R"(Noh and Bathe's composite method, with rho the spectral radius at infinite omega h:

    u_g = u0 + g h/2 (v0 + v_g),                v_g = v0 + g h/2 (a0 + a_g)
    u1  = u0 + h (q0 v0 + q1 v_g + q2 v1),      v1  = v0 + h (q0 a0 + q1 a_g + q2 a1)
    q1 = (rho + 1)/(2 g (rho - 1) + 4), q0 = (g - 1) q1 + 1/2, q2 = 1/2 - g q1,
    g = [2 - sqrt(2 + 2 rho)]/(1 - rho), 1/2 for rho = 1

Order       2.
Stability   for every h.
Dissipation none for rho = 1, C = 0; grows as rho falls, for high frequencies first.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        two back-substitutions a step; one or two factorizations for each (system, h).
Source      G. Noh, K. J. Bathe, Comput. Struct. 212, 299-310 (2019).
)"},
      {"tr-bdf2",
       "trapezoidal rule, then a backward difference, with equal effective matrices",
       {},
       [](Values) { return composite(2.0 - std::numbers::sqrt2, 0.0); },
       R"(Trapezoidal rule over g h, g = 2 - sqrt(2), then a backward difference of three points:

    x_g = x0 + g h/2 (x'_0 + x'_g)
    x1  = x0 + h [sqrt(2)/4 (x'_0 + x'_g) + g/2 x'_1],   x = (u, v), x' = (v, a(t, u, v))

Order       2.
Stability   for every h.
Dissipation of high frequencies; all in one step at infinite omega h.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        two back-substitutions a step; one factorization for each (system, h).
Source      R. E. Bank et al., IEEE Trans. Electron Devices 32, 1992-2007 (1985).
)"},
      {"implicit-midpoint",
       "the implicit midpoint rule: Gauss' method of one stage",
       {},
       [](Values) { return implicit_midpoint(); },
       R"(The implicit midpoint rule, x_m = (x0 + x1)/2 for x = u, v:

    M (v1 - v0)/h + C v_m + K u_m + p(u_m, v_m) = f(t0 + h/2)
    u1 = u0 + h v_m

Order       2.
Stability   for every h.
Dissipation none for C = 0; quadratic invariants are kept.
Memory      none, but for the first guess of Newton's iteration.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, II.1.3 (2006).
)"},
      {"sdirk2",
       "Alexander's diagonally implicit Runge-Kutta method of two stages, order two",
       {},
       [](Values) { return sdirk2(); },
       R"(Alexander's method of two stages, g = 1 - sqrt(2)/2, x = (u, v), x' = (v, a(t, u, v)):

    x_1 = x0 + h g x'_1
    x1  = x0 + h [(1 - g) x'_1 + g x'(t0 + h, x1)]

Order       2.
Stability   for every h.
Dissipation of high frequencies; all in one step at infinite omega h.
Memory      none, but for the first guess of Newton's iteration.
Cost        two back-substitutions a step; one factorization for each (system, h).
Source      R. Alexander, SIAM J. Numer. Anal. 14, 1006-1021 (1977).
)"},
      {"crouzeix",
       "Crouzeix and Norsett's diagonally implicit Runge-Kutta method of two stages, order three",
       {},
       [](Values) { return crouzeix(); },
       R"(The method of two stages, g = 1/2 + sqrt(3)/6, x = (u, v), x' = (v, a(t, u, v)):

    x_1 = x0 + h g x'_1
    x_2 = x0 + h [(1 - 2 g) x'_1 + g x'_2]
    x1  = x0 + h/2 (x'_1 + x'_2),   c = (g, 1 - g)

Order       3.
Stability   for every h.
Dissipation of high frequencies; rho = sqrt(3) - 1 = 0.732 at infinite omega h.
Memory      none, but for the first guess of Newton's iteration.
Cost        two back-substitutions a step; one factorization for each (system, h).
Source      S. P. Norsett, Semi-explicit Runge-Kutta methods, Math. Comput. 6/74, Trondheim (1974).
)"},
      {"sdirk3",
       "Alexander's diagonally implicit Runge-Kutta method of three stages, order three",
       {},
       [](Values) { return sdirk3(); },
       R"(Alexander's method of three stages, g = 0.43587 the root of x³ - 3 x² + 3/2 x - 1/6 = 0 with
x = (u, v), x' = (v, a(t, u, v)):

    x_1 = x0 + h g x'_1
    x_2 = x0 + h [(1 - g)/2 x'_1 + g x'_2]
    x1  = x0 + h [b1 x'_1 + b2 x'_2 + g x'(t0 + h, x1)]
    b1  = -(6 g² - 16 g + 1)/4, b2 = (6 g² - 20 g + 5)/4

Order       3.
Stability   for every h.
Dissipation of high frequencies; all in one step at infinite omega h.
Memory      none, but for the first guess of Newton's iteration.
Cost        three back-substitutions a step; one factorization for each (system, h).
Source      R. Alexander, SIAM J. Numer. Anal. 14, 1006-1021 (1977).
)"},
  });
}

}  // namespace clackers::methods
