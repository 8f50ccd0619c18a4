#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/structural/energy_momentum.hpp"

namespace clackers::methods {

Facts EnergyMomentum::facts() const {
  return {.smooth_order = 2.0, .stability_limit = always, .radius_at_infinity = 1.0};
}

std::vector<Row> energy_momentum_methods() {
  return {row<EnergyMomentum>(
      {"energy-momentum",
       "energy-momentum method: the mean of the internal force over the step",
       {},
       [](Values) { return EnergyMomentum{}; },
       R"(The energy-momentum method with the mean of the internal force as discrete gradient, x_m = (x0 + x1)/2
for x = u, v:

    M (v1 - v0)/h + C v_m + K u_m + p* = [f(t0) + f(t0 + h)]/2
    u1 = u0 + h v_m
    p* = integral of p(u0 + s (u1 - u0), v_m) over s from 0 to 1

Where p is the gradient of a potential, p* . (u1 - u0) is its change, so that energy is conserved for
C = 0, f = 0. The integral is by Gauss' rule of four points: to rounding for a polynomial p of degree 7
or less, otherwise to h^9 a step. Without p this is average acceleration.

Order       2.
Stability   for every h, also with p of a potential that is bounded from below.
Dissipation none for C = 0.
Memory      none, but for the first guess of Newton's iteration.
Cost        one back-substitution a step; one factorization for each (system, h). With p four
            evaluations of it an iteration.
Source      O. Gonzalez, J. Nonlinear Sci. 6, 449-467 (1996), for discrete gradients; G. R. W. Quispel,
            D. I. McLaren, J. Phys. A 41, 045206 (2008), for the mean.
)"})};
}

}  // namespace clackers::methods
