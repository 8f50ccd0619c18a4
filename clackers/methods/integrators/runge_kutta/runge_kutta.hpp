#pragma once

#include <array>
#include <utility>

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

namespace clackers::methods {

/// The coefficients of an explicit Runge-Kutta method.
template <int Stages>
struct Tableau {
  static constexpr int stages = Stages;
  double order;
  std::array<std::array<double, Stages>, Stages> a;  ///< a[i][j] = 0 for j >= i
  std::array<double, Stages> b;

  /// The time of a stage, in steps.
  constexpr double c(int i) const {
    double sum = 0.0;
    for (int j = 0; j < i; ++j) sum += a[std::size_t(i)][std::size_t(j)];
    return sum;
  }
  /// The weight of k_j h² in the u of stage i, or of the end for i = Stages.
  constexpr double second(int i, int j) const {
    double sum = 0.0;
    for (int l = j + 1; l < i; ++l)
      sum += (i == Stages ? b[std::size_t(l)] : a[std::size_t(i)][std::size_t(l)]) *
             a[std::size_t(l)][std::size_t(j)];
    return sum;
  }
};

/// The method of order 5 in the pair of J. R. Dormand and P. J. Prince, J. Comput. Appl. Math. 6, 19-26
/// (1980).
inline constexpr Tableau<6> dormand_prince{
    .order = 5.0,
    .a = {{{},
           {1.0 / 5},
           {3.0 / 40, 9.0 / 40},
           {44.0 / 45, -56.0 / 15, 32.0 / 9},
           {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
           {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656}}},
    .b = {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};

/// The method of order 5 in the pair of Ch. Tsitouras, Comput. Math. Appl. 62, 770-775 (2011).
inline constexpr Tableau<6> tsitouras{
    .order = 5.0,
    .a = {{{},
           {0.161},
           {-0.008480655492356989, 0.335480655492357},
           {2.8971530571054935, -6.359448489975075, 4.3622954328695815},
           {5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525},
           {5.86145544294642, -12.92096931784711, 8.159367898576159, -0.071584973281401,
            -0.028269050394068383}}},
    .b = {0.09646076681806523, 0.01, 0.4798896504144996, 1.379008574103742, -3.290069515436081,
          2.324710524099774}};

/// Explicit Runge-Kutta methods on (u, v)' = (v, a(t, u, v)), the stages of u written out:
///
///     k_i = a(t0 + c_i h, u0 + c_i h v0 + h² sum_j (A²)_ij k_j, v0 + h sum_j A_ij k_j)
///     u1  = u0 + h v0 + h² sum_j (b A)_j k_j
///     v1  = v0 + h sum_j b_j k_j
///
/// The table is known to the compiler, which leaves out what is 0.
template <const auto& Table>
struct RungeKutta {
  static constexpr int stages = Table.stages;

  Facts facts() const;
  Eigen::MatrixXd coefficients() const;

  template <int Dof>
  struct Memory {
    explicit Memory(Eigen::Index) {}
  };

  template <int Dof>
  void prepare(MotionEquation<Dof>&, double) const {}
  template <int Dof>
  void start(MotionEquation<Dof>&, const model::State<Dof>&, Memory<Dof>&) const {}

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x, Memory<Dof>&) const {
    equation.with_acceleration([&](auto&& accelerate) {
      std::array<model::Vector<Dof>, Dof == model::any_dof ? 0 : stages> local;
      const auto k = [&](int i) -> model::Vector<Dof>& {
        if constexpr (Dof == model::any_dof)
          return equation.scratch(static_cast<std::size_t>(i) + 2);
        else
          return local[static_cast<std::size_t>(i)];
      };
      Scratch<Dof> u = equation.scratch(0), v = equation.scratch(1);
      for_each<stages>([&](auto i) {
        constexpr double c = Table.c(i);
        u = x.u + c * h * x.v;
        v = x.v;
        for_each<i>([&](auto j) {
          if constexpr (Table.second(i, j) != 0.0) u += Table.second(i, j) * h * h * k(j);
          if constexpr (Table.a[i][j] != 0.0) v += Table.a[i][j] * h * k(j);
        });
        accelerate(x.t + c * h, u, v, k(i));
      });
      x.u += h * x.v;
      for_each<stages>([&](auto j) {
        if constexpr (Table.second(stages, j) != 0.0) x.u += Table.second(stages, j) * h * h * k(j);
        if constexpr (Table.b[j] != 0.0) x.v += Table.b[j] * h * k(j);
      });
    });
    x.t += h;
  }

 private:
  template <int Count, class Body>
  static void for_each(Body&& body) {
    [&]<int... I>(std::integer_sequence<int, I...>) {
      (body(std::integral_constant<int, I>{}), ...);
    }
    (std::make_integer_sequence<int, Count>{});
  }
};

}  // namespace clackers::methods
