#include <cmath>

#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/runge_kutta/coupled_stages.hpp"

namespace clackers::methods {
namespace {

const double q = std::sqrt(6.0);

Radau radau3() {
  Radau m;
  m.table = {.stages = 2, .a = {{{5.0 / 12, -1.0 / 12}, {3.0 / 4, 1.0 / 4}}}};
  return m;
}

Radau radau5() {
  Radau m;
  m.table = {.stages = 3,
             .a = {{{(88 - 7 * q) / 360, (296 - 169 * q) / 1800, (-2 + 3 * q) / 225},
                    {(296 + 169 * q) / 1800, (88 + 7 * q) / 360, (-2 - 3 * q) / 225},
                    {(16 - q) / 36, (16 + q) / 36, 1.0 / 9}}}};
  return m;
}

ExactFlow flow(const Squaring& squaring,
               void (*make)(const LinearSystem&, const Squaring&, LinearStep&),
               ExactUnder exact_under) {
  ExactFlow m;
  m.squaring = squaring;
  m.make = make;
  m.exact_under = exact_under;
  return m;
}

}  // namespace

Facts Radau::facts() const {
  return {.smooth_order = 2.0 * table.stages - 1.0,
          .stability_limit = always,
          .radius_at_infinity = 0.0};
}

Facts ExactFlow::facts() const {
  return {.smooth_order = 4.0,
          .is_linear_only = true,
          .stability_limit = always,
          .radius_at_infinity = 1.0,
          .exact_under = exact_under};
}

std::vector<Row> coupled_stages_methods() {
  return {
      row<Radau>(
          {"radau-iia-3",
           "Radau's implicit Runge-Kutta method of two stages, order three",
           {},
           [](Values) { return radau3(); },
           R"(Radau's method IIA of two stages on x = (u, v), x' = (v, a(t, u, v)), with a fixed step:

    x_1 = x0 + h (5/12 x'_1 - 1/12 x'_2),   at t0 + h/3
    x1  = x0 + h (3/4 x'_1 + 1/4 x'_2),     at t0 + h

The accelerations of both stages are one system of equations: solved once for each (system, h), or
with p by Newton's iteration down to rounding.

Order       3.
Stability   for every h.
Dissipation of high frequencies; all in one step at infinite omega h.
Memory      none.
Cost        one product with a matrix of twice the size a step; one factorization for each
            (system, h).
Source      B. L. Ehle, SIAM J. Math. Anal. 4, 671-680 (1973).
)"}),
      row<Radau>(
          {"radau-iia-5",
           "Radau's implicit Runge-Kutta method of three stages, order five",
           {},
           [](Values) { return radau5(); },
           R"(Radau's method IIA of three stages on x = (u, v), x' = (v, a(t, u, v)), with a fixed step and
q = sqrt(6):

    x_1 = x0 + h [(88 - 7 q)/360 x'_1 + (296 - 169 q)/1800 x'_2 + (-2 + 3 q)/225 x'_3]
    x_2 = x0 + h [(296 + 169 q)/1800 x'_1 + (88 + 7 q)/360 x'_2 + (-2 - 3 q)/225 x'_3]
    x1  = x0 + h [(16 - q)/36 x'_1 + (16 + q)/36 x'_2 + 1/9 x'_3]

at t0 + (4 - q)/10 h, t0 + (4 + q)/10 h, t0 + h. The accelerations of all stages are one system of
equations: solved once for each (system, h), or with p by Newton's iteration down to rounding.

Order       5.
Stability   for every h.
Dissipation of high frequencies; all in one step at infinite omega h.
Memory      none.
Cost        one product with a matrix of twice the size a step; one factorization for each
            (system, h).
Source      E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.5 (1996).
)"}),
      row<ExactFlow>({"precise-integration",
                      "Zhong and Williams' method: exact free motion, the load by Gauss' rule",
                      {},
                      [](Values) {
                        return flow({.terms = 4, .part = 0x1p-20, .least = 20}, make_gauss_step,
                                    ExactUnder::no_load);
                      },
                      R"(Precise integration of x = (u, v), x' = H x + r(t), r = (0, M^-1 f):

    x1  = T(h) x0 + h/2 sum_k T(h - c_k h) r(t0 + c_k h),   c = 1/2 -+ sqrt(3)/6
    T_a = d + d²/2 + d³/6 + d⁴/24,   d = H h/2^N,   N = 20 or more
    N times  T_a <- 2 T_a + T_a T_a,   T = I + T_a

N is such that the motion turns by less than 2^-20 in h/2^N.

Order       4, that of Gauss' rule of two points for the load; free motion is exact to rounding.
Stability   for every h.
Dissipation none for C = 0.
Memory      none.
Cost        one product with a matrix of twice the size a step; three matrix exponentials for each
            (system, h).
Source      W. X. Zhong, F. W. Williams, Proc. Inst. Mech. Eng. C 208, 427-430 (1994).
)"}),
      row<ExactFlow>({"exponential",
                      "exponential integrator: exact free motion, the load as a line in the step",
                      {},
                      [](Values) {
                        return flow({.terms = 12, .part = 0.25, .least = 0}, make_line_step,
                                    ExactUnder::constant_load);
                      },
                      R"(The exponential integrator of x = (u, v), x' = H x + r(t), r = (0, M^-1 f):

    x1 = exp(H h) x0 + integral over the step of exp(H (t0 + h - t)) r*(t),
    r* the line through r at the points t0 + (1/2 -+ sqrt(3)/6) h of Gauss

The integral is that of the line itself, of whatever omega h, by the functions phi_1 and phi_2, which
are parts of the exponential of one larger matrix.

Order       4, that of the two points; free motion, and the motion under a load that is a line, are
            exact to rounding.
Stability   for every h.
Dissipation none for C = 0.
Memory      none.
Cost        one product with a matrix of twice the size a step; one matrix exponential for each
            (system, h).
Source      M. Hochbruck, A. Ostermann, Acta Numerica 19, 209-286 (2010).
)"})};
}

}  // namespace clackers::methods
