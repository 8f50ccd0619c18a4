// What rounding, and what the modes leave of the equations, do to a flight.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clackers/base/constants.hpp"
#include "clackers/exact/flights/forced_modes.hpp"

namespace clackers::exact {

using Eigen::Index;
using Matrix = ForcedModes::Matrix;
using Vector = ForcedModes::Vector;

namespace {

// A product A x with the sizes of the entries of A, which are not copied.
Vector product_of_sizes(const Matrix& a, const Vector& x) {
  Vector y = Vector::Zero(a.rows());
  for (Index j = 0; j < a.cols(); ++j) y += a.col(j).cwiseAbs() * x[j];
  return y;
}
Vector transposed_product_of_sizes(const Matrix& a, const Vector& x) {
  Vector y(a.cols());
  for (Index j = 0; j < a.cols(); ++j) y[j] = a.col(j).cwiseAbs().dot(x);
  return y;
}

}  // namespace

Vector ForcedModes::derived_sizes(int order, const Vector& z) const {
  const Index n = dof();
  Vector y = z.head(n), rate = z.tail(n);
  for (; order > 0; --order)
    for (Index j = 0; j < n; ++j) {
      const auto& mode = system_.modes()[std::size_t(j)];
      y[j] = std::abs(mode.omega_square) * y[j] + 2.0 * std::abs(mode.sigma) * rate[j];
      std::swap(y[j], rate[j]);
    }
  Vector u = product_of_sizes(system_.shapes(), y);
  if (system_.is_coupled()) u += product_of_sizes(system_.rate_shapes(), rate);
  return onto_.sizes(u);
}

Vector ForcedModes::row_of_sizes(int order, const Vector& direction) const {
  const Index n = dof();
  Vector row = Vector::Zero(2 * n);
  if (direction.isZero(0.0)) return row;
  const Vector sizes = onto_.sizes_transposed(direction.cwiseAbs());
  row.head(n) = transposed_product_of_sizes(system_.shapes(), sizes);
  if (system_.is_coupled()) row.tail(n) = transposed_product_of_sizes(system_.rate_shapes(), sizes);
  for (; order > 0; --order)
    for (Index j = 0; j < n; ++j) {
      const auto& mode = system_.modes()[std::size_t(j)];
      row[j] += 2.0 * std::abs(mode.sigma) * row[n + j];
      row[n + j] *= std::abs(mode.omega_square);
      std::swap(row[j], row[n + j]);
    }
  return row;
}

Vector ForcedModes::impulse_sizes(const Vector& impulse) const {
  if (system_.is_coupled()) return product_of_sizes(impulse_response_, impulse);
  Vector z = Vector::Zero(2 * dof());
  z.tail(dof()) = transposed_product_of_sizes(system_.shapes(), impulse);
  return z;
}

// What the modes leave of the equations of the structure and of their own inverse, and the rounding of
// that.
void ForcedModes::find_residuals() {
  if (square_errors_.size() > 0 || dof() == 0) return;
  const Index n = dof(), all = mass_.rows();
  const double rounding = 2.0 * double(all) * epsilon;
  std::vector<Matrix> derivatives, sizes;
  for (int order = 0; order <= 2; ++order) {
    derivatives.push_back(system_.derivative(order));
    sizes.push_back(onto_.sizes(derivatives.back().cwiseAbs()));
  }
  Matrix whole(2 * all, 2 * n), whole_size(2 * all, 2 * n);
  whole << derivatives[0], derivatives[1];
  whole_size << sizes[0], sizes[1];
  const Matrix inverse = system_.inverse();
  basis_residual_ = (inverse * whole - Matrix::Identity(2 * n, 2 * n)).cwiseAbs() +
                    rounding * inverse.cwiseAbs() * whole_size;
  const Matrix left =
      mass_ * derivatives[2] + damping_ * derivatives[1] + stiffness_ * derivatives[0];
  const auto size_of = [](const Sparse& x) { return Sparse(x.cwiseAbs()); };
  const Matrix size =
      size_of(mass_) * sizes[2] + size_of(damping_) * sizes[1] + size_of(stiffness_) * sizes[0];
  Matrix response = Matrix::Zero(2 * n, all);
  if (system_.is_coupled())
    response = impulse_response_;
  else
    response.bottomRows(n) = system_.shapes().transpose();
  force_residual_ = (response * left).cwiseAbs() + rounding * response.cwiseAbs() * size;
}

// Without a defect only what rounding does.
Vector ForcedModes::shift(const Vector& whole) const {
  if (square_errors_.size() == 0) return basis_residual_ * whole;
  Vector sums(whole.size());
  for (const int order : {0, 1}) {
    const Vector of_structure = derived_sizes(order, whole);
    for (Index j = 0; j < dof(); ++j)
      sums[order * dof() + j] = system_.coordinates().row(j).cwiseAbs().dot(of_structure);
  }
  return 2.0 * double(mass_.rows()) * epsilon * sums;
}

// Cauchy and Schwarz bound the sums.
Vector ForcedModes::precise_change_errors(const Vector& z) const {
  Vector errors(z.size());
  errors.head(dof()).setConstant(precise_->change_error * z.head(dof()).lpNorm<1>());
  errors.tail(dof()).setConstant(precise_->change_error * z.tail(dof()).lpNorm<1>());
  return errors;
}

Vector ForcedModes::defect(const Vector& whole, bool precise) const {
  if (square_errors_.size() == 0) return force_residual_ * whole;
  Vector made = Vector::Zero(whole.size());
  made.tail(dof()) =
      (precise ? precise_->square_errors : square_errors_).cwiseProduct(whole.head(dof()));
  return made;
}

Vector ForcedModes::acceleration_defect(const Vector& whole) const {
  Vector sum = defect(whole);
  for (const auto& force : forces_) sum += force.defect_per_time;
  return derived_sizes(1, sum);
}

Vector ForcedModes::Force::sizes(double t) const {
  Vector sizes = steady.cwiseAbs();
  for (const auto& [j, beat, y, rate] : resonances) {
    sizes[j] += y.bound(beat.most(t));
    sizes[sizes.size() / 2 + j] += rate.bound(beat.most(t));
  }
  return sizes;
}

Vector ForcedModes::steady_sizes(int order, double t) const {
  Vector most = Vector::Zero(mass_.rows());
  for (const auto& force : forces_) {
    Matrix parts(2 * dof(), 2);
    parts << force.steady.real(), force.steady.imag();
    most += std::pow(force.frequency, order) * derived_states(0, parts).rowwise().norm();
    for (const auto& resonance : force.resonances) {
      Vector alone = Vector::Zero(2 * dof());
      alone[resonance.mode] = resonance.y.bound(resonance.beat.most(t));
      most += std::pow(force.frequency, order) * derived_states(0, alone).cwiseAbs();
    }
  }
  return most;
}

// The energy of a mode, rate^2 + omega^2 y^2, does not grow where nothing pushes it. What a constant force adds is
// bounded by what it adds without stiffness, and omega^2 y of that.
ForcedModes::Sizes ForcedModes::sizes(const Vector& z, double s, double push) const {
  const Index n = dof();
  Sizes size{Vector(n), Vector(n)};
  for (Index j = 0; j < n; ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    const double omega = mode.omega;
    size.rate[j] = std::sqrt(z[n + j] * z[n + j] + omega * omega * z[j] * z[j]);
    size.y[j] = std::abs(z[j]) + s * std::abs(z[n + j]);
    if (omega > 0.0) size.y[j] = std::min(size.y[j], size.rate[j] / omega);
    if (push == 0.0 || push_.empty()) continue;
    const auto& [y, rate] = push_[std::size_t(j)];
    const numerics::Mode loose(mode.sigma, 0.0);
    const double rate_added = numerics::pushed(loose, {0.0, std::abs(rate)}, s).rate;
    const double y_added = s * (std::abs(y) + rate_added);
    size.y[j] += y_added;
    size.rate[j] += rate_added + omega * (1.0 + omega * s) * y_added;
  }
  return size;
}

double ForcedModes::bound(const Eigen::Ref<const Vector>& row, const Sizes& sizes) const {
  const Index n = dof();
  double sum = 0.0;
  for (Index j = 0; j < n; ++j) {
    const double omega = system_.modes()[std::size_t(j)].omega;
    const double apart = std::abs(row[j]) * sizes.y[j] + std::abs(row[n + j]) * sizes.rate[j];
    const double together =
        omega > 0.0
            ? std::sqrt(row[j] * row[j] / (omega * omega) + row[n + j] * row[n + j]) * sizes.rate[j]
            : apart;
    sum += std::min(apart, together);
  }
  return sum;
}

// The sums and products of a flight and of a change to modes and back; the modes' own frequencies,
// whose relative error of 4 epsilon turns a mode by omega s as much; the phase of the forces; and the
// residuals.
Vector ForcedModes::local_errors(const Vector& z, double t, double s, bool precise) const {
  const Index n = dof();
  const double unit = precise ? precise_->unit : epsilon;
  const auto size = sizes(z, s);
  Vector whole(2 * n), error = Vector::Zero(2 * n), growth = Vector::Zero(2 * n);
  whole << size.y, size.rate;
  for (const auto& force : forces_) {
    const Vector response = force.sizes(t + s);
    whole += response;
    const double units = force.resonances.empty() ? 2.0 : 8.0;
    error += unit * (16.0 + units * force.frequency * (t + s)) * response;
    if (!precise) growth += force.defect_per_time;
  }
  growth += defect(whole, precise);
  if (precise) growth.tail(n) += precise_->load_errors;
  const Vector shift = precise ? Vector(Vector::Zero(2 * n)) : this->shift(whole);
  for (Index j = 0; j < n; ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    const double turned = s * std::hypot(mode.omega, 2.0 * mode.sigma);
    const double relative = unit * (4.0 * double(n + 2) + 4.0 * turned);
    error[j] += relative * size.y[j];
    error[n + j] += relative * size.rate[j];
    // Errors that come anywhere in the flight are carried to its end.
    const double y = shift[j] + s * growth[j], rate = shift[n + j] + s * growth[n + j];
    const double energy = std::hypot(rate, mode.omega * y);
    error[n + j] += energy;
    error[j] += std::min(y + s * energy, mode.omega > 0.0 ? energy / mode.omega
                                                          : std::numeric_limits<double>::max());
  }
  return error;
}

// Of a state that is rounded once: the phases omega s, sines and a few products, without the sums of a change to modes.
Vector ForcedModes::rounding_errors(const Vector& z, double t, double s) const {
  const Index n = dof();
  const auto size = sizes(z, s);
  Vector error(2 * n);
  error << size.y, size.rate;
  for (Index j = 0; j < n; ++j) {
    const double relative = epsilon * (8.0 + 4.0 * s * system_.modes()[std::size_t(j)].omega);
    error[j] *= relative;
    error[n + j] *= relative;
  }
  for (const auto& force : forces_) error += 16.0 * epsilon * force.sizes(t + s);
  return error;
}

}  // namespace clackers::exact
