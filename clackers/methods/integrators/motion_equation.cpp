#include "clackers/methods/integrators/motion_equation.hpp"

#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::methods {
namespace {

constexpr int most_iterations = 50;

}  // namespace

template <int Dof>
MotionEquation<Dof>::MotionEquation(const model::SmoothSystem<Dof>& system)
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

template <int Dof>
void MotionEquation<Dof>::subtract_nonlinear(const Vector& u, const Vector& v, Vector& r) {
  magnitude_.setZero();
  s_.nonlinear->add(u, v, magnitude_);
  r -= magnitude_;
}

// Newton's iteration down to rounding, so that no tolerance can limit an observed order.
template <int Dof>
bool MotionEquation<Dof>::solve_nonlinear(double t, const Weights& w, const Vector& u0,
                                          const Vector& v0, Vector& a, const Vector* shift) {
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
template <int Dof>
bool MotionEquation<Dof>::balance(double t, const Weights& w, const Vector& u0, const Vector& v0,
                                  const Vector& a, const Vector* shift) {
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

template class MotionEquation<1>;
template class MotionEquation<2>;
template class MotionEquation<model::any_dof>;

void require_definite(std::string_view who, double h, bool failed) {
  if (failed)
    refuse(who, "h", h, "steps for which the effective mass matrix is positive definite",
           "Stiffness or damping has a negative part; use a smaller step.",
           "not-positive-definite");
}

}  // namespace clackers::methods
