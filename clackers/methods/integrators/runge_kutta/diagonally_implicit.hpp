#pragma once

#include <array>

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

namespace clackers::methods {

/// Diagonally implicit Runge-Kutta methods on (u, v)' = (v, a(t, u, v)), of up to three stages:
///
///     v_i = v0 + h sum_{j<=i} A_ij a_j
///     u_i = u0 + h sum_{j<=i} A_ij v_j
///     M a_i + C v_i + K u_i + p(u_i, v_i) = f(t0 + c_i h),  c_i = sum_j A_ij
///     u1  = u0 + h sum_j b_j v_j,  v1 = v0 + h sum_j b_j a_j
///
/// A first stage with A_11 = 0 is the end of the last step, whose last acceleration is remembered.
struct DiagonallyImplicit {
  static constexpr int most_stages = 3;

  int stages;
  double order, radius_at_infinity;
  std::array<std::array<double, most_stages>, most_stages> table;
  std::array<double, most_stages> b;

  Facts facts() const;

  // An alias instead of a base class: the struct stays an aggregate.
  template <int Dof>
  using Memory = AccelerationMemory::Memory<Dof>;

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    for (int i = 0; i < stages; ++i)
      if (at(i, i) != 0.0) equation.factorized(weights<Dof>(at(i, i) * h));
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    using Vector = model::Vector<Dof>;
    Scratch<Dof> u = equation.scratch(0), v = equation.scratch(1), a = equation.scratch(2);
    const auto v_at = [&](int i) -> Vector& { return equation.scratch(std::size_t(3 + i)); };
    const auto a_at = [&](int i) -> Vector& { return equation.scratch(std::size_t(6 + i)); };
    a = memory.a;
    for (int i = 0; i < stages; ++i) {
      double c = at(i, i);
      u = x.u;
      v = x.v;
      for (int j = 0; j < i; ++j) {
        c += at(i, j);
        u += h * at(i, j) * v_at(j);
        v += h * at(i, j) * a_at(j);
      }
      const double own = h * at(i, i);
      if (own != 0.0) {
        u += own * v;
        equation.solve(x.t + c * h, weights<Dof>(own), u, v, a);
        v += own * a;
      }
      v_at(i) = v;
      a_at(i) = a;
    }
    for (int i = 0; i < stages; ++i) {
      x.u += h * b[std::size_t(i)] * v_at(i);
      x.v += h * b[std::size_t(i)] * a_at(i);
    }
    memory.a = a;
    x.t += h;
  }

 private:
  double at(int i, int j) const { return table[std::size_t(i)][std::size_t(j)]; }

  template <int Dof>
  typename MotionEquation<Dof>::Weights weights(double own) const {
    return {1.0, own, own * own};
  }
};

}  // namespace clackers::methods
