#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/structural/structure_dependent.hpp"

namespace clackers::methods {
namespace {

KrAlpha kr_alpha(double rho) {
  KrAlpha m;
  m.rho = rho;
  return m;
}

}  // namespace

Facts Chang::facts() const {
  return {.smooth_order = 2.0, .stability_limit = always, .radius_at_infinity = 1.0};
}

Facts KrAlpha::facts() const {
  return {.smooth_order = 1.0, .stability_limit = always, .radius_at_infinity = rho};
}

std::vector<Row> structure_dependent_methods() {
  return {
      row<Chang>({"chang",
                  "Chang's explicit method, stable for every step in linear motion",
                  {},
                  [](Values) { return Chang{}; },
                  R"(Chang's method, explicit in u, with the matrices of the linear part:

    D = M + h/2 C + h²/4 K
    u1 = u0 + D^-1 [(M + h/2 C) h v0 + h²/2 M a0]
    v1 = v0 + h/2 (a0 + a1)
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

Order       2.
Stability   for every h in linear motion; an internal force p that stiffens sets a limit.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        two back-substitutions a step; two factorizations for each (system, h).
Source      S.-Y. Chang, J. Eng. Mech. 133, 748-760 (2007).
)"}),
      row<KrAlpha>({"cr",
                    "Chen and Ricles' explicit method, stable for every step in linear motion",
                    {},
                    [](Values) { return kr_alpha(1.0); },
                    R"(The method of Chen and Ricles, with the matrices of the linear part:

    A  = 4 (4 M + 2 h C + h² K)^-1 M
    v1 = v0 + h A a0
    u1 = u0 + h v0 + h² A a0
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

The spectrum is that of average acceleration, but the stored v belongs to t - h/2: started from the
velocity at t0, and so after every impact, it is of order 1.

Order       1.
Stability   for every h in linear motion; an internal force p that stiffens sets a limit.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        two back-substitutions a step; two factorizations for each (system, h).
Source      C. Chen, J. M. Ricles, J. Eng. Mech. 134, 676-683 (2008).
)"}),
      row<KrAlpha>(
          {"kr-alpha",
           "Kolay and Ricles' explicit alpha method, dissipation set by rho",
           {{"rho", 0.5, 0.0, 1.0, "0 <= rho <= 1",
             "spectral radius at infinite omega h; 1: no dissipation"}},
           [](Values x) { return kr_alpha(x[0]); },
           R"(The method of Kolay and Ricles, with rho the spectral radius at infinite omega h and the matrices
of the linear part, x_m = (1 - alpha_f) x1 + alpha_f x0 for x = u, v, t:

    D  = M + gamma h C + beta h² K, A_1 = D^-1 M, A_2 = (1/2 + gamma) A_1,
    A_3 = D^-1 [alpha_m M + alpha_f (gamma h C + beta h² K)]
    v1 = v0 + h A_1 a0
    u1 = u0 + h v0 + h² A_2 a0
    M [(I - A_3) a1 + A_3 a0] + C v_m + K u_m + p(u_m, v_m) = f(t_m)
    alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1),
    gamma = 1/2 - alpha_m + alpha_f, beta = 1/(1 + rho)²

The spectrum is that of generalized-alpha, but the stored v belongs to t - gamma h: started from the
velocity at t0, and so after every impact, it is of order 1.

Order       1.
Stability   for every h in linear motion; an internal force p that stiffens sets a limit.
Dissipation none for rho = 1, C = 0; grows as rho falls, for high frequencies first.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        two back-substitutions a step; two factorizations for each (system, h).
Source      C. Kolay, J. M. Ricles, Earthq. Eng. Struct. Dyn. 43, 1361-1380 (2014).
)"})};
}

}  // namespace clackers::methods
