#pragma once

#include <Eigen/LU>
#include <array>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "clackers/base/codes.hpp"
#include "clackers/methods/stepping/linear_step.hpp"
#include "clackers/model/run.hpp"
#include "clackers/model/system.hpp"
#include "clackers/numerics/banded.hpp"
#include "clackers/numerics/spd_solver.hpp"

namespace clackers::methods {

/// Working memory of a step, made from MotionEquation::scratch(): a local variable, kept in
/// registers, where the size is known to the compiler; otherwise a reference, so that nothing is
/// allocated.
template <int Dof>
using Scratch = std::conditional_t<Dof == model::any_dof, model::Vector<Dof>&, model::Vector<Dof>>;

/// A nonlinear force that is switched on and off between steps.
template <int Dof>
class SwitchedForce : public model::NonlinearForce<Dof> {
 public:
  /// True while p = 0 for every u and v.
  virtual bool vanishes() const = 0;
};

/// A load of a step: f(t), or (1 - weight) f(t) + weight f(other).
struct LoadTime {
  double t, other = 0.0, weight = 0.0;

  LoadTime(double at) : t(at) {}
  LoadTime(double at, double second, double of_second) : t(at), other(second), weight(of_second) {}
};

/// What integrators ask of M a + C v + K u + p(u, v) = f(t): its acceleration, and its solution
/// where the acceleration also moves u and v. Counts what it does. After construction nothing is
/// allocated (except by a nonlinear force or a load).
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
    bool operator==(const Weights&) const = default;
  };

  /// What has been done, and whether something has failed.
  struct Tally {
    long long evaluations = 0, factorizations = 0, iterations = 0;
    bool failed = false;
    Code failure = "run-failed";
  };

  /// The system must outlive the equation.
  explicit MotionEquation(const model::SmoothSystem<Dof>& system);
  ~MotionEquation();  // compiled once, and not in every stepper

  /// Takes in changed matrices.
  void rebuild();

  /// a becomes M^-1 (f(t) - C v - K u - p(u, v)).
  void accelerate(double t, const Vector& u, const Vector& v, Vector& a) {
    a.setZero();
    damping_.subtract_product(v, a);
    stiffness_.subtract_product(u, a);
    if (s_.add_load)
      s_.add_load(t, std::span<double>(a.data(), static_cast<std::size_t>(a.size())));
    if (!is_linear()) subtract_nonlinear(u, v, a);
    mass_.solve_in_place(a);
    ++tally_.evaluations;
  }

  /// Calls `steps` with a function that does the same as accelerate(); where there is neither load
  /// nor nonlinear force it is two products. One branch a step and not one an evaluation.
  void with_acceleration(auto&& steps) {
    if (is_free()) {
      steps([this](double, const Vector& u, const Vector& v, Vector& a) {
        a.setZero();
        by_u_.add_product(u, a);
        by_v_.add_product(v, a);
        ++tally_.evaluations;
      });
    } else {
      steps([this](double t, const Vector& u, const Vector& v, Vector& a) {
        accelerate(t, u, v, a);
      });
    }
  }

  /// M a_weight + C v_weight + K u_weight, factorized; one with these weights is made only once
  /// until it is dropped. It fails unless the matrix is positive definite.
  const Solver& factorized(const Weights& w) {
    if (used_ > 0 && factors_[0].weights == w) [[likely]]
      return factors_[0].solver;
    for (std::size_t i = 1; i < used_; ++i)
      if (factors_[i].weights == w) return factors_[i].solver;
    return factorize(w);
  }
  /// Those made until now stay until drop_all().
  void keep() { kept_ = used_; }
  /// Drops those made since keep().
  void drop_parts() {
    used_ = kept_;
    linear_steps_[1].h = 0.0;
  }
  void drop_all() {
    used_ = kept_ = 0;
    for (auto& step : linear_steps_) step.h = 0.0;
  }

  /// Solves  M (a_weight a + shift) + C v + K u + p(u, v) = f  for a, with u = u0 + u_weight a
  /// and v = v0 + v_weight a; without `shift` it counts as 0. It fails where Newton's iteration,
  /// which starts at the given a, finds no solution.
  void solve(const LoadTime& load, const Weights& w, const Vector& u0, const Vector& v0, Vector& a,
             const Vector* shift = nullptr) {
    if (!is_linear()) {
      if (!solve_nonlinear(load, w, u0, v0, a, shift)) fail("newton-failed");
      return;
    }
    a.setZero();
    damping_.subtract_product(v0, a);
    stiffness_.subtract_product(u0, a);
    if (shift != nullptr) mass_matrix_.subtract_product(*shift, a);
    if (s_.add_load) add_load(load, a);
    factorized(w).solve_in_place(a);
    ++tally_.evaluations;
  }

  /// The same with the mean of p over the chord from u_start to u_start + 2 (u - u_start) in place
  /// of p(u, v), by four points of Gauss: exact for polynomials of degree 7.
  void solve_along_chord(const Vector& u_start, const LoadTime& load, const Weights& w,
                         const Vector& u0, const Vector& v0, Vector& a) {
    chord_ = &u_start;
    solve(load, w, u0, v0, a);
    chord_ = nullptr;
  }

  /// Solves all stages of a collocation method at once for their accelerations a_i, where there is a
  /// nonlinear force; see StageTable.
  void solve_stages(double t, double h, const StageTable& table, const Vector& u0, const Vector& v0,
                    std::span<Vector> a);

  /// The map of a linear system over h that build(LinearStep&) fills; made only once until it is
  /// dropped.
  const LinearStep& linear_step(double h, const auto& build) {
    auto& first = linear_steps_[0];
    if (first.h == h) [[likely]]
      return first;
    auto& step = first.h == 0.0 ? first : linear_steps_[1];
    if (step.h == h) return step;
    step.h = h;
    build(step);
    ++tally_.factorizations;
    if (&step == &first) {
      linear_steps_[1] = first;  // allocates
      linear_steps_[1].h = 0.0;
    }
    return step;
  }
  /// Moves (u, v) by a linear step from t.
  void apply(const LinearStep& step, double t, Vector& u, Vector& v) {
    step.apply(s_.add_load, t, u.data(), v.data());
    tally_.evaluations += s_.add_load ? step.loads : 1;
  }

  /// Whether the motion is linear now, and whether it has no load, too.
  bool is_linear() const { return !s_.nonlinear || (switched_ && switched_->vanishes()); }
  bool is_free() const { return !s_.add_load && is_linear(); }

  /// True after something has failed; the state computed since is meaningless.
  bool failed() const { return tally_.failed; }
  /// The first failure. Meaningful only where failed().
  Code failure() const { return tally_.failure; }

  const Tally& tally() const { return tally_; }
  void set_tally(const Tally& tally) { tally_ = tally; }
  void add_evaluations(long long count) { tally_.evaluations += count; }
  void add_work(model::Work& work) const {
    work.force_evaluations += tally_.evaluations;
    work.factorizations += tally_.factorizations;
    work.newton_iterations += tally_.iterations;
  }

  const model::SmoothSystem<Dof>& system() const { return s_; }
  /// Vectors for an integrator to work with inside one step.
  Vector& scratch(std::size_t i) { return scratch_[i]; }

  static constexpr std::size_t most_scratch = 12;

 private:
  struct Factors {
    Weights weights{};
    Solver solver;
  };
  // Four of a step, and four of a part of one.
  static constexpr std::size_t most_factors = 8;

  void fail(Code failure) {
    if (!tally_.failed) tally_.failure = failure;
    tally_.failed = true;
  }
  const Solver& factorize(const Weights& w);
  void add_load(const LoadTime& load, Vector& to);
  void subtract_nonlinear(const Vector& u, const Vector& v, Vector& r);
  void add_tangent(const Vector& u, const Vector& v, bool as_rows);
  void correct(const Weights& w);
  bool solve_nonlinear(const LoadTime& load, const Weights& w, const Vector& u0, const Vector& v0,
                       Vector& a, const Vector* shift);
  bool balance(const LoadTime& load, const Weights& w, const Vector& u0, const Vector& v0,
               const Vector& a, const Vector* shift);

  const model::SmoothSystem<Dof>& s_;
  const SwitchedForce<Dof>* switched_;  // its nonlinear force, where it is such a one
  Solver mass_;
  Vector r_, u_, v_, magnitude_, term_, correction_;
  Vector point_, part_, stage_u_, stage_v_;
  Matrix matrix_, dp_du_, dp_dv_, by_chord_, other_;
  using Banded = numerics::BandedMatrix<Dof>;
  Banded mass_matrix_, damping_, stiffness_;
  Banded mass_size_, damping_size_, stiffness_size_;  // magnitudes of their entries
  Banded by_u_, by_v_;                                // -M^-1 K and -M^-1 C: a = by_u u + by_v v
  bool has_rows_ = false;                             // in place of dp_du_ and dp_dv_
  std::vector<typename model::NonlinearForce<Dof>::TangentRow> rows_;
  std::vector<Vector> by_rows_;
  Eigen::PartialPivLU<Matrix> tangent_;
  std::array<Factors, most_factors> factors_;
  std::size_t used_ = 0, kept_ = 0;
  std::array<LinearStep, 2> linear_steps_;  // of a step, and of a part of one
  const Vector* chord_ = nullptr;           // its start, where p is a mean over one
  StageSolver stages_;
  std::array<Vector, most_scratch> scratch_;
  Tally tally_;
};

extern template class MotionEquation<1>;
extern template class MotionEquation<2>;
extern template class MotionEquation<model::any_dof>;

/// Throws InputError if `failed`: the implicit matrix of a step of h is not positive definite.
void require_definite(std::string_view who, double h, bool failed);

/// What integrators share whose steps begin with the acceleration of the state before them.
struct AccelerationMemory {
  template <int Dof>
  struct Memory {
    explicit Memory(Eigen::Index dof) : a(model::Vector<Dof>::Zero(dof)) {}
    model::Vector<Dof> a;  ///< acceleration at the start of the step
  };

  template <int Dof>
  void start(MotionEquation<Dof>& equation, const model::State<Dof>& from,
             Memory<Dof>& memory) const {
    equation.accelerate(from.t, from.u, from.v, memory.a);
  }
};

}  // namespace clackers::methods
