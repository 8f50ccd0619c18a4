#include <cmath>
#include <vector>

#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/runge_kutta.hpp"

namespace clackers::methods {
namespace {

constexpr Tableau<4> classical{.order = 4.0,
                               .a = {{{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}},
                               .b = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};

// |R(i y)|² of  R(z) = 1 + sum_k b A^(k-1) 1 z^k.
double amplification(const std::vector<double>& coefficients, double y) {
  double real = 1.0, imaginary = 0.0, power = 1.0;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    power *= y;
    const double term = (k + 1) % 4 < 2 ? coefficients[k] * power : -coefficients[k] * power;
    ((k + 1) % 2 == 0 ? real : imaginary) += term;
  }
  return real * real + imaginary * imaginary;
}

// The end of the part of the imaginary axis, from 0 on, on which |R| <= 1.
template <int Stages>
double stability_limit(const Tableau<Stages>& table) {
  std::array<double, Stages> x;
  x.fill(1.0);
  std::vector<double> coefficients;
  for (int k = 0; k < Stages; ++k) {
    double sum = 0.0;
    std::array<double, Stages> next{};
    for (std::size_t i = 0; i < Stages; ++i) {
      sum += table.b[i] * x[i];
      for (std::size_t j = 0; j < Stages; ++j) next[i] += table.a[i][j] * x[j];
    }
    coefficients.push_back(sum);
    x = next;
  }
  const auto grows = [&](double y) { return amplification(coefficients, y) > 1.0 + 1e-12; };
  double stable = 0.1, step = 0.01;
  if (grows(stable)) return 0.0;
  for (; step > 1e-12; step *= 0.5)
    while (!grows(stable + step)) stable += step;
  return stable;
}

}  // namespace

template <const auto& Table>
Facts RungeKutta<Table>::facts() const {
  return {.smooth_order = Table.order, .stability_limit = stability_limit(Table)};
}

std::vector<Row> runge_kutta_methods() {
  return {row<RungeKutta<classical>>(
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
)"})};
}

}  // namespace clackers::methods
