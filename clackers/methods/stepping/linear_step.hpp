#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <array>

#include "clackers/model/system.hpp"

// What methods need whose step couples all unknowns at once, for every size the same.
namespace clackers::methods {

/// A step of a linear system as a map of x = (u, v):  x1 = x0 + change x0 + sum_k load_k f(t0 + c_k h).
struct LinearStep {
  static constexpr std::size_t most_loads = 3;

  double h = 0.0;  ///< [s]
  Eigen::MatrixXd change;
  int loads = 0;
  std::array<double, most_loads> c{};
  std::array<Eigen::MatrixXd, most_loads> load;

  /// For who makes it.
  std::array<Eigen::MatrixXd, 6> work;
  Eigen::LLT<Eigen::MatrixXd> cholesky;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;

  /// Moves u and v from t on; `f` may be empty.
  void apply(const model::Load& f, double t, double* u, double* v) const;

 private:
  mutable Eigen::VectorXd before_, after_, force_;
};

/// Stages of a collocation method on (u, v)' = (v, a(t, u, v)):
///
///     v_i = v0 + h sum_j A_ij a_j,  u_i = u0 + c_i h v0 + h² sum_j (A²)_ij a_j
///     M a_i + C v_i + K u_i + p(u_i, v_i) = f(t0 + c_i h)
///
/// The last stage is the end of the step.
struct StageTable {
  static constexpr int most_stages = 3;

  int stages;
  std::array<std::array<double, most_stages>, most_stages> a;

  double first(int i, int j) const { return a[std::size_t(i)][std::size_t(j)]; }
  double second(int i, int j) const {
    double sum = 0.0;
    for (int k = 0; k < stages; ++k) sum += first(i, k) * first(k, j);
    return sum;
  }
  double time(int i) const {
    double sum = 0.0;
    for (int j = 0; j < stages; ++j) sum += first(i, j);
    return sum;
  }
};

/// The linear equations of all stages together.
struct StageSolver {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right, solution;

  void resize(Eigen::Index size);
  void solve();

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

/// The matrices of a system of any size.
struct LinearSystem {
  Eigen::Ref<const Eigen::MatrixXd> mass, damping, stiffness;

  template <int Dof>
  explicit LinearSystem(const model::SmoothSystem<Dof>& s)
      : mass(s.mass), damping(s.damping), stiffness(s.stiffness) {}
};

/// The step of a collocation method.
void make_collocation_step(const LinearSystem& system, const StageTable& table, LinearStep& step);

/// How exp(H h) is made: its Taylor polynomial of degree `terms` for a part of h in which the
/// motion turns by `part` at most, then squared; I is added last.
struct Squaring {
  int terms;
  double part;
  int least;  ///< squarings
};
/// The load by Gauss' rule of two points on  integral of exp(H (h - s)) (0, M^-1 f(t0 + s)).
void make_gauss_step(const LinearSystem& system, const Squaring& squaring, LinearStep& step);
/// That integral for the line through the load at those two points.
void make_line_step(const LinearSystem& system, const Squaring& squaring, LinearStep& step);

}  // namespace clackers::methods
