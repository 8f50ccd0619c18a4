#include <limits>

#include "clackers/base/constants.hpp"
#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/multistep.hpp"

namespace clackers::methods {
namespace {

// The backward difference formula of k steps and order k.
Multistep backward(std::size_t k, const Multistep::Coefficients& d, double limit, double radius) {
  return {.steps = k, .d = d, .e = {}, .order = double(k), .limit = limit, .radius = radius};
}

}  // namespace

// The limits of stability are those of the roots of  d_0 z^k + d_1 z^(k-1) + ... = i omega h z^k.
std::vector<Row> multistep_methods() {
  return rows<Multistep>({
      {"houbolt",
       "Houbolt's method: a cubic through the last four displacements",
       {},
       [](Values) {
         return Multistep{.steps = 3,
                          .d = {11.0 / 6, -3.0, 1.5, -1.0 / 3},
                          .e = {2.0, -5.0, 4.0, -1.0},
                          .order = 2.0,
                          .limit = always,
                          .radius = 0.0};
       },
       R"(Houbolt's method, the derivatives of the cubic through the last four displacements:

    v1 = (11 u1 - 18 u0 + 9 u_-1 - 2 u_-2)/(6 h)
    a1 = (2 u1 - 5 u0 + 4 u_-1 - u_-2)/h²
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

Order       2.
Stability   for every h.
Dissipation strong, also of low frequencies.
Memory      u of two steps; the first two, also after an impact, are average acceleration.
Cost        one back-substitution a step; two factorizations for each (system, h).
Source      J. C. Houbolt, J. Aeronaut. Sci. 17, 540-550 (1950).
)"},
      {"park",
       "Park's stiffly stable method of three steps",
       {},
       [](Values) {
         return Multistep{.steps = 3,
                          .d = {10.0 / 6, -15.0 / 6, 1.0, -1.0 / 6},
                          .e = {},
                          .order = 2.0,
                          .limit = always,
                          .radius = 0.0};
       },
       R"(Park's method, D x1 = (10 x1 - 15 x0 + 6 x_-1 - x_-2)/(6 h), the mean of the backward differences of
order two and three:

    v1 = D u1, a1 = D v1
    M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)

Order       2.
Stability   for every h.
Dissipation of high frequencies.
Memory      u and v of two steps; the first two, also after an impact, are average acceleration.
Cost        one back-substitution a step; two factorizations for each (system, h).
Source      K. C. Park, J. Appl. Mech. 42, 464-470 (1975).
)"},
      {"bdf1",
       "backward Euler, the backward difference formula of order one",
       {},
       [](Values) {
         return backward(1, {1.0, -1.0}, always, 0.0);
       },
       R"(The backward difference formula of order 1 for x = (u, v), x' = (v, a(t, u, v)):

    1 x1 - 1 x0 = h x'(t0 + h, x1)

Order       1.
Stability   for every h.
Dissipation strong, at all frequencies.
Memory      none.
Cost        one back-substitution a step; one or two factorizations for each (system, h).
Source      E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, V.1 (1996).
)"},
      {"bdf2",
       "backward difference formula of order two",
       {},
       [](Values) {
         return backward(2, {1.5, -2.0, 0.5}, always, 0.0);
       },
       R"(The backward difference formula of order 2 for x = (u, v), x' = (v, a(t, u, v)):

    1.5 x1 - 2 x0 + 0.5 x_-1 = h x'(t0 + h, x1)

Order       2.
Stability   for every h.
Dissipation of high frequencies, strong.
Memory      u and v of one step; the first step, also after an impact, is average acceleration.
Cost        one back-substitution a step; one or two factorizations for each (system, h).
Source      E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, V.1 (1996).
)"},
      {"bdf3",
       "backward difference formula of order three",
       {},
       [](Values) {
         return backward(3, {11.0 / 6, -3.0, 1.5, -1.0 / 3}, 0.0, nan);
       },
       R"(The backward difference formula of order 3 for x = (u, v), x' = (v, a(t, u, v)):

    11 / 6 x1 - 3 x0 + 1.5 x_-1 - 1 / 3 x_-2 = h x'(t0 + h, x1)

Order       3.
Stability   none: without damping, motion with omega h < 1.94 grows.
Dissipation of high frequencies; low ones grow.
Memory      u and v of two steps; the first two, also after an impact, are of Dormand and Prince.
Cost        one back-substitution a step; one or two factorizations for each (system, h).
Source      E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, V.1 (1996).
)"},
      {"bdf4",
       "backward difference formula of order four",
       {},
       [](Values) {
         return backward(4, {25.0 / 12, -4.0, 3.0, -4.0 / 3, 0.25}, 0.0, nan);
       },
       R"(The backward difference formula of order 4 for x = (u, v), x' = (v, a(t, u, v)):

    25 / 12 x1 - 4 x0 + 3 x_-1 - 4 / 3 x_-2 + 0.25 x_-3 = h x'(t0 + h, x1)

Order       4.
Stability   none: without damping, motion with omega h < 4.72 grows.
Dissipation of high frequencies; low ones grow.
Memory      u and v of three steps; the first three, also after an impact, are of Dormand and Prince.
Cost        one back-substitution a step; one or two factorizations for each (system, h).
Source      E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, V.1 (1996).
)"},
      {"bdf5",
       "backward difference formula of order five",
       {},
       [](Values) {
         return backward(5, {137.0 / 60, -5.0, 5.0, -10.0 / 3, 1.25, -0.2}, 0.710807671015, nan);
       },
       R"(The backward difference formula of order 5 for x = (u, v), x' = (v, a(t, u, v)):

    137 / 60 x1 - 5 x0 + 5 x_-1 - 10 / 3 x_-2 + 1.25 x_-3 - 0.2 x_-4 = h x'(t0 + h, x1)

Order       5.
Stability   omega h <= 0.711.
Dissipation of high frequencies, beyond the interval of growth.
Memory      u and v of four steps; the first four, also after an impact, are of Dormand and Prince.
Cost        one back-substitution a step; one or two factorizations for each (system, h).
Source      E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, V.1 (1996).
)"},
      {"bdf6",
       "backward difference formula of order six",
       {},
       [](Values) {
         return backward(6, {147.0 / 60, -6.0, 7.5, -20.0 / 3, 3.75, -1.2, 1.0 / 6}, 0.843138162097,
                         nan);
       },
       R"(The backward difference formula of order 6 for x = (u, v), x' = (v, a(t, u, v)):

    147 / 60 x1 - 6 x0 + 7.5 x_-1 - 20 / 3 x_-2 + 3.75 x_-3 - 1.2 x_-4 + 1 / 6 x_-5 = h x'(t0 + h, x1)

Order       6.
Stability   omega h <= 0.843.
Dissipation of high frequencies, beyond the interval of growth.
Memory      u and v of five steps; the first five, also after an impact, are of Dormand and Prince.
Cost        one back-substitution a step; one or two factorizations for each (system, h).
Source      E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, V.1 (1996).
)"},
  });
}

}  // namespace clackers::methods
