#include <cmath>

#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/stability.hpp"
#include "clackers/methods/integrators/structural/composition.hpp"

namespace clackers::methods {
namespace {

Composition yoshida4() {
  const double outer = 1.0 / (2.0 - std::cbrt(2.0));
  return {.half = 2, .weight = {outer, 1.0 - 2.0 * outer}, .order = 4.0};
}

Composition yoshida6() {
  constexpr double a = 0.78451361047755726382, b = 0.23557321335935813368,
                   c = -1.17767998417887100695;
  return {.half = 4, .weight = {a, b, c, 1.0 - 2.0 * (a + b + c)}, .order = 6.0};
}

}  // namespace

Facts Composition::facts() const {
  // The product of the undamped steps for (u, v), a = -x² u.
  const auto radius = [this](double x) {
    double p[2][2] = {{1.0, 0.0}, {0.0, 1.0}};
    for (int i = 1 - half; i < half; ++i) {
      const double w = weight[std::size_t(half - 1 - std::abs(i))], c = 1.0 - 0.5 * w * w * x * x;
      const double step[2][2] = {{c, w}, {-0.5 * w * x * x * (1.0 + c), c}};
      for (auto* column : {&p[0][0], &p[0][1]}) {
        const double u = column[0], v = column[2];
        column[0] = step[0][0] * u + step[0][1] * v;
        column[2] = step[1][0] * u + step[1][1] * v;
      }
    }
    // Its determinant is 1: within rounding of a double root it does not grow.
    const double half_trace = 0.5 * std::abs(p[0][0] + p[1][1]);
    return half_trace < 1.0 + 1e-12 ? 1.0 : spectral_radius(2.0 * half_trace, 1.0);
  };
  return {.smooth_order = order, .stability_limit = stability_limit(radius)};
}

std::vector<Row> composition_methods() {
  return rows<Composition>({
      {"yoshida-4",
       "Yoshida's composition of three central differences, order four",
       {},
       [](Values) { return yoshida4(); },
       R"(Yoshida's composition of order four: steps of the central difference of w1 h, w0 h, w1 h with

    w1 = 1/(2 - 2^(1/3)) = 1.351, w0 = 1 - 2 w1 = -1.702

The middle one goes back in time: damping there feeds energy in, and the effective mass
M + w0 h/2 C must stay positive definite.

Order       4.
Stability   omega h <= 1.573 for C = 0.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        three back-substitutions a step; two factorizations for each (system, h).
Source      H. Yoshida, Phys. Lett. A 150, 262-268 (1990).
)"},
      {"yoshida-6",
       "Yoshida's composition of seven central differences, order six",
       {},
       [](Values) { return yoshida6(); },
       R"(Yoshida's composition of order six, solution A: steps of the central difference of w3 h, w2 h, w1 h,
w0 h, w1 h, w2 h, w3 h with

    w3 = 0.78451361047755726382, w2 = 0.23557321335935813368, w1 = -1.17767998417887100695,
    w0 = 1 - 2 (w1 + w2 + w3)

Those of w1 go back in time: damping there feeds energy in, and the effective mass M + w1 h/2 C
must stay positive definite.

Order       6.
Stability   omega h <= 2.269 for C = 0.
Dissipation none for C = 0.
Memory      a0, taken from the last step; computed anew after an impact.
Cost        seven back-substitutions a step; four factorizations for each (system, h).
Source      H. Yoshida, Phys. Lett. A 150, 262-268 (1990).
)"},
  });
}

}  // namespace clackers::methods
