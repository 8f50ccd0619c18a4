#include "clackers/methods/stepping/motion_equation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::methods {
namespace {

constexpr int most_iterations = 50;
constexpr int undamped_iterations = 5;  // enough where the iteration converges quadratically

// Gauss' rule of four points on [0, 1].
struct Point {
  double at, weight;
};
constexpr Point gauss[] = {{0.06943184420297371239, 0.17392742256872692869},
                           {0.33000947820757186760, 0.32607257743127307131},
                           {0.66999052179242813240, 0.32607257743127307131},
                           {0.93056815579702628761, 0.17392742256872692869}};

}  // namespace

template <int Dof>
MotionEquation<Dof>::MotionEquation(const model::SmoothSystem<Dof>& system)
    : s_(system),
      switched_(dynamic_cast<const SwitchedForce<Dof>*>(system.nonlinear.get())),
      r_(Vector::Zero(system.dof())),
      u_(r_),
      v_(r_),
      magnitude_(r_),
      term_(r_),
      correction_(r_),
      point_(r_),
      part_(r_),
      stage_u_(r_),
      stage_v_(r_),
      matrix_(Matrix::Zero(system.dof(), system.dof())),
      dp_du_(matrix_),
      dp_dv_(matrix_),
      by_chord_(matrix_),
      other_(matrix_),
      tangent_(system.dof()) {
  for (auto& factors : factors_) factors.solver.compute(system.mass);  // allocates
  scratch_.fill(r_);
  rebuild();
}

template <int Dof>
MotionEquation<Dof>::~MotionEquation() = default;

template <int Dof>
void MotionEquation<Dof>::rebuild() {
  mass_.compute(s_.mass);
  mass_matrix_ = s_.mass;
  damping_ = s_.damping;
  stiffness_ = s_.stiffness;
  if (s_.nonlinear) {
    mass_size_ = s_.mass.cwiseAbs();
    damping_size_ = s_.damping.cwiseAbs();
    stiffness_size_ = s_.stiffness.cwiseAbs();
  }
  matrix_ = -s_.stiffness;
  mass_.solve_in_place(matrix_);
  by_u_ = matrix_;
  matrix_ = -s_.damping;
  mass_.solve_in_place(matrix_);
  by_v_ = matrix_;
}

template <int Dof>
const typename MotionEquation<Dof>::Solver& MotionEquation<Dof>::factorize(const Weights& w) {
  assert(used_ < most_factors);
  auto& factors = factors_[used_++];
  factors.weights = w;
  ++tally_.factorizations;
  if (!factors.solver.compute({{w.a, mass_matrix_}, {w.v, damping_}, {w.u, stiffness_}}, matrix_))
    fail("not-positive-definite");
  return factors.solver;
}

template <int Dof>
void MotionEquation<Dof>::add_load(const LoadTime& load, Vector& to) {
  const auto span = [](Vector& x) {
    return std::span<double>(x.data(), static_cast<std::size_t>(x.size()));
  };
  if (load.weight == 0.0) {
    s_.add_load(load.t, span(to));
    return;
  }
  r_.setZero();
  s_.add_load(load.t, span(r_));
  term_.setZero();
  s_.add_load(load.other, span(term_));
  to += (1.0 - load.weight) * r_ + load.weight * term_;
}

template <int Dof>
void MotionEquation<Dof>::subtract_nonlinear(const Vector& u, const Vector& v, Vector& r) {
  magnitude_.setZero();
  if (chord_ == nullptr) {
    s_.nonlinear->add(u, v, magnitude_);
  } else {
    for (const auto& [at, weight] : gauss) {
      point_ = *chord_ + 2.0 * at * (u - *chord_);
      part_.setZero();
      s_.nonlinear->add(point_, v, part_);
      magnitude_ += weight * part_;
    }
  }
  r -= magnitude_;
}

// dp_du_ and dp_dv_, or their rows where these are asked for and there are some, at (u, v).
template <int Dof>
void MotionEquation<Dof>::add_tangent(const Vector& u, const Vector& v, bool as_rows) {
  if constexpr (Dof == model::any_dof) {
    rows_.clear();
    has_rows_ = as_rows && chord_ == nullptr && s_.nonlinear->add_tangent_rows(u, v, rows_);
    if (has_rows_) return;
  }
  dp_du_.setZero();
  dp_dv_.setZero();
  if (chord_ == nullptr) return s_.nonlinear->add_tangent(u, v, dp_du_, dp_dv_);
  for (const auto& [at, weight] : gauss) {
    point_ = *chord_ + 2.0 * at * (u - *chord_);
    by_chord_.setZero();
    other_.setZero();
    s_.nonlinear->add_tangent(point_, v, by_chord_, other_);
    dp_du_ += 2.0 * at * weight * by_chord_;
    dp_dv_ += weight * other_;
  }
}

// Newton's iteration down to rounding, so that no tolerance can limit an observed order. A correction
// that makes the unbalanced force larger is halved: with the kink of a contact force, full ones may
// alternate between two states.
template <int Dof>
bool MotionEquation<Dof>::solve_nonlinear(const LoadTime& load, const Weights& w, const Vector& u0,
                                          const Vector& v0, Vector& a, const Vector* shift) {
  double last = std::numeric_limits<double>::infinity();
  correction_.setZero(a.size());
  for (int i = 0; i < most_iterations; ++i) {
    u_ = u0 + w.u * a;
    v_ = v0 + w.v * a;
    add_tangent(u_, v_, true);
    const bool is_solved = balance(load, w, u0, v0, a, shift);
    ++tally_.evaluations;
    if (is_solved) return true;
    const double unbalanced = r_.norm();
    if (i >= undamped_iterations && unbalanced > last) {
      correction_ *= 0.5;
      a -= correction_;
      continue;
    }
    last = unbalanced;
    correct(w);
    a += correction_;
    ++tally_.iterations;
  }
  return false;
}

// correction_ becomes the tangent's solution for r_. Rows b add d b b^T, with the formula of Sherman and
// Morrison for them one by one: z = A^-1 b with the matrix A before.
template <int Dof>
void MotionEquation<Dof>::correct(const Weights& w) {
  if (!has_rows_) {
    matrix_ = w.a * s_.mass + w.v * (s_.damping + dp_dv_) + w.u * (s_.stiffness + dp_du_);
    tangent_.compute(matrix_);
    correction_ = tangent_.solve(r_);
    ++tally_.factorizations;
    return;
  }
  const auto& solver = factorized(w);
  const auto add_row = [&](std::size_t i, Vector& x) {
    const auto& [b, by_u, by_v] = rows_[i];
    const double d = w.u * by_u + w.v * by_v;
    x -= d * b->dot(x) / (1.0 + d * b->dot(by_rows_[i])) * by_rows_[i];
  };
  correction_ = r_;
  solver.solve_in_place(correction_);
  by_rows_.resize(std::max(by_rows_.size(), rows_.size()), r_);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    by_rows_[j] = *rows_[j].b;
    solver.solve_in_place(by_rows_[j]);
    for (std::size_t i = 0; i < j; ++i) add_row(i, by_rows_[j]);
    add_row(j, correction_);
  }
}

// r_ becomes the unbalanced force at (a, u_, v_). True if it is nothing but rounding: each entry
// is a sum of 3 n products and a few terms, so its error is below (3 n + 13) 2^-53 times the sum
// of their magnitudes; p counts through its tangent, since a gap is a difference of large terms. Sums
// and products below the least normal number are rounded as if they were of its size.
template <int Dof>
bool MotionEquation<Dof>::balance(const LoadTime& load, const Weights& w, const Vector& u0,
                                  const Vector& v0, const Vector& a, const Vector* shift) {
  magnitude_.setZero();
  if (s_.add_load) add_load(load, magnitude_);
  r_ = term_ = magnitude_;
  subtract_nonlinear(u_, v_, r_);  // leaves p in magnitude_
  constexpr double least = std::numeric_limits<double>::min();
  magnitude_ = magnitude_.cwiseAbs() + term_.cwiseAbs();
  magnitude_.array() += least;
  const auto add = [this](const Banded& matrix, const Banded& sizes, const Vector& x) {
    matrix.subtract_product(x, r_);
    part_ = x.cwiseAbs();
    sizes.add_product(part_, magnitude_);
  };
  term_ = w.a * a;
  add(mass_matrix_, mass_size_, term_);
  // a is a rounded sum of the one before and a correction.
  part_ = std::abs(w.a) * (a - correction_).cwiseAbs();
  mass_size_.add_product(part_, magnitude_);
  if (shift != nullptr) add(mass_matrix_, mass_size_, *shift);
  add(damping_, damping_size_, v_);
  add(stiffness_, stiffness_size_, u_);
  // u and v are themselves rounded sums of a predictor and the part of the unknown.
  term_ = (u0.cwiseAbs() + std::abs(w.u) * a.cwiseAbs()).array() + least;
  stiffness_size_.add_product(term_, magnitude_);
  part_ = (v0.cwiseAbs() + std::abs(w.v) * a.cwiseAbs()).array() + least;
  damping_size_.add_product(part_, magnitude_);
  if (has_rows_) {
    for (const auto& [b, by_u, by_v] : rows_)
      magnitude_ +=
          (std::abs(by_u) * b->cwiseAbs().dot(term_) + std::abs(by_v) * b->cwiseAbs().dot(part_)) *
          b->cwiseAbs();
  } else if (s_.nonlinear) {
    magnitude_.noalias() += dp_du_.cwiseAbs() * term_;
    magnitude_.noalias() += dp_dv_.cwiseAbs() * part_;
  }
  const double factor =
      (3.0 * double(a.size()) + 13.0) * 0.5 * std::numeric_limits<double>::epsilon();
  for (Eigen::Index i = 0; i < r_.size(); ++i)
    if (!(std::abs(r_[i]) <= factor * magnitude_[i])) return false;
  return true;
}

template <int Dof>
void MotionEquation<Dof>::solve_stages(double t, double h, const StageTable& table,
                                       const Vector& u0, const Vector& v0, std::span<Vector> a) {
  const auto n = u0.size();
  const int count = table.stages;
  stages_.resize(count * n);
  correction_.setZero(n);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    bool is_solved = true;
    for (int i = 0; i < count; ++i) {
      u_ = u0 + table.time(i) * h * v0;
      v_ = v0;
      for (int j = 0; j < count; ++j) {
        u_ += h * h * table.second(i, j) * a[std::size_t(j)];
        v_ += h * table.first(i, j) * a[std::size_t(j)];
      }
      add_tangent(u_, v_, false);
      const Weights own{1.0, h * table.first(i, i), h * h * table.second(i, i)};
      auto& a_i = a[std::size_t(i)];
      stage_u_ = u_ - own.u * a_i;
      stage_v_ = v_ - own.v * a_i;
      is_solved =
          balance(t + table.time(i) * h, own, stage_u_, stage_v_, a_i, nullptr) && is_solved;
      ++tally_.evaluations;
      stages_.right.segment(i * n, n) = r_;
      for (int j = 0; j < count; ++j) {
        auto block = stages_.matrix.block(i * n, j * n, n, n);
        block = h * table.first(i, j) * (s_.damping + dp_dv_) +
                h * h * table.second(i, j) * (s_.stiffness + dp_du_);
        if (i == j) block += s_.mass;
      }
    }
    if (is_solved) return;
    stages_.solve();
    for (int i = 0; i < count; ++i) a[std::size_t(i)] += stages_.solution.segment(i * n, n);
    ++tally_.iterations;
    ++tally_.factorizations;
  }
  fail("newton-failed");
}

template class MotionEquation<1>;
template class MotionEquation<2>;
template class MotionEquation<model::any_dof>;

void require_definite(std::string_view who, double h, bool failed) {
  if (failed)
    refuse(who, "h", h, "steps for which the effective mass matrix is positive definite",
           "Stiffness, damping or a weight of the method has a negative part; use a smaller step.",
           "not-positive-definite");
}

}  // namespace clackers::methods
