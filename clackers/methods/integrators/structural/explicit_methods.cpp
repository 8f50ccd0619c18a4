#include "clackers/methods/integrators/structural/explicit_methods.hpp"

#include <cmath>

#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/stability.hpp"

namespace clackers::methods {
namespace {

// The parameters by the spectral radius at the bifurcation (Hulbert and Chung).
ExplicitAlpha explicit_alpha(double r) {
  ExplicitAlpha m;
  m.alpha_m = (2.0 * r - 1.0) / (1.0 + r);
  m.beta = (5.0 - 3.0 * r) / ((1.0 + r) * (1.0 + r) * (2.0 - r));
  m.gamma = 1.5 - m.alpha_m;
  // Where a root of the undamped step is -1.
  m.limit = std::sqrt(12.0 * (1.0 + r) * (2.0 - r) / (10.0 - 5.0 * r + r * r));
  return m;
}

TchamwaWielgosz tchamwa(double phi) {
  TchamwaWielgosz m;
  m.phi = phi;
  return m;
}

NohBathe noh_bathe(double p) {
  NohBathe m;
  m.p = p;
  return m;
}

}  // namespace

Facts TchamwaWielgosz::facts() const {
  return {.smooth_order = 1.0, .stability_limit = 2.0 / std::sqrt(2.0 * phi - 1.0)};
}

Facts NohBathe::facts() const {
  // The undamped step for (u, h v), a = -x² u.
  const auto radius = [this](double x) {
    const double r = 1.0 - p, w = x * x;
    double end[2][2];
    for (int i = 0; i < 2; ++i) {
      const double u = i == 0 ? 1.0 : 0.0, v = i == 0 ? 0.0 : 1.0;
      const double u_p = u + p * v - 0.5 * p * p * w * u;
      const double v_p = v - 0.5 * p * w * (u + u_p);
      const double u_1 = u_p + r * v_p - 0.5 * r * r * w * u_p;
      end[0][i] = u_1;
      end[1][i] = v_p - r * w * (q0() * u + (0.5 + q1()) * u_p + q2() * u_1);
    }
    return spectral_radius(end[0][0] + end[1][1], end[0][0] * end[1][1] - end[0][1] * end[1][0]);
  };
  return {.smooth_order = 2.0, .stability_limit = stability_limit(radius)};
}

std::vector<Row> explicit_methods() {
  return {
      row<VelocityVerlet>({"velocity-verlet",
                           "velocity Verlet, the velocity of damping forces predicted",
                           {},
                           [](Values) { return VelocityVerlet{}; },
                           R"(Velocity Verlet, a(t, u, v) = M^-1 [f(t) - C v - K u - p(u, v)]:

    u1 = u0 + h v0 + h²/2 a0
    a1 = a(t0 + h, u1, v0 + h a0)
    v1 = v0 + h/2 (a0 + a1)

Without damping it is central-difference; with damping it needs no solution. Programs that take the
velocity of the damping force at t0 + h/2 have order 1 with damping.

Order       2.
Stability   omega h <= 2 for C = 0; damping lowers it.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one force evaluation a step.
Source      W. C. Swope et al., J. Chem. Phys. 76, 637-649 (1982).
)"}),
      row<ExplicitAlpha>(
          {"explicit-generalized-alpha",
           "explicit generalised-alpha of Hulbert and Chung, dissipation set by rho",
           {{"rho", 0.8, 0.0, 1.0, "0 <= rho <= 1",
             "spectral radius where the roots become real; 1: no dissipation"}},
           [](Values x) { return explicit_alpha(x[0]); },
           R"(Explicit generalised-alpha, rho the spectral radius at the bifurcation of the roots:

    M [(1 - alpha_m) a1 + alpha_m a0] + C v0 + K u0 + p(u0, v0) = f(t0)
    u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
    v1 = v0 + h [(1 - gamma) a0 + gamma a1]
    alpha_m = (2 rho - 1)/(1 + rho), gamma = 3/2 - alpha_m,
    beta = (5 - 3 rho)/[(1 + rho)² (2 - rho)]

Order       2 in u and v; the stored a is of order 1. Where a force presses a mass on its contact,
            restarts after impacts that follow fast make errors scatter (by a factor 3.2).
Stability   omega h <= [12 (1 + rho) (2 - rho)/(10 - 5 rho + rho²)]^(1/2) for C = 0.
Dissipation grows as rho falls, for high frequencies first; none for rho = 1, C = 0.
Memory      a0, taken from the last step; computed anew from equilibrium after an impact.
Cost        one force evaluation a step.
Source      G. M. Hulbert, J. Chung, Comput. Methods Appl. Mech. Eng. 137, 175-188 (1996).
)"}),
      row<TchamwaWielgosz>(
          {"tchamwa-wielgosz",
           "explicit method of order one that dissipates high frequencies",
           {{"phi", 1.033, 1.0, 2.0, "1 <= phi <= 2", "weight of h² a0 in u; 1: no dissipation"}},
           [](Values x) { return tchamwa(x[0]); },
           R"(The explicit method of Tchamwa and Wielgosz:

    v1 = v0 + h a0
    u1 = u0 + h v0 + phi h² a0
    a1 = M^-1 [f(t0 + h) - C v1 - K u1 - p(u1, v1)]

phi = 1 is symplectic Euler.

Order       1.
Stability   omega h <= 2/sqrt(2 phi - 1) for C = 0.
Dissipation grows with phi, for high frequencies first; none on average for phi = 1, C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one force evaluation a step.
Source      L. Maheo, V. Grolleau, G. Rio, Comput. Mech. 51, 109-128 (2013).
)"}),
      row<NohBathe>(
          {"noh-bathe",
           "explicit method of Noh and Bathe, two sub-steps",
           {{"p", 0.54, 0.5, 0.6, "1/2 <= p <= 0.6", "length of the first sub-step, in steps"}},
           [](Values x) { return noh_bathe(x[0]); },
           R"(The explicit method of Noh and Bathe, sub-steps of p h and r h, r = 1 - p:

    u_p = u0 + p h v0 + (p h)²/2 a0,       a_p = a(t0 + p h, u_p, v0 + p h a0)
    v_p = v0 + p h/2 (a0 + a_p)
    u1  = u_p + r h v_p + (r h)²/2 a_p,    a1 = a(t0 + h, u1, v_p + r h a_p)
    v1  = v_p + r h [q0 a0 + (1/2 + q1) a_p + q2 a1]
    q1 = (1 - 2 p)/(2 p r), q2 = 1/2 - p q1, q0 = 1/2 - q1 - q2

Order       2.
Stability   omega h <= 3.75 for p = 0.54, C = 0.
Dissipation of high frequencies for p > 1/2.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        two force evaluations a step.
Source      G. Noh, K. J. Bathe, Comput. Struct. 129, 178-193 (2013).
)"})};
}

}  // namespace clackers::methods
