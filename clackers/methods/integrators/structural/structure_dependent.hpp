#pragma once

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

// Explicit methods whose coefficients are matrices of the structure, stable for every h where it is
// linear.
namespace clackers::methods {

/// D = M + h/2 C + h²/4 K; see the card.
struct Chang : AccelerationMemory {
  Facts facts() const;

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    equation.factorized(whole<Dof>(h));
    equation.factorized(damping<Dof>(h));
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    const auto& s = equation.system();
    Scratch<Dof> change = equation.scratch(0), rate = equation.scratch(1);
    rate = x.v + 0.5 * h * memory.a;
    change.noalias() = h * (s.mass * rate);
    change.noalias() += 0.5 * h * h * (s.damping * x.v);
    equation.factorized(whole<Dof>(h)).solve_in_place(change);
    x.u += change;
    x.v += 0.5 * h * memory.a;
    x.t += h;
    equation.solve(x.t, damping<Dof>(h), x.u, x.v, memory.a);
    x.v += 0.5 * h * memory.a;
  }

 private:
  template <int Dof>
  typename MotionEquation<Dof>::Weights whole(double h) const {
    return {1.0, 0.5 * h, 0.25 * h * h};
  }
  template <int Dof>
  typename MotionEquation<Dof>::Weights damping(double h) const {
    return {1.0, 0.5 * h, 0.0};
  }
};

/// The method of Kolay and Ricles, for rho = 1 that of Chen and Ricles; see the card of kr-alpha.
struct KrAlpha : AccelerationMemory {
  double rho;

  double alpha_m() const { return (2.0 * rho - 1.0) / (rho + 1.0); }
  double alpha_f() const { return rho / (rho + 1.0); }
  double gamma() const { return 0.5 - alpha_m() + alpha_f(); }
  double beta() const { return 1.0 / ((1.0 + rho) * (1.0 + rho)); }

  Facts facts() const;

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    equation.factorized(whole<Dof>(h));
    equation.factorized(rest<Dof>(h));
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    using Vector = model::Vector<Dof>;
    const auto& s = equation.system();
    Scratch<Dof> a = equation.scratch(0), u = equation.scratch(1), v = equation.scratch(2);
    auto& sum = equation.scratch(3);
    const double af = alpha_f();
    a.noalias() = s.mass * memory.a;
    equation.factorized(whole<Dof>(h)).solve_in_place(a);
    // x_m = (1 - alpha_f) x1 + alpha_f x0
    u = x.u + (1.0 - af) * (h * x.v + (0.5 + gamma()) * h * h * a);
    v = x.v + (1.0 - af) * h * a;
    x.u += h * x.v + (0.5 + gamma()) * h * h * a;
    x.v += h * a;
    equation.accelerate(x.t + (1.0 - af) * h, u, v, a);
    // (D - D_3) a1 = D a - D_3 a0, D_3 = alpha_m M + alpha_f (gamma h C + beta h² K)
    const auto add = [&](const Vector& of, double mass, double others) {
      sum.noalias() += mass * (s.mass * of);
      sum.noalias() += others * gamma() * h * (s.damping * of);
      sum.noalias() += others * beta() * h * h * (s.stiffness * of);
    };
    sum.setZero();
    add(a, 1.0, 1.0);
    add(memory.a, -alpha_m(), -af);
    equation.factorized(rest<Dof>(h)).solve_in_place(sum);
    memory.a = sum;
    x.t += h;
  }

 private:
  template <int Dof>
  typename MotionEquation<Dof>::Weights whole(double h) const {
    return {1.0, gamma() * h, beta() * h * h};
  }
  template <int Dof>
  typename MotionEquation<Dof>::Weights rest(double h) const {
    return {1.0 - alpha_m(), (1.0 - alpha_f()) * gamma() * h, (1.0 - alpha_f()) * beta() * h * h};
  }
};

}  // namespace clackers::methods
