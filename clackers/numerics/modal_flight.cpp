#include "clackers/numerics/modal_flight.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace clackers::numerics {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr double coupling_tolerance = 1e-10;

bool is_diagonal(const MatrixXd& x) { return x == MatrixXd(x.diagonal().asDiagonal()); }

}  // namespace

Mode::Mode(double decay, double square)
    : sigma(decay),
      omega_square(square),
      w(std::sqrt(std::abs(square - decay * decay))),
      omega(std::sqrt(square)) {}

ModalState advance(const Mode& mode, const ModalState& start, double s) {
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
    const double slow = std::exp((mode.w - mode.sigma) * s);
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

std::optional<ModalSystem> ModalSystem::make(const MatrixXd& mass, const MatrixXd& damping,
                                             const MatrixXd& stiffness) {
  if (!mass.allFinite() || !damping.allFinite() || !stiffness.allFinite()) return std::nullopt;
  ModalSystem made;
  const Index n = mass.rows();
  made.diagonal_ = is_diagonal(mass) && is_diagonal(damping) && is_diagonal(stiffness);
  Eigen::VectorXd squares;
  if (made.diagonal_) {
    if (!(mass.diagonal().minCoeff() > 0.0)) return std::nullopt;
    made.shapes_ = mass.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
    squares = stiffness.diagonal().cwiseQuotient(mass.diagonal());
  } else {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(stiffness, mass);
    if (solver.info() != Eigen::Success) return std::nullopt;
    made.shapes_ = solver.eigenvectors();
    squares = solver.eigenvalues();
  }
  const MatrixXd modal_damping = made.diagonal_
                                     ? MatrixXd(damping * mass.inverse())
                                     : MatrixXd(made.shapes_.transpose() * damping * made.shapes_);
  if (!modal_damping.allFinite() || !squares.allFinite()) return std::nullopt;
  const MatrixXd coupling = modal_damping - MatrixXd(modal_damping.diagonal().asDiagonal());
  if (coupling.cwiseAbs().maxCoeff() > coupling_tolerance * modal_damping.cwiseAbs().maxCoeff())
    return std::nullopt;
  made.inverse_ = made.shapes_.transpose() * mass;
  for (Index j = 0; j < n; ++j) {
    // A rigid body mode has an eigenvalue 0 give or take a rounding.
    double square = squares[j];
    if (square < 0.0 && square > -1e-12 * squares.cwiseAbs().maxCoeff()) square = 0.0;
    if (!(square >= 0.0)) return std::nullopt;
    made.modes_.emplace_back(0.5 * modal_damping(j, j), square);
    made.fastest_ = std::max(
        {made.fastest_, made.modes_.back().omega, 2.0 * std::abs(made.modes_.back().sigma)});
  }
  return made;
}

void ModalSystem::to_modes(std::span<const double> u, std::span<const double> v,
                           std::span<ModalState> modes) const {
  for (Index j = 0; j < dof(); ++j) {
    ModalState state;
    for (Index i = 0; i < dof(); ++i) {
      state.y += inverse_(j, i) * u[std::size_t(i)];
      state.rate += inverse_(j, i) * v[std::size_t(i)];
    }
    modes[std::size_t(j)] = state;
  }
}

void ModalSystem::sample(std::span<const ModalState> start, double s, std::span<double> u,
                         std::span<double> v) const {
  std::fill(u.begin(), u.end(), 0.0);
  std::fill(v.begin(), v.end(), 0.0);
  for (Index j = 0; j < dof(); ++j) {
    const auto now = advance(modes_[std::size_t(j)], start[std::size_t(j)], s);
    const Index first = diagonal_ ? j : 0, last = diagonal_ ? j + 1 : dof();
    for (Index i = first; i < last; ++i) {
      u[std::size_t(i)] += shapes_(i, j) * now.y;
      if (!v.empty()) v[std::size_t(i)] += shapes_(i, j) * now.rate;
    }
  }
}

LocalBound linear_form(const ModalSystem& system, std::span<const ModalState> start,
                       std::span<const double> row, double offset, double sign, double s) {
  LocalBound bound{offset, 0.0, 0.0, std::numeric_limits<double>::infinity()};
  double growth = 0.0;
  for (std::size_t j = 0; j < row.size(); ++j) {
    const Mode& mode = system.modes()[j];
    const auto now = advance(mode, start[j], s);
    bound.value += row[j] * now.y;
    bound.slope += row[j] * now.rate;
    bound.curvature += std::abs(row[j]) * std::hypot(2.0 * mode.sigma, mode.omega) *
                       std::hypot(now.rate, mode.omega * now.y);
    growth = std::max(growth, -mode.sigma);
  }
  if (growth > 0.0) {
    bound.reach = 0.25 / growth;
    bound.curvature *= 1.6488;  // more than e^(2 growth reach) = e^(1/2)
  }
  bound.value *= sign;
  bound.slope *= sign;
  return bound;
}

}  // namespace clackers::numerics
