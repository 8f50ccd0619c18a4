#include "clackers/numerics/modes/modal_flight.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/numerics/linear_algebra.hpp"
#include "clackers/numerics/modes/coupled_modes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace clackers::numerics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool is_diagonal(const MatrixXd& x) { return x == MatrixXd(x.diagonal().asDiagonal()); }

Mode::Mode(double decay, double square)
    : sigma(decay),
      omega_square(square),
      w(std::sqrt(std::abs(square - decay * decay))),
      omega(std::sqrt(std::abs(square))) {}

double Mode::growth() const {
  return std::max(0.0, -2.0 * sigma) + (omega_square < 0.0 ? omega : 0.0);
}

ModalState advance(const Mode& mode, const ModalState& start, double s) {
  // Without a product with y, which a mass at rest keeps.
  if (mode.omega_square == 0.0) {
    const double x = -2.0 * mode.sigma * s;
    const double covered = x != 0.0 ? s * (std::expm1(x) / x) : s;
    return {start.y + start.rate * covered, start.rate * std::exp(x)};
  }
  const double p = start.y, r = start.rate + mode.sigma * start.y;
  const double x = mode.w * s;
  double c = 1.0, n = s, signed_square = 0.0, decay = 0.0;
  if (mode.oscillates()) {
    c = std::cos(x);
    n = std::sin(x) / mode.w;
    signed_square = mode.w * mode.w;
    decay = std::exp(-mode.sigma * s);
  } else if (mode.w > 0.0) {
    // e^(-sigma s) cosh and sinh, neither of which may overflow alone.
    const double rate =
        mode.sigma > 0.0 ? -mode.omega_square / (mode.sigma + mode.w) : mode.w - mode.sigma;
    const double slow = std::exp(rate * s);
    const double e = std::exp(-2.0 * x);
    c = 0.5 * (1.0 + e);
    n = -0.5 * std::expm1(-2.0 * x) / mode.w;
    signed_square = -mode.w * mode.w;
    decay = slow;
  } else {
    decay = std::exp(-mode.sigma * s);
  }
  const double y = decay * (p * c + r * n);
  return {y, decay * (r * c - signed_square * p * n) - mode.sigma * y};
}

ModalState pushed(const Mode& mode, const ModalState& push, double s) {
  const double rate = advance(mode, {0.0, 1.0}, s).y;  // of a unit force
  double displacement = 0.0;
  if (mode.sigma > 0.0 && !mode.oscillates() && mode.w * s > 0.5) {
    const auto mean = [](double x) { return x != 0.0 ? -std::expm1(-x) / x : 1.0; };
    const double fast = mode.sigma + mode.w;
    displacement = s * (mean(mode.omega_square / fast * s) - mean(fast * s)) / (2.0 * mode.w);
  } else if (mode.omega * s > 1.0) {
    displacement = (1.0 - advance(mode, {1.0, 0.0}, s).y) / mode.omega_square;
  } else {
    // s^2 times the power series of y'' = 1 - 2 sigma y' - omega^2 y.
    const double x = 2.0 * mode.sigma * s, square = mode.omega_square * s * s;
    double before = 0.0, term = 0.5, sum = 0.0;
    for (int k = 3; std::abs(term) + std::abs(before) > 0.25 * epsilon; ++k) {
      sum += term;
      const double next = -(x * (k - 1) * term + square * before) / (k * (k - 1));
      before = std::exchange(term, next);
    }
    displacement = s * s * sum;
  }
  return {push.y * (rate + 2.0 * mode.sigma * displacement) + push.rate * displacement,
          push.rate * rate - push.y * mode.omega_square * displacement};
}

std::optional<ModalSystem> ModalSystem::make(const MatrixXd& mass, const MatrixXd& damping,
                                             const MatrixXd& stiffness) {
  if (!mass.allFinite() || !damping.allFinite() || !stiffness.allFinite()) return std::nullopt;
  ModalSystem made;
  const Index n = mass.rows();
  made.shapes_ = made.rate_shapes_ = made.inverse_ = MatrixXd::Zero(n, n);
  if (n == 0) return made;
  made.diagonal_ = is_diagonal(mass) && is_diagonal(damping) && is_diagonal(stiffness);
  MatrixXd basis, modal_damping, modal_stiffness;
  if (made.diagonal_) {
    if (!(mass.diagonal().minCoeff() > 0.0)) return std::nullopt;
    basis = mass.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
    modal_damping = damping.diagonal().cwiseQuotient(mass.diagonal()).asDiagonal();
    modal_stiffness = stiffness.diagonal().cwiseQuotient(mass.diagonal()).asDiagonal();
  } else {
    // Where K has equal eigenvalues any basis of theirs is one of eigenvectors; K + C weight, of no
    // special weight, has those of both if there are any.
    const double c = damping.cwiseAbs().maxCoeff(), k = stiffness.cwiseAbs().maxCoeff();
    for (const double weight : {0.0, c > 0.0 ? 0.6180339887498949 * (k > 0.0 ? k : c) / c : 0.0}) {
      const auto modes = normal_modes(stiffness + weight * damping, mass);
      if (!modes) return std::nullopt;
      basis = modes->shapes;
      modal_damping = basis.transpose() * damping * basis;
      modal_stiffness = basis.transpose() * stiffness * basis;
      if (weight == 0.0) modal_stiffness = modes->squares.asDiagonal();
      if (coupled_blocks(modal_damping, modal_stiffness).size() == std::size_t(n)) break;
    }
  }
  if (!modal_damping.allFinite() || !modal_stiffness.allFinite()) return std::nullopt;
  // A rigid body mode has an eigenvalue 0 give or take a rounding.
  const double rounding = made.diagonal_ ? 0.0 : rounding_of(modal_stiffness);
  for (const auto& block : coupled_blocks(modal_damping, modal_stiffness)) {
    if (block.size() > 1) {
      if (!made.add_coupled(block, modal_damping, modal_stiffness)) return std::nullopt;
      continue;
    }
    const Index j = block[0];
    const double square = modal_stiffness(j, j);
    made.shapes_(j, Index(made.modes_.size())) = 1.0;
    made.modes_.emplace_back(0.5 * modal_damping(j, j),
                             std::abs(square) <= rounding ? 0.0 : square);
  }
  for (const auto& mode : made.modes_)
    made.fastest_ = std::max({made.fastest_, mode.omega, 2.0 * std::abs(mode.sigma)});
  made.inverse_ = basis.transpose() * mass;
  const bool is_coupled = !made.rate_shapes_.isZero(0.0);
  if (is_coupled) {
    MatrixXd whole(2 * n, 2 * n);
    whole << made.derivative(0), made.derivative(1);
    MatrixXd both = MatrixXd::Zero(2 * n, 2 * n);
    both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = made.inverse_;
    made.whole_inverse_ = whole.partialPivLu().solve(both);
    if (!made.whole_inverse_.allFinite()) return std::nullopt;
  } else {
    made.inverse_ = made.shapes_.transpose() * made.inverse_;
  }
  made.shapes_ = basis * made.shapes_;
  made.rate_shapes_ = is_coupled ? MatrixXd(basis * made.rate_shapes_) : MatrixXd();
  return made;
}

ModalSystem::ModalSystem(std::vector<Mode> modes, MatrixXd shapes, MatrixXd coordinates)
    : modes_(std::move(modes)), shapes_(std::move(shapes)), inverse_(std::move(coordinates)) {
  for (const auto& mode : modes_)
    fastest_ = std::max({fastest_, mode.omega, 2.0 * std::abs(mode.sigma)});
}

MatrixXd ModalSystem::derivative(int order, Index first, Index count) const {
  const auto m = std::ssize(modes_);
  MatrixXd rows = MatrixXd::Zero(count, 2 * m);
  rows.leftCols(m) = shapes_.middleRows(first, count);
  if (rate_shapes_.size() > 0) rows.rightCols(m) = rate_shapes_.middleRows(first, count);
  for (; order > 0; --order)
    for (Index j = 0; j < m; ++j) {
      const auto& mode = modes_[std::size_t(j)];
      const VectorXd of_rate = rows.col(m + j);
      rows.col(m + j) = rows.col(j) - 2.0 * mode.sigma * of_rate;
      rows.col(j) = -mode.omega_square * of_rate;
    }
  return rows;
}

MatrixXd ModalSystem::inverse() const {
  if (is_coupled()) return whole_inverse_;
  const Index n = dof(), m = std::ssize(modes_);
  MatrixXd both = MatrixXd::Zero(2 * m, 2 * n);
  both.topLeftCorner(m, n) = both.bottomRightCorner(m, n) = inverse_;
  return both;
}

ModalSystem ModalSystem::seen_through(const MatrixXd& basis, const MatrixXd& inverse) const {
  ModalSystem seen = *this;
  const Index n = inverse.cols(), m = std::ssize(modes_);
  seen.diagonal_ = false;
  seen.shapes_ = basis * shapes_;
  seen.inverse_ = inverse_ * inverse;
  if (!is_coupled()) return seen;
  seen.rate_shapes_ = basis * rate_shapes_;
  seen.whole_inverse_.resize(2 * m, 2 * n);
  seen.whole_inverse_ << whole_inverse_.leftCols(m) * inverse,
      whole_inverse_.rightCols(m) * inverse;
  return seen;
}

void ModalSystem::add_amplitudes(std::span<const ModalState> start, std::span<double> u,
                                 std::span<double> v) const {
  for (Index j = 0; j < std::ssize(modes_); ++j) {
    const Mode& mode = modes_[std::size_t(j)];
    const auto& [y, rate] = start[std::size_t(j)];
    const double z = std::hypot(rate, mode.omega * y);
    const double y_size = mode.omega > 0.0 ? z / mode.omega : std::abs(y);
    const double acceleration = std::hypot(2.0 * mode.sigma, mode.omega) * z;
    for (Index i = 0; i < dof(); ++i) {
      const double shape = std::abs(shapes_(i, j));
      const double rate_shape = is_coupled() ? std::abs(rate_shapes_(i, j)) : 0.0;
      u[std::size_t(i)] += shape * y_size + rate_shape * z;
      v[std::size_t(i)] += shape * z + rate_shape * acceleration;
    }
  }
}

void ModalSystem::to_modes(std::span<const double> u, std::span<const double> v,
                           std::span<ModalState> modes) const {
  const Index n = dof(), m = std::ssize(modes_);
  for (Index j = 0; j < m; ++j) {
    ModalState state;
    if (diagonal_) {
      state = {inverse_(j, j) * u[std::size_t(j)], inverse_(j, j) * v[std::size_t(j)]};
    } else if (!is_coupled()) {
      for (Index i = 0; i < n; ++i) {
        state.y += inverse_(j, i) * u[std::size_t(i)];
        state.rate += inverse_(j, i) * v[std::size_t(i)];
      }
    } else {
      for (Index i = 0; i < n; ++i) {
        state.y += whole_inverse_(j, i) * u[std::size_t(i)];
        state.y += whole_inverse_(j, n + i) * v[std::size_t(i)];
        state.rate += whole_inverse_(m + j, i) * u[std::size_t(i)];
        state.rate += whole_inverse_(m + j, n + i) * v[std::size_t(i)];
      }
    }
    modes[std::size_t(j)] = state;
  }
}

void ModalSystem::sample(std::span<const ModalState> start, double s, std::span<double> u,
                         std::span<double> v) const {
  std::fill(u.begin(), u.end(), 0.0);
  std::fill(v.begin(), v.end(), 0.0);
  for (Index j = 0; j < std::ssize(modes_); ++j) {
    const Mode& mode = modes_[std::size_t(j)];
    const auto now = advance(mode, start[std::size_t(j)], s);
    const double acceleration = mode.acceleration(now.y, now.rate);
    const Index first = diagonal_ ? j : 0, last = diagonal_ ? j + 1 : dof();
    for (Index i = first; i < last; ++i) {
      u[std::size_t(i)] += shapes_(i, j) * now.y;
      if (!v.empty()) v[std::size_t(i)] += shapes_(i, j) * now.rate;
      if (!is_coupled()) continue;
      u[std::size_t(i)] += rate_shapes_(i, j) * now.rate;
      if (!v.empty()) v[std::size_t(i)] += rate_shapes_(i, j) * acceleration;
    }
  }
}

}  // namespace clackers::numerics
