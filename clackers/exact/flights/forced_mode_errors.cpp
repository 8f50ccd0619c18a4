// What rounding, and what the modes leave of the equations, do to a flight.
#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/constants.hpp"
#include "clackers/exact/flights/forced_modes.hpp"

namespace clackers::exact {

using Eigen::Index;
using Matrix = ForcedModes::Matrix;
using Vector = ForcedModes::Vector;

// What the modes leave of the equations of the structure and of their own inverse, and the rounding of
// that.
void ForcedModes::find_residuals() {
  if (square_errors_.size() > 0) return;
  const Index n = dof(), all = mass_.rows();
  const double rounding = 2.0 * double(all) * epsilon;
  Matrix whole(2 * all, 2 * n), whole_size(2 * all, 2 * n);
  whole << derivatives_[0], derivatives_[1];
  whole_size << derivative_sizes_[0], derivative_sizes_[1];
  basis_residual_ = (inverse_ * whole - Matrix::Identity(2 * n, 2 * n)).cwiseAbs() +
                    rounding * inverse_.cwiseAbs() * whole_size;
  const Matrix left =
      mass_ * derivatives_[2] + damping_ * derivatives_[1] + stiffness_ * derivatives_[0];
  const Matrix size = mass_.cwiseAbs() * derivative_sizes_[2] +
                      damping_.cwiseAbs() * derivative_sizes_[1] +
                      stiffness_.cwiseAbs() * derivative_sizes_[0];
  force_residual_ =
      (impulse_response_ * left).cwiseAbs() + rounding * impulse_response_.cwiseAbs() * size;
}

// Without a defect only what rounding does.
Vector ForcedModes::shift(const Vector& whole) const {
  if (square_errors_.size() == 0) return basis_residual_ * whole;
  Vector sums(inverse_.cols());
  sums << derivative_sizes_[0] * whole, derivative_sizes_[1] * whole;
  return 2.0 * double(mass_.rows()) * epsilon * (inverse_.cwiseAbs() * sums);
}

Vector ForcedModes::defect(const Vector& whole) const {
  if (square_errors_.size() == 0) return force_residual_ * whole;
  Vector made = Vector::Zero(whole.size());
  made.tail(dof()) = square_errors_.cwiseProduct(whole.head(dof()));
  return made;
}

double ForcedModes::fourth_bound(const Observable& seen, const Vector& free, double horizon) const {
  double most = bound(seen.by_state.col(4), sizes(free, horizon));
  for (std::size_t j = 0; j < push_.size(); ++j)
    most += std::abs(seen.by_state(Index(j), 3) * push_[j].y) +
            std::abs(seen.by_state(dof() + Index(j), 3) * push_[j].rate);
  for (std::size_t i = 0; i < forces_.size(); ++i)
    most += std::pow(forces_[i].frequency, 4) * std::abs(seen.response[i]);
  return most;
}

double ForcedModes::rounding(const Observable& seen, const Sizes& size, double t) const {
  double whole = seen.constant_size + bound(seen.size, size);
  for (std::size_t i = 0; i < forces_.size(); ++i)
    whole += (1.0 + forces_[i].frequency * t) *
             (seen.direct_size[i] + seen.size.dot(forces_[i].steady.cwiseAbs()));
  return epsilon * double(mass_.rows() + 4) * whole;
}

// The energy of a mode, rate^2 + omega^2 y^2, does not grow where nothing pushes it.
ForcedModes::Sizes ForcedModes::sizes(const Vector& z, double s, double push) const {
  const Index n = dof();
  Sizes size{Vector(n), Vector(n)};
  for (Index j = 0; j < n; ++j) {
    const double omega = system_.modes()[std::size_t(j)].omega;
    size.rate[j] = std::sqrt(z[n + j] * z[n + j] + omega * omega * z[j] * z[j]);
    size.y[j] = std::abs(z[j]) + s * std::abs(z[n + j]);
    if (omega > 0.0) {
      size.y[j] = std::min(size.y[j], size.rate[j] / omega);
    } else if (push > 0.0 && !push_.empty()) {
      const auto& [y, rate] = push_[std::size_t(j)];
      const double added =
          numerics::pushed(system_.modes()[std::size_t(j)], {0.0, std::abs(rate)}, s).rate;
      size.rate[j] += added;
      size.y[j] += s * (std::abs(y) + added);
    }
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
Vector ForcedModes::local_errors(const Vector& z, double t, double s) const {
  const Index n = dof();
  const auto size = sizes(z, s);
  Vector whole(2 * n), error = Vector::Zero(2 * n), growth = Vector::Zero(2 * n);
  whole << size.y, size.rate;
  for (const auto& force : forces_) {
    const Vector response = force.steady.cwiseAbs();
    whole += response;
    error += epsilon * (16.0 + 2.0 * force.frequency * (t + s)) * response;
    growth += force.defect_per_time;
  }
  growth += defect(whole);
  const Vector shift = this->shift(whole);
  for (Index j = 0; j < n; ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    const double turned = s * std::hypot(mode.omega, 2.0 * mode.sigma);
    const double relative = epsilon * (4.0 * double(n + 2) + 4.0 * turned);
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

}  // namespace clackers::exact
