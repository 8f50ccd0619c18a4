#include "clackers/methods/stepping/linear_step.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>

namespace clackers::methods {
namespace {

using Eigen::MatrixXd;

const double gauss_offset = std::sqrt(3.0) / 6.0;

// H h for (u, v/omega), which has entries of one size, with omega² the norm of M^-1 K; and M^-1 in
// the rows of v/omega.
struct Scaled {
  double omega;
  MatrixXd &rates, &inertia;
};

Scaled scaled_rates(const LinearSystem& s, double h, LinearStep& step) {
  const auto n = s.mass.rows();
  auto &rates = step.work[0], &inertia = step.work[1], &by_u = step.work[2];
  step.cholesky.compute(s.mass);
  inertia.setIdentity(n, n);
  step.cholesky.solveInPlace(inertia);
  by_u.noalias() = inertia * s.stiffness;
  const double stiffness = by_u.cwiseAbs().rowwise().sum().maxCoeff();
  const double omega = stiffness > 0.0 ? std::sqrt(stiffness) : 1.0 / h;
  rates.setZero(2 * n, 2 * n);
  rates.topRightCorner(n, n).diagonal().setConstant(omega * h);
  rates.bottomLeftCorner(n, n) = (-h / omega) * by_u;
  rates.bottomRightCorner(n, n).noalias() = -h * (inertia * s.damping);
  inertia /= omega;
  return {omega, rates, inertia};
}

double norm_of(const MatrixXd& x) { return x.cwiseAbs().rowwise().sum().maxCoeff(); }

// `sum` becomes exp(rates) - I; `norm` is that of the part of rates whose powers do not vanish.
void exponential_less_one(const MatrixXd& rates, double norm, const Squaring& how, MatrixXd& sum,
                          MatrixXd& product) {
  const int squarings = std::max(
      how.least, norm > 0.0 ? 1 + static_cast<int>(std::ceil(std::log2(norm / how.part))) : 0);
  const double scale = std::ldexp(1.0, -squarings);
  const auto n = rates.rows();
  // x (I + x/2 (I + x/3 (...)))
  sum.setZero(n, n);
  for (int k = how.terms; k >= 1; --k) {
    sum.diagonal().array() += 1.0;
    product.noalias() = rates * sum;
    sum = (scale / k) * product;
  }
  for (int k = 0; k < squarings; ++k) {
    product.noalias() = sum * sum;
    sum = 2.0 * sum + product;
  }
}

// From (u, v/omega) back to (u, v).
void unscale_rows(MatrixXd& x, double omega) { x.bottomRows(x.rows() / 2) *= omega; }

void set_change(const Eigen::Ref<const MatrixXd>& less_one, double omega, LinearStep& step) {
  step.change = less_one;
  unscale_rows(step.change, omega);
  step.change.rightCols(less_one.rows() / 2) /= omega;
}

}  // namespace

void LinearStep::apply(const model::Load& f, double t, double* u, double* v) const {
  const auto n = change.rows() / 2;
  Eigen::Map<Eigen::VectorXd> position(u, n), velocity(v, n);
  before_.resize(2 * n);
  before_.head(n) = position;
  before_.tail(n) = velocity;
  after_.resize(2 * n);
  after_.noalias() = change * before_;
  if (f)
    for (std::size_t k = 0; k < std::size_t(loads); ++k) {
      force_.setZero(n);
      f(t + c[k] * h, std::span<double>(force_.data(), std::size_t(n)));
      after_.noalias() += load[k] * force_;
    }
  position += after_.head(n);
  velocity += after_.tail(n);
}

void StageSolver::resize(Eigen::Index size) {
  matrix.resize(size, size);
  right.resize(size);
  solution.resize(size);
}

void StageSolver::solve() {
  lu_.compute(matrix);
  solution.noalias() = lu_.solve(right);
}

void make_collocation_step(const LinearSystem& s, const StageTable& table, LinearStep& step) {
  const auto n = s.mass.rows();
  const int count = table.stages;
  const double h = step.h;
  // The accelerations of all stages by u0, v0 and the load of each stage.
  auto &matrix = step.work[0], &right = step.work[1], &a = step.work[2];
  matrix.resize(count * n, count * n);
  right.setZero(count * n, (2 + count) * n);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      auto block = matrix.block(i * n, j * n, n, n);
      block = h * table.first(i, j) * s.damping + h * h * table.second(i, j) * s.stiffness;
      if (i == j) block += s.mass;
    }
    right.block(i * n, 0, n, n) = -s.stiffness;
    right.block(i * n, n, n, n) = -s.damping - table.time(i) * h * s.stiffness;
    right.block(i * n, (2 + i) * n, n, n).setIdentity();
  }
  step.lu.compute(matrix);
  a.resizeLike(right);
  a.noalias() = step.lu.solve(right);
  step.loads = count;
  step.change.setZero(2 * n, 2 * n);
  step.change.topRightCorner(n, n).diagonal().setConstant(h);
  for (int k = 0; k < count; ++k) {
    step.c[std::size_t(k)] = table.time(k);
    step.load[std::size_t(k)].setZero(2 * n, n);
  }
  const int last = count - 1;
  for (int i = 0; i < count; ++i) {
    const double of_u = h * h * table.second(last, i), of_v = h * table.first(last, i);
    step.change.topRows(n) += of_u * a.block(i * n, 0, n, 2 * n);
    step.change.bottomRows(n) += of_v * a.block(i * n, 0, n, 2 * n);
    for (int k = 0; k < count; ++k) {
      auto& load = step.load[std::size_t(k)];
      load.topRows(n) += of_u * a.block(i * n, (2 + k) * n, n, n);
      load.bottomRows(n) += of_v * a.block(i * n, (2 + k) * n, n, n);
    }
  }
}

void make_gauss_step(const LinearSystem& s, const Squaring& squaring, LinearStep& step) {
  const auto n = s.mass.rows();
  const auto [omega, rates, inertia] = scaled_rates(s, step.h, step);
  auto &part = step.work[3], &sum = step.work[4], &product = step.work[5];
  exponential_less_one(rates, norm_of(rates), squaring, sum, product);
  set_change(sum, omega, step);
  step.loads = 2;
  for (std::size_t k = 0; k < 2; ++k) {
    step.c[k] = k == 0 ? 0.5 - gauss_offset : 0.5 + gauss_offset;
    part = (1.0 - step.c[k]) * rates;
    exponential_less_one(part, norm_of(part), squaring, sum, product);
    sum.diagonal().array() += 1.0;
    step.load[k].noalias() = 0.5 * step.h * (sum.rightCols(n) * inertia);
    unscale_rows(step.load[k], omega);
  }
}

void make_line_step(const LinearSystem& s, const Squaring& squaring, LinearStep& step) {
  const auto n = s.mass.rows();
  const auto [omega, rates, inertia] = scaled_rates(s, step.h, step);
  // exp of (H h, h M^-1, 0; 0, 0, I; 0, 0, 0) has the integrals of the load 1 and of the load s/h.
  auto &whole = step.work[3], &sum = step.work[4], &product = step.work[5];
  whole.setZero(4 * n, 4 * n);
  whole.topLeftCorner(2 * n, 2 * n) = rates;
  whole.block(n, 2 * n, n, n) = step.h * inertia;
  whole.block(2 * n, 3 * n, n, n).setIdentity();
  exponential_less_one(whole, std::max(norm_of(rates), 1.0), squaring, sum, product);
  step.loads = 2;
  step.c = {0.5 - gauss_offset, 0.5 + gauss_offset};
  const auto constant = sum.block(0, 2 * n, 2 * n, n), rising = sum.block(0, 3 * n, 2 * n, n);
  const double length = step.c[1] - step.c[0];
  step.load[0] = (step.c[1] * constant - rising) / length;
  step.load[1] = (rising - step.c[0] * constant) / length;
  for (std::size_t k = 0; k < 2; ++k) unscale_rows(step.load[k], omega);
  set_change(sum.topLeftCorner(2 * n, 2 * n), omega, step);
}

}  // namespace clackers::methods
