#include <fmt/format.h>

#include <array>
#include <limits>
#include <string>
#include <string_view>

#include "clackers/base/constants.hpp"
#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/structural/multistep.hpp"

namespace clackers::methods {
namespace {

// A backward difference formula, its formula and how it is stable and dissipates in words.
struct Backward {
  Multistep::Coefficients d;
  std::string_view formula, stability, dissipation;
  double limit, radius;
};

// The one of k steps and order k.
Member<Multistep> backward(std::size_t k, const Backward& x) {
  constexpr std::array words{"no", "one", "two", "three", "four", "five", "six"};
  std::string memory = "none.";
  if (k == 2)
    memory = "u and v of one step; the first step, also after an impact, is average acceleration.";
  if (k > 2)
    memory = fmt::format(
        "u and v of {0} steps; the first {0}, also after an impact, are of Dormand and Prince, of\n"
        "            order 5, which is the order where impacts are less than {0} steps apart.",
        words[k - 1]);
  return {fmt::format("bdf{}", k),
          fmt::format("{}backward difference formula of order {}",
                      k == 1 ? "backward Euler, the " : "", words[k]),
          {},
          [k, d = x.d, limit = x.limit, radius = x.radius](Values) {
            return Multistep{
                .steps = k, .d = d, .e = {}, .order = double(k), .limit = limit, .radius = radius};
          },
          fmt::format(
              R"(The backward difference formula of order {0} for x = (u, v), x' = (v, a(t, u, v)):

    {1} = h x'(t0 + h, x1)

Order       {0}.
Stability   {2}
Dissipation {3}
Memory      {4}
Cost        one back-substitution a step; one or two factorizations for each (system, h).
Source      E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, V.1 (1996).
)",
              k, x.formula, x.stability, x.dissipation, memory)};
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
      backward(
          1,
          {{1.0, -1.0}, "1 x1 - 1 x0", "for every h.", "strong, at all frequencies.", always, 0.0}),
      backward(2, {{1.5, -2.0, 0.5},
                   "1.5 x1 - 2 x0 + 0.5 x_-1",
                   "for every h.",
                   "of high frequencies, strong.",
                   always,
                   0.0}),
      backward(3, {{11.0 / 6, -3.0, 1.5, -1.0 / 3},
                   "11 / 6 x1 - 3 x0 + 1.5 x_-1 - 1 / 3 x_-2",
                   "none: without damping, motion with omega h < 1.94 grows.",
                   "of high frequencies; low ones grow.",
                   0.0,
                   nan}),
      backward(4, {{25.0 / 12, -4.0, 3.0, -4.0 / 3, 0.25},
                   "25 / 12 x1 - 4 x0 + 3 x_-1 - 4 / 3 x_-2 + 0.25 x_-3",
                   "none: without damping, motion with omega h < 4.714 grows.",
                   "of high frequencies; low ones grow.",
                   0.0,
                   nan}),
      backward(5, {{137.0 / 60, -5.0, 5.0, -10.0 / 3, 1.25, -0.2},
                   "137 / 60 x1 - 5 x0 + 5 x_-1 - 10 / 3 x_-2 + 1.25 x_-3 - 0.2 x_-4",
                   "omega h <= 0.711.",
                   "of high frequencies, beyond the interval of growth.",
                   0.710807671015,
                   nan}),
      backward(6,
               {{147.0 / 60, -6.0, 7.5, -20.0 / 3, 3.75, -1.2, 1.0 / 6},
                "147 / 60 x1 - 6 x0 + 7.5 x_-1 - 20 / 3 x_-2 + 3.75 x_-3 - 1.2 x_-4 + 1 / 6 x_-5",
                "omega h <= 0.843.",
                "of high frequencies, beyond the interval of growth.",
                0.843138162097,
                nan}),
  });
}

}  // namespace clackers::methods
