#pragma once

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include "clackers/base/error.hpp"
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
  explicit MotionEquation(const model::SmoothSystem<Dof>& system)
      : s_(system),
        r_(Vector::Zero(system.dof())),
        u_(r_),
        v_(r_),
        magnitude_(r_),
        term_(r_),
        matrix_(Matrix::Zero(system.dof(), system.dof())),
        dp_du_(matrix_),
        dp_dv_(matrix_),
        tangent_(system.dof()) {
    rebuild();
  }

  /// Takes in a changed mass matrix.
  void rebuild() { mass_.compute(s_.mass); }

  bool is_linear() const { return !s_.nonlinear; }
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

  /// Takes M a_weight + C v_weight + K u_weight in; false unless it is positive definite.
  bool factorize(const Weights& w, Solver& effective) {
    matrix_ = w.a * s_.mass + w.v * s_.damping + w.u * s_.stiffness;
    ++factorizations_;
    return effective.compute(matrix_);
  }

  /// Solves  M (a_weight a + shift) + C v + K u + p(u, v) = f(t)  for a, with u = u0 + u_weight a
  /// and v = v0 + v_weight a; without `shift` it counts as 0. `effective` is the factorized matrix
  /// of the same weights. False if Newton's iteration failed.
  bool solve(double t, const Weights& w, const Solver& effective, const Vector& u0,
             const Vector& v0, Vector& a, const Vector* shift = nullptr) {
    if (s_.nonlinear) return solve_nonlinear(t, w, u0, v0, a, shift);
    a.noalias() = -(s_.damping * v0);
    a.noalias() -= s_.stiffness * u0;
    if (shift != nullptr) a.noalias() -= s_.mass * *shift;
    if (s_.add_load)
      s_.add_load(t, std::span<double>(a.data(), static_cast<std::size_t>(a.size())));
    effective.solve_in_place(a);
    ++evaluations_;
    return true;
  }

  void reset_work() { evaluations_ = factorizations_ = iterations_ = 0; }
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
  static constexpr int most_iterations = 50;

  void subtract_nonlinear(const Vector& u, const Vector& v, Vector& r) {
    magnitude_.setZero();
    s_.nonlinear->add(u, v, magnitude_);
    r -= magnitude_;
  }

  // Newton's iteration down to rounding, so that no tolerance can limit an observed order.
  bool solve_nonlinear(double t, const Weights& w, const Vector& u0, const Vector& v0, Vector& a,
                       const Vector* shift) {
    for (int i = 0; i < most_iterations; ++i) {
      u_ = u0 + w.u * a;
      v_ = v0 + w.v * a;
      dp_du_.setZero();
      dp_dv_.setZero();
      s_.nonlinear->add_tangent(u_, v_, dp_du_, dp_dv_);
      const bool is_solved = balance(t, w, u0, v0, a, shift);
      ++evaluations_;
      if (is_solved) return true;
      matrix_ = w.a * s_.mass + w.v * (s_.damping + dp_dv_) + w.u * (s_.stiffness + dp_du_);
      tangent_.compute(matrix_);
      a += tangent_.solve(r_);
      ++iterations_;
      ++factorizations_;
    }
    return false;
  }

  // r_ becomes the unbalanced force at (a, u_, v_). True if it is nothing but rounding: each entry
  // is a sum of 3 n products and a few terms, so its error is below (3 n + 13) 2^-53 times the sum
  // of their magnitudes; p counts through its tangent, since a gap is a difference of large terms.
  bool balance(double t, const Weights& w, const Vector& u0, const Vector& v0, const Vector& a,
               const Vector* shift) {
    r_.setZero();
    if (s_.add_load)
      s_.add_load(t, std::span<double>(r_.data(), static_cast<std::size_t>(r_.size())));
    term_ = r_;
    subtract_nonlinear(u_, v_, r_);  // leaves p in magnitude_
    magnitude_ = magnitude_.cwiseAbs() + term_.cwiseAbs();
    const auto add = [this](const Matrix& matrix, const Vector& x) {
      r_.noalias() -= matrix * x;
      magnitude_.noalias() += matrix.cwiseAbs() * x.cwiseAbs();
    };
    term_ = w.a * a;
    add(s_.mass, term_);
    if (shift != nullptr) add(s_.mass, *shift);
    add(s_.damping, v_);
    add(s_.stiffness, u_);
    // u and v are themselves rounded sums of a predictor and the part of the unknown.
    term_ = u0.cwiseAbs() + std::abs(w.u) * a.cwiseAbs();
    magnitude_.noalias() += (s_.stiffness.cwiseAbs() + dp_du_.cwiseAbs()) * term_;
    term_ = v0.cwiseAbs() + std::abs(w.v) * a.cwiseAbs();
    magnitude_.noalias() += (s_.damping.cwiseAbs() + dp_dv_.cwiseAbs()) * term_;
    const double factor =
        (3.0 * double(a.size()) + 13.0) * 0.5 * std::numeric_limits<double>::epsilon();
    for (Eigen::Index i = 0; i < r_.size(); ++i)
      if (!(std::abs(r_[i]) <= factor * magnitude_[i])) return false;
    return true;
  }

  const model::SmoothSystem<Dof>& s_;
  Solver mass_;
  Vector r_, u_, v_, magnitude_, term_;
  Matrix matrix_, dp_du_, dp_dv_;
  Eigen::PartialPivLU<Matrix> tangent_;
  long long evaluations_ = 0, factorizations_ = 0, iterations_ = 0;
};

/// Throws InputError unless `is_definite`: the implicit matrix of a step has lost its definiteness.
inline void require_definite(std::string_view who, double h, bool is_definite) {
  if (!is_definite)
    refuse(who, "h", h, "steps for which the effective mass matrix is positive definite",
           "Stiffness or damping has a negative part; use a smaller step.",
           "not-positive-definite");
}

}  // namespace clackers::methods
