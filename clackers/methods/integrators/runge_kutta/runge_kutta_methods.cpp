#include <cmath>
#include <vector>

#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/runge_kutta/runge_kutta.hpp"
#include "clackers/methods/integrators/stability.hpp"

namespace clackers::methods {
namespace {

constexpr Tableau<4> classical{.order = 4.0,
                               .a = {{{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}},
                               .b = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};

constexpr Tableau<3> kutta3{
    .order = 3.0, .a = {{{}, {0.5}, {-1.0, 2.0}}}, .b = {1.0 / 6, 2.0 / 3, 1.0 / 6}};

constexpr Tableau<4> three_eighths{.order = 4.0,
                                   .a = {{{}, {1.0 / 3}, {-1.0 / 3, 1.0}, {1.0, -1.0, 1.0}}},
                                   .b = {1.0 / 8, 3.0 / 8, 3.0 / 8, 1.0 / 8}};

}  // namespace

template <const auto& Table>
Facts RungeKutta<Table>::facts() const {
  return {.smooth_order = Table.order, .stability_limit = limit_of(Table.a, Table.b, Table.stages)};
}

template <const auto& Table>
Eigen::MatrixXd RungeKutta<Table>::coefficients() const {
  Eigen::MatrixXd all(Table.stages + 1, Table.stages);
  for (int j = 0; j < Table.stages; ++j) {
    for (int i = 0; i < Table.stages; ++i) all(i, j) = Table.a[std::size_t(i)][std::size_t(j)];
    all(Table.stages, j) = Table.b[std::size_t(j)];
  }
  return all;
}

std::vector<Row> runge_kutta_methods() {
  return {
      row<RungeKutta<classical>>(
          {"rk4",
           "the classical Runge-Kutta method of order four",
           {},
           [](Values) { return RungeKutta<classical>{}; },
           R"(The classical Runge-Kutta method of four stages on (u, v)' = (v, a(t, u, v)), with
a(t, u, v) = M^-1 [f(t) - C v - K u - p(u, v)], the stages of u written out:

    k1 = a(t0,       u0,                       v0)
    k2 = a(t0 + h/2, u0 + h/2 v0,              v0 + h/2 k1)
    k3 = a(t0 + h/2, u0 + h/2 v0 + h²/4 k1,    v0 + h/2 k2)
    k4 = a(t0 + h,   u0 + h v0 + h²/2 k2,      v0 + h k3)
    u1 = u0 + h v0 + h²/6 (k1 + k2 + k3)
    v1 = v0 + h/6 (k1 + 2 k2 + 2 k3 + k4)

Order       4.
Stability   omega h <= 2 sqrt(2) = 2.828.
Dissipation of order (omega h)^6 a step below the limit.
Memory      none.
Cost        four force evaluations a step.
Source      W. Kutta, Z. Math. Phys. 46, 435-453 (1901).
)"}),
      row<RungeKutta<kutta3>>(
          {"rk3",
           "Kutta's method of order three",
           {},
           [](Values) { return RungeKutta<kutta3>{}; },
           R"(Kutta's method of three stages on x = (u, v), x' = F(t, x) = (v, a(t, u, v)):

    k1 = F(t0, x0), k2 = F(t0 + h/2, x0 + h/2 k1), k3 = F(t0 + h, x0 - h k1 + 2 h k2)
    x1 = x0 + h/6 (k1 + 4 k2 + k3)

Order       3.
Stability   omega h <= sqrt(3) = 1.732.
Dissipation of order (omega h)^4 a step below the limit.
Memory      none.
Cost        three force evaluations a step.
Source      W. Kutta, Z. Math. Phys. 46, 435-453 (1901).
)"}),
      row<RungeKutta<three_eighths>>(
          {"rk4-three-eighths",
           "Kutta's 3/8 rule of order four",
           {},
           [](Values) { return RungeKutta<three_eighths>{}; },
           R"(Kutta's 3/8 rule of four stages on x = (u, v), x' = F(t, x) = (v, a(t, u, v)):

    k1 = F(t0, x0), k2 = F(t0 + h/3, x0 + h/3 k1), k3 = F(t0 + 2/3 h, x0 - h/3 k1 + h k2),
    k4 = F(t0 + h, x0 + h k1 - h k2 + h k3)
    x1 = x0 + h/8 (k1 + 3 k2 + 3 k3 + k4)

Order       4.
Stability   omega h <= 2 sqrt(2) = 2.828.
Dissipation of order (omega h)^6 a step below the limit.
Memory      none.
Cost        four force evaluations a step.
Source      W. Kutta, Z. Math. Phys. 46, 435-453 (1901).
)"}),
      row<RungeKutta<dormand_prince>>(
          {"dopri5-fixed-step",
           "Dormand and Prince's method of order five, with a fixed step",
           {},
           [](Values) { return RungeKutta<dormand_prince>{}; },
           R"(The method of order five in Dormand and Prince's pair 5(4), six stages, with a fixed step and no
error control:

    x1 = x0 + h (35/384 k1 + 500/1113 k3 + 125/192 k4 - 2187/6784 k5 + 11/84 k6)

Order       5.
Stability   a little below omega h = 1.
Dissipation of order (omega h)^6 a step below the limit.
Memory      none.
Cost        six force evaluations a step.
Source      J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6, 19-26 (1980).
)"}),
      row<RungeKutta<tsitouras>>(
          {"tsit5-fixed-step",
           "Tsitouras' method of order five, with a fixed step",
           {},
           [](Values) { return RungeKutta<tsitouras>{}; },
           R"(The method of order five in Tsitouras' pair 5(4), six stages, with a fixed step and no error
control; its coefficients have 16 digits.

Order       5.
Stability   see the stability limit among the facts.
Dissipation of order (omega h)^6 a step below the limit.
Memory      none.
Cost        six force evaluations a step.
Source      Ch. Tsitouras, Comput. Math. Appl. 62, 770-775 (2011).
)"})};
}

}  // namespace clackers::methods
