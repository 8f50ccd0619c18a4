#pragma once

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/linear_step.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

// Methods whose step couples all unknowns at once. In linear motion each is one linear map.
namespace clackers::methods {

/// What they share.
struct NothingRemembered {
  template <int Dof>
  struct Memory {
    explicit Memory(Eigen::Index) {}
  };
  template <int Dof>
  void start(MotionEquation<Dof>&, const model::State<Dof>&, Memory<Dof>&) const {}
};

/// Radau's collocation methods; see StageTable and the cards.
struct Radau : NothingRemembered {
  StageTable table;

  Facts facts() const;

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    if (equation.is_linear()) map(equation, h);
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x, Memory<Dof>&) const {
    if (equation.is_linear())
      equation.apply(map(equation, h), x.t, x.u, x.v);
    else
      iterate(equation, h, x);
    x.t += h;
  }

  /// What a linear step without load adds to (u, v).
  template <int Dof>
  const Eigen::MatrixXd& change(MotionEquation<Dof>& equation, double h) const {
    return map(equation, h).change;
  }

 private:
  template <int Dof>
  const LinearStep& map(MotionEquation<Dof>& equation, double h) const {
    return equation.linear_step(h, [&](LinearStep& step) {
      make_collocation_step(LinearSystem(equation.system()), table, step);
    });
  }

  // Newton's iteration starts at the acceleration of the start.
  template <int Dof>
  void iterate(MotionEquation<Dof>& equation, double h, model::State<Dof>& x) const {
    const auto count = std::size_t(table.stages);
    const std::span<model::Vector<Dof>> a(&equation.scratch(0), count);
    equation.accelerate(x.t, x.u, x.v, a[0]);
    for (std::size_t i = 1; i < count; ++i) a[i] = a[0];
    equation.solve_stages(x.t, h, table, x.u, x.v, a);
    const int last = table.stages - 1;
    x.u += h * x.v;
    for (std::size_t i = 0; i < count; ++i) {
      x.u += h * h * table.second(last, int(i)) * a[i];
      x.v += h * table.first(last, int(i)) * a[i];
    }
  }
};

/// The exact free motion, with the load by a rule of order 4; see the cards.
struct ExactFlow : NothingRemembered {
  Squaring squaring;
  void (*make)(const LinearSystem&, const Squaring&, LinearStep&);
  ExactUnder exact_under = ExactUnder::no_load;

  Facts facts() const;

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    map(equation, h);
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x, Memory<Dof>&) const {
    equation.apply(map(equation, h), x.t, x.u, x.v);
    x.t += h;
  }

  /// What a linear step without load adds to (u, v).
  template <int Dof>
  const Eigen::MatrixXd& change(MotionEquation<Dof>& equation, double h) const {
    return map(equation, h).change;
  }

 private:
  template <int Dof>
  const LinearStep& map(MotionEquation<Dof>& equation, double h) const {
    return equation.linear_step(
        h, [&](LinearStep& step) { make(LinearSystem(equation.system()), squaring, step); });
  }
};

}  // namespace clackers::methods
