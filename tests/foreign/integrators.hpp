#pragma once

#include <functional>
#include <stdexcept>

#include "system.hpp"

// One-step maps from the textbooks. A step is pure, so that events are located on the step map.
namespace foreign {

struct State {
  double t = 0.0;
  Vec u, v, a;
  Vec u_before, v_before;  ///< of a two-step method
  double h_before = 0.0;   ///< 0: no earlier state, the method starts anew
  bool closed = false;     ///< a penalty contact is closed
};

using Step = std::function<State(const System&, const State&, double)>;

/// Newmark's update with generalized-alpha's equilibrium; am = af = 0 is Newmark itself.
inline State alpha_step(const System& s, const State& x, double h, double beta, double gamma,
                        double am, double af) {
  const Mat C = s.damping(x.closed), K = s.stiffness(x.closed);
  const Vec u = x.u + h * x.v + h * h * (0.5 - beta) * x.a, v = x.v + h * (1.0 - gamma) * x.a;
  const Vec right =
      -1.0 * (am * (s.M * x.a) + C * ((1.0 - af) * v + af * x.v) + K * ((1.0 - af) * u + af * x.u));
  State y = x;
  y.a = solve((1.0 - am) * s.M + (1.0 - af) * (gamma * h * C + beta * h * h * K), right);
  y.u = u + h * h * beta * y.a;
  y.v = v + h * gamma * y.a;
  return y;
}

inline State wilson_step(const System& s, const State& x, double h, double theta) {
  const double H = theta * h;
  const Mat C = s.damping(x.closed), K = s.stiffness(x.closed);
  const Vec right = -1.0 * (C * (x.v + 0.5 * H * x.a) + K * (x.u + H * x.v + H * H / 3.0 * x.a));
  const Vec far = solve(s.M + 0.5 * H * C + H * H / 6.0 * K, right);
  State y = x;
  y.a = x.a + (1.0 / theta) * (far - x.a);
  y.v = x.v + 0.5 * h * (x.a + y.a);
  y.u = x.u + h * x.v + h * h / 6.0 * (y.a + 2.0 * x.a);
  return y;
}

inline State bathe_step(const System& s, const State& x, double h) {
  const State m = alpha_step(s, x, 0.5 * h, 0.25, 0.5, 0.0, 0.0);
  const Mat C = s.damping(x.closed), K = s.stiffness(x.closed);
  const Vec b1 = (1.0 / h) * (x.u - 4.0 * m.u), b2 = (1.0 / h) * (x.v - 4.0 * m.v);
  State y = x;
  y.u = solve(9.0 / (h * h) * s.M + 3.0 / h * C + K, -1.0 * (s.M * (3.0 / h * b1 + b2) + C * b1));
  y.v = 3.0 / h * y.u + b1;
  y.a = 3.0 / h * y.v + b2;
  return y;
}

/// x1 = p + b f(x1) for the first-order system; b has the unit of time.
inline State backward(const System& s, const State& x, Vec pu, Vec pv, double b) {
  const Mat C = s.damping(x.closed), K = s.stiffness(x.closed);
  State y = x;
  y.v = solve(s.M + b * C + b * b * K, s.M * pv - b * (K * pu));
  y.u = pu + b * y.v;
  y.a = s.acceleration(y.u, y.v, x.closed);
  return y;
}

inline State midpoint_step(const System& s, const State& x, double h) {
  const State m = backward(s, x, x.u, x.v, 0.5 * h);
  State y = x;
  y.u = 2.0 * m.u - x.u;
  y.v = 2.0 * m.v - x.v;
  y.a = s.acceleration(y.u, y.v, x.closed);
  return y;
}

/// BDF2 with variable steps; the first step is backward Euler.
inline State bdf2_step(const System& s, const State& x, double h) {
  State y;
  if (x.h_before == 0.0) {
    y = backward(s, x, x.u, x.v, h);
  } else {
    const double w = h / x.h_before, c = (1.0 + w) * (1.0 + w) / (1.0 + 2.0 * w),
                 d = w * w / (1.0 + 2.0 * w);
    y = backward(s, x, c * x.u - d * x.u_before, c * x.v - d * x.v_before,
                 h * (1.0 + w) / (1.0 + 2.0 * w));
  }
  y.u_before = x.u;
  y.v_before = x.v;
  y.h_before = h;
  return y;
}

/// Closed form of each uncoupled mass.
inline State exact_step(const System& s, const State& x, double h) {
  const auto mass = [h](double m, double c, double k, double u, double v, double& u1, double& v1) {
    const double sigma = c / (2.0 * m), w = std::sqrt(k / m - sigma * sigma);
    const double e = std::exp(-sigma * h), C = std::cos(w * h), S = std::sin(w * h);
    u1 = e * (u * C + (v + sigma * u) / w * S);
    v1 = e * (v * C - (sigma * v + k / m * u) / w * S);
  };
  State y = x;
  mass(s.M.a, s.C.a, s.K.a, x.u.x, x.v.x, y.u.x, y.v.x);
  mass(s.M.d, s.C.d, s.K.d, x.u.y, x.v.y, y.u.y, y.v.y);
  y.a = s.acceleration(y.u, y.v, false);
  return y;
}

/// Explicit Runge-Kutta method of `stages` rows; penalty forces are those of each stage.
inline State runge_kutta_step(const System& s, const State& x, double h, int stages,
                              const double (*A)[7], const double* b) {
  const bool springs = s.spring > 0.0;
  const auto f = [&](Vec u, Vec v) {
    return s.acceleration(u, v, springs && (s.release > 0.0 ? x.closed : s.gap(u) < 0.0));
  };
  Vec ku[7], kv[7];
  State y = x;
  for (int i = 0; i < stages; ++i) {
    Vec u = x.u, v = x.v;
    for (int j = 0; j < i; ++j) {
      u = u + h * A[i][j] * ku[j];
      v = v + h * A[i][j] * kv[j];
    }
    ku[i] = v;
    kv[i] = f(u, v);
  }
  for (int i = 0; i < stages; ++i) {
    y.u = y.u + h * b[i] * ku[i];
    y.v = y.v + h * b[i] * kv[i];
  }
  y.a = f(y.u, y.v);
  return y;
}

inline constexpr double no_stage[1][7] = {{}};
inline constexpr double euler_b[] = {1.0};
inline constexpr double midpoint_a[2][7] = {{}, {0.5}};
inline constexpr double midpoint_b[] = {0.0, 1.0};
inline constexpr double heun_a[2][7] = {{}, {1.0}};
inline constexpr double heun_b[] = {0.5, 0.5};
inline constexpr double kutta_a[3][7] = {{}, {0.5}, {-1.0, 2.0}};
inline constexpr double kutta_b[] = {1.0 / 6, 2.0 / 3, 1.0 / 6};
inline constexpr double rk4_a[4][7] = {{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}};
inline constexpr double rk4_b[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
inline constexpr double dopri_a[7][7] = {
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
inline constexpr double dopri_b[] = {35.0 / 384,     0.0,       500.0 / 1113, 125.0 / 192,
                                     -2187.0 / 6784, 11.0 / 84, 0.0};
inline constexpr double dopri_low[] = {5179.0 / 57600,    0.0,          7571.0 / 16695, 393.0 / 640,
                                       -92097.0 / 339200, 187.0 / 2100, 1.0 / 40};

/// Solves with the contact as at the start of the step, then with what the result asks for.
inline State with_contact_search(const System& s, const State& x,
                                 const std::function<State(const State&)>& step) {
  State from = x, y = step(x);
  for (int i = 0; s.spring > 0.0 && s.release == 0.0 && i < 4; ++i) {
    const bool closed = s.gap(y.u) < 0.0;
    if (closed == from.closed) break;
    from.closed = closed;
    y = step(from);
  }
  return y;
}

inline Step make_step(const Options& o) {
  const std::string name = o.text("method", "rk4");
  const auto implicit = [](auto step) {
    return [step](const System& s, const State& x, double h) {
      return with_contact_search(s, x, [&](const State& from) { return step(s, from, h); });
    };
  };
  if (name == "newmark" || name == "hht" || name == "generalized-alpha") {
    double beta = o.number("beta", 0.25), gamma = o.number("gamma", 0.5), am = 0.0, af = 0.0;
    if (name == "hht") {
      af = -o.number("alpha", -0.1);
    } else if (name == "generalized-alpha") {
      const double rho = o.number("rho", 0.8);
      am = (2.0 * rho - 1.0) / (rho + 1.0);
      af = rho / (rho + 1.0);
    }
    if (name != "newmark") {
      gamma = 0.5 - am + af;
      beta = 0.25 * (1.0 - am + af) * (1.0 - am + af);
    }
    return implicit([=](const System& s, const State& x, double h) {
      return alpha_step(s, x, h, beta, gamma, am, af);
    });
  }
  if (name == "wilson") {
    const double theta = o.number("wilson-theta", 1.4);
    return implicit(
        [=](const System& s, const State& x, double h) { return wilson_step(s, x, h, theta); });
  }
  if (name == "bathe") return implicit(bathe_step);
  if (name == "midpoint") return implicit(midpoint_step);
  if (name == "bdf2") return implicit(bdf2_step);
  if (name == "implicit-euler")
    return implicit(
        [](const System& s, const State& x, double h) { return backward(s, x, x.u, x.v, h); });
  if (name == "exact") return exact_step;
  if (name == "symplectic-euler")
    return [](const System& s, const State& x, double h) {
      State y = x;
      y.v = x.v + h * s.acceleration(x.u, x.v, x.closed);
      y.u = x.u + h * y.v;
      y.a = s.acceleration(y.u, y.v, x.closed);
      return y;
    };
  if (name == "forces") {  // once a step, with another share in displacements
    const double share = o.number("share", 0.0);
    return [share](const System& s, const State& x, double h) {
      State y = x;
      y.u = x.u + h * x.v + share * h * h * s.acceleration(x.u, x.v, x.closed);
      y.v = x.v + h * s.acceleration(x.u, x.v, x.closed);
      y.a = s.acceleration(y.u, y.v, x.closed);
      return y;
    };
  }
  if (name == "yoshida")  // three Verlet steps, order 4 for an undamped system
    return [](const System& s, const State& x, double h) {
      const double w = 1.0 / (2.0 - std::cbrt(2.0));
      State y = alpha_step(s, x, w * h, 0.0, 0.5, 0.0, 0.0);
      y = alpha_step(s, y, (1.0 - 2.0 * w) * h, 0.0, 0.5, 0.0, 0.0);
      return alpha_step(s, y, w * h, 0.0, 0.5, 0.0, 0.0);
    };
  const auto tableau = [](int stages, const double(*A)[7], const double* b) {
    return [=](const System& s, const State& x, double h) {
      return runge_kutta_step(s, x, h, stages, A, b);
    };
  };
  if (name == "euler") return tableau(1, no_stage, euler_b);
  if (name == "explicit-midpoint") return tableau(2, midpoint_a, midpoint_b);
  if (name == "heun") return tableau(2, heun_a, heun_b);
  if (name == "rk3") return tableau(3, kutta_a, kutta_b);
  if (name == "rk4") return tableau(4, rk4_a, rk4_b);
  if (name == "dopri5") return tableau(7, dopri_a, dopri_b);
  throw std::runtime_error("no method " + name);
}

}  // namespace foreign
