#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/constants.hpp"
#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/structural/alpha_method.hpp"

namespace clackers::methods {
namespace {

// At infinite omega h the equilibrium leaves u1 = -alpha_f/(1 - alpha_f) u0, and a1 from the update
// of u leaves  x² - [2 - (gamma + 1/2)/beta] x + (beta + 1/2 - gamma)/beta = 0  for v and a.
double radius_at_infinity(const AlphaMethod& m) {
  const double half = 1.0 - 0.5 * (m.gamma + 0.5) / m.beta,
               product = (m.beta + 0.5 - m.gamma) / m.beta;
  const double under_root = half * half - product;
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * half * half;
  double pair = std::abs(half);
  if (under_root > rounding) pair += std::sqrt(under_root);
  if (under_root < -rounding) pair = std::sqrt(product);
  return std::max(pair, m.alpha_f / (1.0 - m.alpha_f));
}

bool is_plain(const AlphaMethod& m) { return m.alpha_m == 0.0 && m.alpha_f == 0.0; }

// The member with the largest dissipation of high frequencies that is of order 2 and stable for every h.
AlphaMethod second_order(double alpha_m, double alpha_f) {
  const double x = 1.0 - alpha_m + alpha_f;
  return {.beta = 0.25 * x * x, .gamma = x - 0.5, .alpha_m = alpha_m, .alpha_f = alpha_f};
}

}  // namespace

Facts AlphaMethod::facts() const {
  const double excess = gamma - (0.5 - alpha_m + alpha_f);
  // Rows with weighted equilibrium are stable for every h over the whole range of their parameter.
  const bool is_stable = !is_plain(*this) || 2.0 * beta >= gamma;
  return {.smooth_order = std::abs(excess) < 1e-15 ? 2.0 : 1.0,
          .stability_limit = is_stable ? always : 1.0 / std::sqrt(0.5 * gamma - beta),
          .radius_at_infinity = is_stable ? radius_at_infinity(*this) : nan,
          .exact_under = ExactUnder::constant_force};
}

std::vector<Row> alpha_methods() {
  const Range gamma{"gamma",
                    0.5,
                    0.5,
                    1.0,
                    "1/2 <= gamma <= 1",
                    "weight of the new acceleration in v",
                    "Below 1/2 undamped motion grows at every step size; use gamma = 0.5 for no "
                    "numerical dissipation."};
  return rows<AlphaMethod>({
      {"newmark",
       "Newmark's one-step family; average acceleration by default",
       {{"beta", 0.25, 0.0, 0.5, "0 <= beta <= 1/2", "weight of the new acceleration in u"}, gamma},
       [](Values x) { return AlphaMethod{.beta = x[0], .gamma = x[1]}; },
       R"(Newmark's one-step family for M a + C v + K u = f(t):

    u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
    v1 = v0 + h [(1 - gamma) a0 + gamma a1]
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

beta = 1/4: average acceleration, 1/6: linear acceleration, 1/12: Fox-Goodwin, 0: central
difference. With p the last line is solved by Newton's iteration down to rounding.

Order       2 for gamma = 1/2, otherwise 1.
Stability   for every h if 2 beta >= gamma >= 1/2; otherwise omega h <= (gamma/2 - beta)^(-1/2).
Dissipation none for gamma = 1/2, C = 0; grows with gamma.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (EM3), 67-94 (1959).
)"},
      {"average-acceleration",
       "Newmark's method with the mean of both accelerations: trapezoidal rule",
       {},
       [](Values) { return AlphaMethod{.beta = 0.25, .gamma = 0.5}; },
       R"(Newmark's method with beta = 1/4, gamma = 1/2, the trapezoidal rule:

    u1 = u0 + h v0 + h²/4 (a0 + a1)
    v1 = v0 + h/2 (a0 + a1)
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

Order       2.
Stability   for every h.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (EM3), 67-94 (1959).
)"},
      {"linear-acceleration",
       "Newmark's method with the acceleration linear in the step",
       {},
       [](Values) { return AlphaMethod{.beta = 1.0 / 6, .gamma = 0.5}; },
       R"(Newmark's method with beta = 1/6, gamma = 1/2:

    u1 = u0 + h v0 + h²/6 (2 a0 + a1)
    v1 = v0 + h/2 (a0 + a1)
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

Order       2.
Stability   omega h <= 2 sqrt(3) = 3.464.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (EM3), 67-94 (1959).
)"},
      {"fox-goodwin",
       "Newmark's method with beta = 1/12: the period to order four without damping",
       {},
       [](Values) { return AlphaMethod{.beta = 1.0 / 12, .gamma = 0.5}; },
       R"(Newmark's method with beta = 1/12, gamma = 1/2:

    u1 = u0 + h v0 + h²/12 (5 a0 + a1)
    v1 = v0 + h/2 (a0 + a1)
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

Order       2; the period is of order 4 for C = 0, f = 0.
Stability   omega h <= sqrt(6) = 2.449.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      L. Fox, E. T. Goodwin, Math. Proc. Camb. Phil. Soc. 45, 373-388 (1949).
)"},
      {"dissipative-newmark",
       "Newmark's method of order one with the largest dissipation of high frequencies",
       {{"gamma", 0.6, 0.5, 1.0, "1/2 <= gamma <= 1", "weight of the new acceleration in v"}},
       [](Values x) {
         return AlphaMethod{.beta = 0.25 * (x[0] + 0.5) * (x[0] + 0.5), .gamma = x[0]};
       },
       R"(Newmark's method with beta = (gamma + 1/2)²/4:

    u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
    v1 = v0 + h [(1 - gamma) a0 + gamma a1]
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

Order       1; 2 for gamma = 1/2.
Stability   for every h.
Dissipation grows with gamma, for all frequencies; rho = (3/2 - gamma)/(gamma + 1/2) at infinite
            omega h.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      T. J. R. Hughes, The Finite Element Method, 9.1.3, Prentice-Hall (1987).
)"},
      {"central-difference",
       "explicit central difference with the velocity at the end of the step",
       {},
       [](Values) { return AlphaMethod{.beta = 0.0, .gamma = 0.5}; },
       R"(Central difference in its one-step form, velocity at the end of the step:

    u1 = u0 + h v0 + h²/2 a0
    v1 = v0 + h/2 (a0 + a1)
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

This is Newmark's method with beta = 0, gamma = 1/2: explicit in u, implicit in C. The same u as
the two-step form (M/h² + C/2h) u1 = f - K u0 + M (2 u0 - u_-1)/h² + C u_-1/2h.

Order       2.
Stability   omega h <= 2.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization of M + h/2 C for each (system, h).
Source      N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (EM3), 67-94 (1959), with beta = 0.
)"},
      {"generalized-alpha",
       "generalised-alpha of Chung and Hulbert, dissipation of high frequencies set by rho",
       {{"rho", 1.0, 0.0, 1.0, "0 <= rho <= 1",
         "spectral radius at infinite omega h; 1: no dissipation"}},
       [](Values x) {
         return second_order((2.0 * x[0] - 1.0) / (x[0] + 1.0), x[0] / (x[0] + 1.0));
       },
       R"(Generalised-alpha, in the convention of Chung and Hulbert, with rho the spectral radius at
infinite omega h, x_m = (1 - alpha_f) x1 + alpha_f x0 for x = u, v, t:

    M [(1 - alpha_m) a1 + alpha_m a0] + C v_m + K u_m + p(u_m, v_m) = f(t_m)
    u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
    v1 = v0 + h [(1 - gamma) a0 + gamma a1]
    alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1),
    gamma = 1/2 - alpha_m + alpha_f, beta = (1 - alpha_m + alpha_f)²/4

Order       2 in u and v; the stored a is of order 1 at t, of order 2 at
            t + (alpha_m - alpha_f) h.
Stability   for every h.
Dissipation none for rho = 1, C = 0; grows as rho falls, for high frequencies first.
Memory      a0, taken from the last step; computed anew from equilibrium after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      J. Chung, G. M. Hulbert, J. Appl. Mech. 60, 371-375 (1993).
)"},
      {"hht-alpha",
       "Hilber, Hughes and Taylor's method, dissipation set by alpha",
       {{"alpha", -0.1, -1.0 / 3, 0.0, "-1/3 <= alpha <= 0",
         "weight of the start of the step in the equilibrium, negative; 0: no dissipation"}},
       [](Values x) { return second_order(0.0, -x[0]); },
       R"(The alpha method of Hilber, Hughes and Taylor, x_m = (1 + alpha) x1 - alpha x0 for x = u, v, t:

    M a1 + C v_m + K u_m + p(u_m, v_m) = f(t_m)
    u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
    v1 = v0 + h [(1 - gamma) a0 + gamma a1]
    gamma = 1/2 - alpha, beta = (1 - alpha)²/4

Some programs call 1 + alpha what is alpha here.

Order       2 in u and v; the stored a is of order 1.
Stability   for every h.
Dissipation none for alpha = 0, C = 0; rho = (1 + alpha)/(1 - alpha) at infinite omega h.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      H. M. Hilber, T. J. R. Hughes, R. L. Taylor, Earthq. Eng. Struct. Dyn. 5, 283-292 (1977).
)"},
      {"wbz-alpha",
       "Wood, Bossak and Zienkiewicz's method, dissipation set by rho",
       {{"rho", 0.8, 0.0, 1.0, "0 <= rho <= 1",
         "spectral radius at infinite omega h; 1: no dissipation"}},
       [](Values x) { return second_order((x[0] - 1.0) / (x[0] + 1.0), 0.0); },
       R"(The alpha method of Wood, Bossak and Zienkiewicz, with rho the spectral radius at infinite omega h:

    M [(1 - alpha_m) a1 + alpha_m a0] + C v1 + K u1 + p(u1, v1) = f(t0 + h)
    u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
    v1 = v0 + h [(1 - gamma) a0 + gamma a1]
    alpha_m = (rho - 1)/(rho + 1), gamma = 1/2 - alpha_m, beta = (1 - alpha_m)²/4

Order       2 in u and v; the stored a is of order 1.
Stability   for every h.
Dissipation none for rho = 1, C = 0; grows as rho falls, for high frequencies first.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      W. L. Wood, M. Bossak, O. C. Zienkiewicz, Int. J. Numer. Methods Eng. 15, 1562-1566 (1980).
)"},
  });
}

}  // namespace clackers::methods
