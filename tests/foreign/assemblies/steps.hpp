#pragma once

#include <functional>

#include "../integrators.hpp"
#include "problem.hpp"

// One-step maps for any number of masses, from the textbooks; loads at the times of the stages.
namespace foreign::assemblies {

struct Row {
  double t = 0.0;
  Vector u, v, a;
};

using Map = std::function<Row(const Problem&, const Row&, double)>;

/// Newmark's update with generalized-alpha's equilibrium; am = af = 0 is Newmark itself.
inline Row alpha_step(const Problem& p, const Row& x, double h, double beta, double gamma,
                      double am, double af) {
  const Vector u = x.u + h * x.v + h * h * (0.5 - beta) * x.a, v = x.v + h * (1.0 - gamma) * x.a;
  const Vector right = p.force(x.t + (1.0 - af) * h) - am * (p.M * x.a) -
                       p.C * ((1.0 - af) * v + af * x.v) - p.K * ((1.0 - af) * u + af * x.u);
  Row y = x;
  y.t = x.t + h;
  y.a = solve((1.0 - am) * p.M + (1.0 - af) * (gamma * h * p.C + beta * h * h * p.K), right);
  y.u = u + h * h * beta * y.a;
  y.v = v + h * gamma * y.a;
  return y;
}

/// Backward Euler over `h`; over half a step, then mirrored, it is the midpoint rule.
inline Row backward_step(const Problem& p, const Row& x, double h) {
  Row y = x;
  y.t = x.t + h;
  y.v = solve(p.M + h * p.C + h * h * p.K, p.M * x.v + h * (p.force(y.t) - p.K * x.u));
  y.u = x.u + h * y.v;
  y.a = p.acceleration(y.u, y.v, y.t);
  return y;
}

inline Row midpoint_step(const Problem& p, const Row& x, double h) {
  const Row m = backward_step(p, x, 0.5 * h);
  Row y = x;
  y.t = x.t + h;
  y.u = 2.0 * m.u - x.u;
  y.v = 2.0 * m.v - x.v;
  y.a = p.acceleration(y.u, y.v, y.t);
  return y;
}

inline Row runge_kutta_step(const Problem& p, const Row& x, double h, int stages,
                            const double (*A)[7], const double* b) {
  std::vector<Vector> ku, kv;
  Row y = x;
  for (int i = 0; i < stages; ++i) {
    Vector u = x.u, v = x.v;
    double c = 0.0;
    for (int j = 0; j < i; ++j) {
      u = u + h * A[i][j] * ku[std::size_t(j)];
      v = v + h * A[i][j] * kv[std::size_t(j)];
      c += A[i][j];
    }
    ku.push_back(v);
    kv.push_back(p.acceleration(u, v, x.t + c * h));
  }
  for (int i = 0; i < stages; ++i) {
    y.u = y.u + h * b[i] * ku[std::size_t(i)];
    y.v = y.v + h * b[i] * kv[std::size_t(i)];
  }
  y.t = x.t + h;
  y.a = p.acceleration(y.u, y.v, y.t);
  return y;
}

/// The power series of the motion in time; derivatives of a load are shifts of its phase.
inline Row series_step(const Problem& p, const Row& x, double h) {
  constexpr int terms = 24;
  std::vector<Vector> u{x.u, x.v};  // derivatives at the start
  for (int k = 0; k < terms; ++k) {
    Vector f(x.u.size());
    for (const auto& load : p.loads)
      f[load.mass] += load.amplitude * std::pow(load.frequency, k) *
                      std::cos(load.frequency * x.t + load.phase + k * 1.5707963267948966);
    u.push_back(solve(p.M, f - p.C * u[std::size_t(k) + 1] - p.K * u[std::size_t(k)]));
  }
  Row y = x;
  y.u = y.v = Vector(x.u.size());
  for (std::size_t k = terms; k > 0; --k) {
    y.u = u[k] + (h / double(k + 1)) * y.u;
    y.v = u[k] + (h / double(k)) * y.v;
  }
  y.u = x.u + h * y.u;
  y.t = x.t + h;
  y.a = p.acceleration(y.u, y.v, y.t);
  return y;
}

inline Map make_map(const Options& o) {
  const std::string name = o.text("method", "rk4");
  if (name == "newmark" || name == "hht" || name == "generalized-alpha") {
    double am = 0.0, af = 0.0;
    if (name == "hht") af = -o.number("alpha", -0.1);
    if (name == "generalized-alpha") {
      const double rho = o.number("rho", 0.8);
      am = (2.0 * rho - 1.0) / (rho + 1.0);
      af = rho / (rho + 1.0);
    }
    const double gamma = o.number("gamma", 0.5 - am + af),
                 beta = o.number("beta", 0.25 * (1.0 - am + af) * (1.0 - am + af));
    return [=](const Problem& p, const Row& x, double h) {
      return alpha_step(p, x, h, beta, gamma, am, af);
    };
  }
  if (name == "midpoint") return midpoint_step;
  if (name == "implicit-euler") return backward_step;
  if (name == "series") return series_step;
  const auto tableau = [](int stages, const double(*A)[7], const double* b) {
    return [=](const Problem& p, const Row& x, double h) {
      return runge_kutta_step(p, x, h, stages, A, b);
    };
  };
  if (name == "heun") return tableau(2, heun_a, heun_b);
  if (name == "rk3") return tableau(3, kutta_a, kutta_b);
  if (name == "rk4") return tableau(4, rk4_a, rk4_b);
  if (name == "dopri5") return tableau(7, dopri_a, dopri_b);
  throw std::runtime_error("no method " + name + " for assemblies");
}

}  // namespace foreign::assemblies
