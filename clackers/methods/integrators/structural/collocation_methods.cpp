#include <fmt/format.h>

#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/stability.hpp"
#include "clackers/methods/integrators/structural/collocation_method.hpp"

namespace clackers::methods {
namespace {

// The range of beta in which the method is stable for every h (Hilber and Hughes).
double least_beta(double theta) {
  return (2.0 * theta * theta - 1.0) / (4.0 * (2.0 * theta * theta * theta - 1.0));
}
double most_beta(double theta) { return theta / (2.0 * (theta + 1.0)); }

}  // namespace

// At infinite omega h equilibrium is u_H = 0; the rows are u, h v and h² a at the end of the step.
Facts CollocationMethod::facts() const {
  const Eigen::RowVector3d old_a(0.0, 0.0, 1.0), old_v(0.0, 1.0, 0.0), old_u(1.0, 0.0, 0.0),
      end_a =
          -Eigen::RowVector3d(1.0, theta, theta * theta * (0.5 - beta)) / (beta * theta * theta),
      new_a = old_a + (end_a - old_a) / theta;
  Eigen::Matrix3d step;
  step << old_u + old_v + (0.5 - beta) * old_a + beta * new_a, old_v + 0.5 * (old_a + new_a), new_a;
  return {
      .smooth_order = 2.0, .stability_limit = always, .radius_at_infinity = spectral_radius(step)};
}

std::vector<Row> collocation_methods() {
  return rows<CollocationMethod>({
      {"wilson-theta",
       "Wilson's method: acceleration linear over theta steps",
       {{"theta", 1.4, 1.3661, 2.0, "1.3661 <= theta <= 2",
         "steps over which the acceleration is linear", "Below 1.3660 high frequencies grow."}},
       [](Values x) { return CollocationMethod{.theta = x[0], .beta = 1.0 / 6}; },
       R"(Wilson's method, the acceleration linear over H = theta h, the load extrapolated on a line:

    u_H = u0 + H v0 + H²/6 (2 a0 + a_H)
    v_H = v0 + H/2 (a0 + a_H)
    M a_H + C v_H + K u_H + p(u_H, v_H) = (1 - theta) f(t0) + theta f(t0 + h)
    a1 = a0 + (a_H - a0)/theta
    u1 = u0 + h v0 + h²/6 (2 a0 + a1)
    v1 = v0 + h/2 (a0 + a1)

Order       2.
Stability   for every h; theta >= 1.3660 is needed for it.
Dissipation of high frequencies: a factor 0.778 a step at infinite omega h (theta = 1.4); large
            displacements overshoot in the first steps.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      E. L. Wilson, I. Farhoomand, K. J. Bathe, Earthq. Eng. Struct. Dyn. 1, 241-252 (1973).
)"},
      {"collocation",
       "Hilber and Hughes' collocation: between Newmark's and Wilson's methods",
       {{"theta", 1.1, 1.0, 2.0, "1 <= theta <= 2", "steps at whose end is the equilibrium"},
        {"beta", 0.24, 0.125, 0.5, "1/8 <= beta <= 1/2", "weight of the new acceleration in u"}},
       [](Values x) {
         if (!(x[1] >= least_beta(x[0]) && x[1] <= most_beta(x[0])))
           refuse("collocation", "beta", x[1],
                  fmt::format("{:.6g} <= beta <= {:.6g} for theta = {}", least_beta(x[0]),
                              most_beta(x[0]), x[0]),
                  "Outside this range high frequencies grow.");
         return CollocationMethod{.theta = x[0], .beta = x[1]};
       },
       R"(Hilber and Hughes' collocation with gamma = 1/2, H = theta h, the load extrapolated on a line:

    u_H = u0 + H v0 + H² [(1/2 - beta) a0 + beta a_H]
    v_H = v0 + H/2 (a0 + a_H)
    M a_H + C v_H + K u_H + p(u_H, v_H) = (1 - theta) f(t0) + theta f(t0 + h)
    a1 = a0 + (a_H - a0)/theta
    u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
    v1 = v0 + h/2 (a0 + a1)

theta = 1 is Newmark's method, beta = 1/6 Wilson's.

Order       2.
Stability   for every h if (2 theta² - 1)/(4 (2 theta³ - 1)) <= beta <= theta/(2 (theta + 1)); other
            values are refused.
Dissipation of high frequencies.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        one back-substitution a step; one factorization for each (system, h).
Source      H. M. Hilber, T. J. R. Hughes, Earthq. Eng. Struct. Dyn. 6, 99-117 (1978).
)"},
  });
}

}  // namespace clackers::methods
