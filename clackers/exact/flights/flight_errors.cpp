#include "clackers/exact/flights/flight_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/base/constants.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

using Eigen::Index;
using Matrix = FlightErrors::Matrix;
using Vector = FlightErrors::Vector;

namespace {

// What y and y' of each mode become after s seconds: factors of y, then of y'.
std::pair<Vector, Vector> factors(const ForcedModes& modes, double s) {
  const Index n = modes.dof();
  Vector unit = Vector::Zero(2 * n);
  unit.head(n).setOnes();
  return {modes.advanced(unit, s, 0.0), modes.advanced(Vector::Ones(2 * n) - unit, s, 0.0)};
}

}  // namespace

void FlightErrors::map(auto&& linear) {
  if (columns_.cols() > 0) columns_ = linear(std::move(columns_));
  if (squares_.size() == 0) return;
  Matrix half = linear(std::move(squares_));
  half.transposeInPlace();
  squares_ = half.size() > 0 ? linear(std::move(half)) : Matrix();
}

void FlightErrors::carry(const ForcedModes& modes, double s) {
  const Index n = modes.dof();
  const auto of = factors(modes, s);
  const Vector &of_value = of.first, &of_rate = of.second;
  map([&](Matrix x) {
    const Matrix values = x.topRows(n);
    x.topRows(n) = of_value.head(n).asDiagonal() * values;
    x.topRows(n) += of_rate.head(n).asDiagonal() * x.bottomRows(n);
    x.bottomRows(n).array().colwise() *= of_rate.tail(n).array();
    x.bottomRows(n) += of_value.tail(n).asDiagonal() * values;
    return x;
  });
  ball_ = carried(modes, ball_, s);
}

// A soft displacement y changes its rate by omega^2 s y at most.
auto FlightErrors::carried(const ForcedModes& modes, Ball ball, double s) const -> Ball {
  double fastest = 0.0;
  for (const auto& mode : modes.system().modes())
    if (is_soft(mode)) fastest = std::max(fastest, mode.omega);
  ball.soft += s * ball.soft_rate;
  ball.soft_rate += fastest * fastest * s * ball.soft;
  return ball;
}

void FlightErrors::add(const ForcedModes& modes, const Vector& sizes) {
  if (modes.dof() <= apart_ || modes.system().is_coupled()) {
    add_squares(sizes.cwiseAbs2().asDiagonal(), sizes.size());
    return;
  }
  add_to_ball(modes, sizes);
}

Vector FlightErrors::sizes_of_squares() const {
  return (count_ * squares_.diagonal()).cwiseMax(0.0).cwiseSqrt();
}

void FlightErrors::collapse(const ForcedModes& modes) {
  for (const auto& column : columns_.colwise()) add_to_ball(modes, column);
  if (squares_.size() > 0) add_to_ball(modes, sizes_of_squares());
  columns_.resize(Eigen::NoChange, 0);
  squares_.resize(0, 0);
  count_ = 0.0;
}

void FlightErrors::add_to_ball(const ForcedModes& modes, const Vector& sizes) {
  const Index n = modes.dof();
  double hard = 0.0, soft = 0.0, soft_rate = 0.0;
  for (Index j = 0; j < n; ++j) {
    const auto& mode = modes.system().modes()[std::size_t(j)];
    const double y = sizes[j] * sizes[j], rate = sizes[n + j] * sizes[n + j];
    (is_soft(mode) ? soft : hard) += y;
    (is_soft(mode) ? soft_rate : hard) += is_soft(mode) ? rate : rate / mode.omega_square;
  }
  ball_.hard += std::sqrt(hard);
  ball_.soft += std::sqrt(soft);
  ball_.soft_rate += std::sqrt(soft_rate);
}

void FlightErrors::add_columns(const Matrix& columns) {
  columns_.conservativeResize(Eigen::NoChange, columns_.cols() + columns.cols());
  columns_.rightCols(columns.cols()) = columns;
  if (columns_.cols() <= columns_.rows()) return;
  add_squares(columns_ * columns_.transpose(), columns_.cols());
  columns_.resize(Eigen::NoChange, 0);
}

void FlightErrors::add_squares(const Matrix& squares, Index count) {
  if (squares_.size() == 0)
    squares_ = squares;
  else
    squares_ += squares;
  count_ += double(count);
}

void FlightErrors::change(const ForcedModes& from, const ForcedModes& to,
                          const std::vector<Vector>& opened) {
  if (!ball_.empty()) change_ball(from, to, opened);
  map([&](const Matrix& x) {
    return to.change(from.derived_states(0, x), from.derived_states(1, x));
  });
  columns_.conservativeResize(2 * to.dof(), Eigen::NoChange);
}

// With M-orthonormal modes the ball is u' M u + v' M K^-1 M v. Springs that close and constraints lessen
// both; one that opens leaves what loads M v do not press on it, and the rest is one direction of v.
void FlightErrors::change_ball(const ForcedModes& from, const ForcedModes& to,
                               const std::vector<Vector>& opened) {
  const Index n = from.dof();
  const auto old = std::exchange(ball_, {});
  Vector omega = Vector::Zero(n), softness = Vector::Zero(n), is_hard = Vector::Zero(n);
  for (Index j = 0; j < n; ++j) {
    const auto& mode = from.system().modes()[std::size_t(j)];
    if (is_soft(mode)) continue;
    is_hard[j] = 1.0;
    omega[j] = mode.omega;
    softness[j] = 1.0 / mode.omega_square;
  }
  const auto add_apart = [&](const Vector& y, const Vector& rate) {
    Vector sizes(2 * n);
    sizes << y, rate;
    Matrix columns(2 * n, 0);
    for (Index j = 0; j < 2 * n; ++j) {
      if (sizes[j] == 0.0) continue;
      columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
      columns.rightCols(1) = sizes[j] * Vector::Unit(2 * n, j);
    }
    add_columns(columns);
  };
  const Vector is_soft = Vector::Ones(n) - is_hard;
  add_apart(old.soft * is_soft, old.soft_rate * is_soft);
  if (to.system().is_coupled()) return add_apart(old.hard * is_hard, old.hard * omega);
  Matrix forces(n, 0);  // orthonormal by the softness
  for (const auto& row : opened) {
    Vector force = row.head(n).cwiseProduct(is_hard);
    for (Index k = 0; k < forces.cols(); ++k)
      force -= forces.col(k).cwiseProduct(softness).dot(force) * forces.col(k);
    const double size = std::sqrt(force.cwiseAbs2().dot(softness));
    if (!(size > 0.0)) continue;
    forces.conservativeResize(Eigen::NoChange, forces.cols() + 1);
    forces.rightCols(1) = force / size;
  }
  if (forces.cols() > 0) {
    Matrix columns = Matrix::Zero(2 * n, forces.cols());
    columns.bottomRows(n) = old.hard * forces;
    add_columns(columns);
  }
  ball_.hard = old.hard;
  for (Index j = 0; j < to.dof(); ++j) {
    if (!this->is_soft(to.system().modes()[std::size_t(j)])) continue;
    const Vector y = to.displacement_of_mode(j, from).head(n).cwiseProduct(is_hard);
    const Vector rate = y - softness.cwiseProduct(forces * (forces.transpose() * y));
    ball_.soft = std::hypot(ball_.soft, old.hard * y.norm());
    ball_.soft_rate = std::hypot(ball_.soft_rate, old.hard * omega.cwiseProduct(rate).norm());
  }
}

void FlightErrors::pass(const ForcedModes& modes, const Impact& impact) {
  const auto columns_of = [&](const Matrix& directions, const Matrix& rows, double more) {
    const Vector sizes = bounds_of(ball_, modes, rows.transpose()).array() + more;
    return Matrix(directions * sizes.asDiagonal());
  };
  map([&](Matrix x) {
    const Matrix times = impact.gaps.transpose() * x, impulses = impact.rates.transpose() * x;
    x += impact.jumps * times - impact.impulses * impulses;
    return x;
  });
  add_columns(columns_of(impact.jumps, impact.gaps, impact.rounding));
  if (!ball_.empty()) add_columns(columns_of(impact.impulses, impact.rates, 0.0));
}

void FlightErrors::enlarge(double factor) {
  columns_ *= factor;
  squares_ *= factor * factor;
  for (double* radius : {&ball_.hard, &ball_.soft, &ball_.soft_rate}) *radius *= factor;
}

Vector FlightErrors::bounds_of(const Ball& ball, const ForcedModes& modes,
                               const Matrix& rows) const {
  const Index n = modes.dof();
  Vector hard = Vector::Zero(rows.rows()), soft = hard, soft_rate = hard;
  if (ball.empty()) return hard;
  for (Index j = 0; j < n; ++j) {
    const auto& mode = modes.system().modes()[std::size_t(j)];
    (is_soft(mode) ? soft : hard) += rows.col(j).cwiseAbs2();
    if (is_soft(mode))
      soft_rate += rows.col(n + j).cwiseAbs2();
    else
      hard += mode.omega_square * rows.col(n + j).cwiseAbs2();
  }
  return ball.hard * hard.cwiseSqrt() + ball.soft * soft.cwiseSqrt() +
         ball.soft_rate * soft_rate.cwiseSqrt();
}

Vector FlightErrors::bounds(const ForcedModes& modes, const Matrix& rows, double s) const {
  if (s > 0.0) {
    const Index n = modes.dof();
    const auto [of_value, of_rate] = factors(modes, s);
    Matrix before(rows.rows(), 2 * n);
    before.leftCols(n) = rows.leftCols(n) * of_value.head(n).asDiagonal();
    before.leftCols(n) += rows.rightCols(n) * of_value.tail(n).asDiagonal();
    before.rightCols(n) = rows.leftCols(n) * of_rate.head(n).asDiagonal();
    before.rightCols(n) += rows.rightCols(n) * of_rate.tail(n).asDiagonal();
    return bounds_of_columns(before) + bounds_of(carried(modes, ball_, s), modes, rows);
  }
  return bounds_of_columns(rows) + bounds_of(ball_, modes, rows);
}

Vector FlightErrors::bounds_of_columns(const Matrix& rows) const {
  Vector bound = Vector::Zero(rows.rows());
  if (columns_.cols() > 0)
    bound = numerics::product_of_halves(rows, columns_).rowwise().lpNorm<1>();
  if (squares_.size() > 0)
    bound +=
        (count_ * numerics::product_of_halves(rows, squares_).cwiseProduct(rows).rowwise().sum())
            .cwiseMax(0.0)
            .cwiseSqrt();
  return bound;
}

Vector FlightErrors::bounds_until(const ForcedModes& modes, const Matrix& rows, double s) const {
  Vector bound = bounds_of(carried(modes, ball_, s), modes, rows);
  Vector sizes = Vector::Zero(columns_.rows());
  if (columns_.cols() > 0) sizes = columns_.rowwise().lpNorm<1>();
  if (squares_.size() > 0) sizes += sizes_of_squares();
  const auto later = modes.sizes(sizes, s, 0.0);
  for (Index i = 0; i < rows.rows(); ++i) bound[i] += modes.bound(rows.row(i).transpose(), later);
  return bound;
}

}  // namespace clackers::exact
