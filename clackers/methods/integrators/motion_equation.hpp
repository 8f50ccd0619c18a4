#pragma once

#include <Eigen/LU>
#include <span>
#include <string_view>
#include <type_traits>

#include "clackers/base/codes.hpp"
#include "clackers/model/run.hpp"
#include "clackers/model/system.hpp"
#include "clackers/numerics/spd_solver.hpp"

namespace clackers::methods {

/// Working memory of a step: a local variable, kept in registers, where the size is known to the
/// compiler; otherwise the member it is made from, so that nothing is allocated.
template <int Dof>
using Scratch = std::conditional_t<Dof == model::any_dof, model::Vector<Dof>&, model::Vector<Dof>>;

/// What every stepper asks of M a + C v + K u + p(u, v) = f(t): its residual, its acceleration,
/// and its solution where the acceleration also moves u and v. Counts what it does. After
/// construction nothing is allocated (except by a nonlinear force or a load).
template <int Dof>
class MotionEquation {
 public:
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;
  using Solver = numerics::SpdSolver<Dof>;

  /// How the unknown acceleration a enters: inertia M a_weight a, v = v0 + v_weight a,
  /// u = u0 + u_weight a.
  struct Weights {
    double a, v, u;
  };

  /// The system must outlive the equation.
  explicit MotionEquation(const model::SmoothSystem<Dof>& system);

  /// Takes in a changed mass matrix.
  void rebuild() { mass_.compute(s_.mass); }

  bool is_free() const { return !s_.nonlinear && !s_.add_load; }

  /// a becomes M^-1 (f(t) - C v - K u - p(u, v)).
  void accelerate(double t, const Vector& u, const Vector& v, Vector& a) {
    a.noalias() = -(s_.damping * v);
    a.noalias() -= s_.stiffness * u;
    if (s_.add_load)
      s_.add_load(t, std::span<double>(a.data(), static_cast<std::size_t>(a.size())));
    if (s_.nonlinear) subtract_nonlinear(u, v, a);
    mass_.solve_in_place(a);
    ++evaluations_;
  }

  /// Takes M a_weight + C v_weight + K u_weight in. It fails unless that is positive definite.
  void factorize(const Weights& w, Solver& effective) {
    matrix_ = w.a * s_.mass + w.v * s_.damping + w.u * s_.stiffness;
    ++factorizations_;
    if (!effective.compute(matrix_)) fail("not-positive-definite");
  }

  /// Solves  M (a_weight a + shift) + C v + K u + p(u, v) = f(t)  for a, with u = u0 + u_weight a
  /// and v = v0 + v_weight a; without `shift` it counts as 0. `effective` is the factorized matrix
  /// of the same weights. It fails where Newton's iteration finds no solution.
  void solve(double t, const Weights& w, const Solver& effective, const Vector& u0,
             const Vector& v0, Vector& a, const Vector* shift = nullptr) {
    if (s_.nonlinear) {
      if (!solve_nonlinear(t, w, u0, v0, a, shift)) fail("newton-failed");
      return;
    }
    a.noalias() = -(s_.damping * v0);
    a.noalias() -= s_.stiffness * u0;
    if (shift != nullptr) a.noalias() -= s_.mass * *shift;
    if (s_.add_load)
      s_.add_load(t, std::span<double>(a.data(), static_cast<std::size_t>(a.size())));
    effective.solve_in_place(a);
    ++evaluations_;
  }

  /// True after something has failed; the state computed since is meaningless.
  bool failed() const { return failed_; }
  /// The first failure. Meaningful only where failed().
  Code failure() const { return failure_; }

  /// Forgets failures and counts.
  void reset() {
    failed_ = false;
    evaluations_ = factorizations_ = iterations_ = 0;
  }
  void add_work(model::Work& work) const {
    work.force_evaluations += evaluations_;
    work.factorizations += factorizations_;
    work.newton_iterations += iterations_;
  }
  /// For steppers that evaluate the force on a path of their own.
  void count_evaluations(long long n) { evaluations_ += n; }

  const model::SmoothSystem<Dof>& system() const { return s_; }
  const Solver& mass() const { return mass_; }

 private:
  void fail(Code failure) {
    if (!failed_) failure_ = failure;
    failed_ = true;
  }
  void subtract_nonlinear(const Vector& u, const Vector& v, Vector& r);
  bool solve_nonlinear(double t, const Weights& w, const Vector& u0, const Vector& v0, Vector& a,
                       const Vector* shift);
  bool balance(double t, const Weights& w, const Vector& u0, const Vector& v0, const Vector& a,
               const Vector* shift);

  const model::SmoothSystem<Dof>& s_;
  Solver mass_;
  Vector r_, u_, v_, magnitude_, term_;
  Matrix matrix_, dp_du_, dp_dv_;
  Eigen::PartialPivLU<Matrix> tangent_;
  bool failed_ = false;
  Code failure_ = "run-failed";
  long long evaluations_ = 0, factorizations_ = 0, iterations_ = 0;
};

extern template class MotionEquation<1>;
extern template class MotionEquation<2>;
extern template class MotionEquation<model::any_dof>;

/// Throws InputError if `failed`: the implicit matrix of a step of h is not positive definite.
void require_definite(std::string_view who, double h, bool failed);

}  // namespace clackers::methods
