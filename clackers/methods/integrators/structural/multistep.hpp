#pragma once

#include <array>
#include <numeric>
#include <utility>

#include "clackers/methods/integrators/runge_kutta/runge_kutta.hpp"
#include "clackers/methods/integrators/structural/alpha_method.hpp"

namespace clackers::methods {

/// Linear multistep methods of k steps, D x1 = (d_0 x1 + d_1 x0 + d_2 x_-1 + ...)/h for x = u, v:
///
///     v1 = D u1,  a1 = D v1, or  a1 = (e_0 u1 + e_1 u0 + e_2 u_-1 + ...)/h²
///     M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)
///
/// The first k - 1 steps, also after an impact, are those of another method: average acceleration
/// up to order 2, above that Dormand and Prince's of order 5. A partial step is one of it, too.
struct Multistep {
  static constexpr std::size_t most_steps = 6;
  using Coefficients = std::array<double, most_steps + 1>;

  std::size_t steps;  ///< k
  Coefficients d, e;  ///< e_0 = 0: a from v
  double order, limit, radius;

  Facts facts() const {
    return {.smooth_order = order, .stability_limit = limit, .radius_at_infinity = radius};
  }

  template <int Dof>
  struct Memory {
    explicit Memory(Eigen::Index dof) : start(dof) {
      u.fill(start.a);
      v.fill(start.a);
    }
    AlphaMethod::Memory<Dof> start;                       ///< acceleration at the start of the step
    std::array<model::Vector<Dof>, most_steps - 1> u, v;  ///< before the start, newest first
    std::size_t count = 0;                                ///< how many there are
  };

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    equation.factorized(weights<Dof>(h));
    if (starts_implicitly()) average.prepare(equation, h);
  }

  template <int Dof>
  void start(MotionEquation<Dof>& equation, const model::State<Dof>& from,
             Memory<Dof>& memory) const {
    AccelerationMemory().start(equation, from, memory.start);
    memory.count = 0;
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    if (memory.count + 1 < steps) {
      remember(x, memory);
      ++memory.count;
      step_alone(equation, h, x, memory);
      return;
    }
    Scratch<Dof> u = equation.scratch(0), v = equation.scratch(1), sum = equation.scratch(2);
    // u1 = u + weight a1, v1 = v + weight a1
    const auto w = weights<Dof>(h);
    if (e[0] != 0.0) {
      add_past<Dof>(e, x.u, memory.u, u);
      u *= -1.0 / e[0];
      add_past<Dof>(d, x.u, memory.u, v);
      v = (v + d[0] * u) / h;
    } else {
      add_past<Dof>(d, x.v, memory.v, v);
      v *= -1.0 / d[0];
      add_past<Dof>(d, x.u, memory.u, sum);
      u = (h * v - sum) / d[0];
    }
    remember(x, memory);
    x.t += h;
    equation.solve(x.t, w, u, v, memory.start.a);
    x.u = u + w.u * memory.start.a;
    x.v = v + w.v * memory.start.a;
  }

  // For steps eight at once the states before are differences, newest first: u - u_-1, v - v_-1,
  // u_-1 - u_-2, ...
  template <int Dof>
  bool is_full(const Memory<Dof>& memory) const {
    return memory.count + 1 == steps;
  }

  template <int Dof>
  void pack(const model::State<Dof>& x, const Memory<Dof>& memory, double* to) const {
    for (std::size_t j = 0; j + 1 < steps; ++j)
      for (const auto& [now, past] : {std::pair{&x.u, &memory.u}, {&x.v, &memory.v}})
        for (Eigen::Index i = 0; i < now->size(); ++i)
          *to++ = (j == 0 ? *now : (*past)[j - 1])[i] - (*past)[j][i];
  }

  template <int Dof>
  void unpack(const double* from, const model::State<Dof>& x, Memory<Dof>& memory) const {
    for (std::size_t j = 0; j + 1 < steps; ++j)
      for (const auto& [now, past] : {std::pair{&x.u, &memory.u}, {&x.v, &memory.v}})
        for (Eigen::Index i = 0; i < now->size(); ++i)
          (*past)[j][i] = (j == 0 ? *now : (*past)[j - 1])[i] - *from++;
    memory.count = steps - 1;
  }

  /// The matrix T_1 of StepPowers. The coefficients of a formula have the sum 0, so that
  /// c_1 x0 + c_2 x_-1 + ... = -c_0 x0 - C_1 (x0 - x_-1) - C_2 (x_-1 - x_-2) - ...
  /// with C_j = c_(j+1) + c_(j+2) + ...
  template <int Dof>
  Eigen::MatrixXd change(MotionEquation<Dof>& equation, double h) const {
    const auto w = weights<Dof>(h);
    const auto n = equation.system().dof(), pair = 2 * n, all = pair * Eigen::Index(steps);
    const auto rest = [&](const Coefficients& c, std::size_t j) {
      return std::accumulate(&c[j + 1], &c[steps] + 1, 0.0);
    };
    Eigen::MatrixXd change = Eigen::MatrixXd::Zero(all, all);
    model::Vector<Dof> u = model::Vector<Dof>::Zero(n), v = u, a = u;
    for (Eigen::Index column = 0; column < all; ++column) {
      const auto i = column % n;
      const auto j = std::size_t(column / pair);
      const bool is_v = column % pair >= n;
      // u1 and v1 without a1, less u0 and v0.
      double more_u = 0.0, more_v = 0.0;
      if (e[0] == 0.0) {
        if (is_v) more_v = j == 0 ? 0.0 : rest(d, j) / d[0];
        const double v1 = more_v + (is_v && j == 0 ? 1.0 : 0.0);
        more_u = (h * v1 + (is_v || j == 0 ? 0.0 : rest(d, j))) / d[0];
      } else if (is_v) {
        more_v = j == 0 ? -1.0 : 0.0;
      } else if (j > 0) {
        more_u = rest(e, j) / e[0];
        more_v = (d[0] * more_u - rest(d, j)) / h;
      }
      u.setZero();
      v.setZero();
      u[i] = more_u + (!is_v && j == 0 ? 1.0 : 0.0);
      v[i] = more_v + (is_v && j == 0 ? 1.0 : 0.0);
      equation.solve(0.0, w, u, v, a);
      change.col(column).head(n) = w.u * a;
      change.col(column).segment(n, n) = w.v * a;
      change(i, column) += more_u;
      change(n + i, column) += more_v;
      if (steps == 1) continue;
      change.col(column).segment(pair, pair) = change.col(column).head(pair);
      if (j > 0 && j + 1 < steps) change(column + pair, column) = 1.0;
    }
    return change;
  }

  /// That of the state, as each step leaves it.
  template <int Dof>
  void find_acceleration(MotionEquation<Dof>& equation, const model::State<Dof>& x,
                         Memory<Dof>& memory) const {
    AccelerationMemory().start(equation, x, memory.start);
  }

  template <int Dof>
  void partial(MotionEquation<Dof>& equation, double, double s, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    step_alone(equation, s, x, memory);
  }

 private:
  static constexpr AlphaMethod average{.beta = 0.25, .gamma = 0.5};

  bool starts_implicitly() const { return order < 2.5; }

  template <int Dof>
  typename MotionEquation<Dof>::Weights weights(double h) const {
    if (e[0] != 0.0) return {1.0, d[0] * h / e[0], h * h / e[0]};
    return {1.0, h / d[0], h * h / (d[0] * d[0])};
  }

  // sum = c_1 x0 + c_2 x_-1 + ...
  template <int Dof>
  void add_past(const Coefficients& c, const model::Vector<Dof>& x0,
                const std::array<model::Vector<Dof>, most_steps - 1>& past,
                model::Vector<Dof>& sum) const {
    sum = c[1] * x0;
    for (std::size_t j = 2; j <= steps; ++j) sum += c[j] * past[j - 2];
  }

  template <int Dof>
  void remember(const model::State<Dof>& x, Memory<Dof>& memory) const {
    for (std::size_t j = steps - 1; j-- > 1;) {
      memory.u[j].swap(memory.u[j - 1]);
      memory.v[j].swap(memory.v[j - 1]);
    }
    memory.u[0] = x.u;
    memory.v[0] = x.v;
  }

  template <int Dof>
  void step_alone(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
                  Memory<Dof>& memory) const {
    if (starts_implicitly()) {
      average.advance(equation, h, x, memory.start);
    } else {
      using Start = RungeKutta<dormand_prince>;
      typename Start::Memory<Dof> none(0);
      Start{}.advance(equation, h, x, none);
    }
  }
};

}  // namespace clackers::methods
