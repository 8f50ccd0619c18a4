// Modes without a defect and what is done with them in double-double.
#include <algorithm>
#include <cmath>

#include "clackers/base/constants.hpp"
#include "clackers/exact/flights/forced_modes.hpp"
#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact {

using Eigen::Index;
using numerics::DoubleDouble;
using Numbers = ForcedModes::Numbers;
using Vector = ForcedModes::Vector;

namespace {

// Of a few operations.
constexpr double precise_rounding = 0x1p-97;

DoubleDouble product_sum(const Vector& a, const Numbers& b) {
  DoubleDouble sum;
  for (Index i = 0; i < a.size(); ++i)
    if (a[i] != 0.0) sum = sum + b[std::size_t(i)] * a[i];
  return sum;
}

Numbers product(const ForcedModes::Sparse& a, const Numbers& x) {
  Numbers y(x.size());
  for (Index j = 0; j < a.outerSize(); ++j)
    for (ForcedModes::Sparse::InnerIterator entry(a, j); entry; ++entry)
      y[std::size_t(entry.row())] = y[std::size_t(entry.row())] + x[std::size_t(j)] * entry.value();
  return y;
}

}  // namespace

void ForcedModes::make_precise(const numerics::TridiagonalModes& modes,
                               const model::HarmonicLoad* load, const Rest& rest) {
  const auto all = std::size_t(mass_.rows());
  const bool is_held = onto_.columns() < mass_.rows();
  const bool is_constant =
      load == nullptr || std::ranges::all_of(load->forces(), [](const auto& force) {
        return force.frequency == 0.0 && force.phase == 0.0;
      });
  if (!is_constant || !onto_.is_signed() || modes.squares.minCoeff() < 0.0 ||
      (is_held && !rest.stiffness.isZero(0.0)))
    return;
  auto& precise = precise_.emplace();
  precise.shapes = onto_.times(modes.shapes_rest);
  precise.square_errors = modes.rest_errors;
  precise.shape_error = modes.shape_error;
  precise.unit = precise_rounding;
  for (Index j = 0; j < dof(); ++j) {
    precise.squares.push_back({modes.squares[j], modes.squares_rest[j]});
    precise.omega.push_back(sqrt(precise.squares.back()));
    precise.half_turns.push_back(precise.omega.back() / numerics::pi);
  }
  // Of |x|^2, what x' M x is at least and at most.
  const Vector sums = Sparse(mass_.cwiseAbs()) * Vector::Ones(mass_.rows());
  precise.least_mass = (2.0 * Vector(mass_.diagonal()) - sums).minCoeff();
  precise.change_error = 2.0 * double(all) * precise.unit * sums.maxCoeff() / precise.least_mass +
                         2.0 * precise.shape_error;

  precise.forces.resize(all);
  if (load != nullptr)
    for (const auto& force : load->forces()) {
      auto& sum = precise.forces[std::size_t(force.dof)];
      sum = sum + DoubleDouble{force.amplitude, 0.0};
    }
  for (std::size_t i = 0; i < all && rest.force.size() > 0; ++i)
    precise.forces[i] = precise.forces[i] + DoubleDouble{rest.force[Index(i)], 0.0};
  Numbers offset(all), applied = precise.forces;
  for (std::size_t i = 0; i < all; ++i) offset[i].hi = offset_[Index(i)];
  const auto of_offset = product(stiffness_, offset);
  double square = 0.0;
  for (std::size_t i = 0; i < all; ++i) {
    applied[i] = applied[i] - of_offset[i];
    square += applied[i].hi * applied[i].hi;
  }
  precise.load_errors =
      Vector::Constant(dof(), precise.shape_error * std::sqrt(square / precise.least_mass));
  for (const auto& force : forces_)
    precise.load_errors += precise.unit / epsilon * force.defect_per_time.tail(dof());
  for (Index j = 0; j < dof(); ++j) {
    DoubleDouble sum;
    for (std::size_t i = 0; i < all; ++i) sum = sum + applied[i] * precise_shape(Index(i), j);
    precise.loads.push_back(sum);
  }
}

Numbers ForcedModes::precise_state(const Numbers& u, const Numbers& v) const {
  Numbers moved = u, z(2 * std::size_t(dof()));
  for (std::size_t i = 0; i < u.size(); ++i)
    moved[i] = moved[i] - DoubleDouble{offset_[Index(i)], 0.0};
  const Numbers of_u = product(mass_, moved), of_v = product(mass_, v);
  for (Index j = 0; j < dof(); ++j) {
    DoubleDouble y, rate;
    const double *hi = system_.shapes().col(j).data(), *lo = precise_->shapes.col(j).data();
    for (std::size_t i = 0; i < u.size(); ++i) {
      const DoubleDouble shape{hi[i], lo[i]};
      y = y + shape * of_u[i];
      rate = rate + shape * of_v[i];
    }
    z[std::size_t(j)] = y;
    z[std::size_t(dof() + j)] = rate;
  }
  return z;
}

std::pair<Numbers, Numbers> ForcedModes::precise_motion(const Numbers& z) const {
  const auto all = std::size_t(mass_.rows());
  Numbers u(all), v(all);
  for (std::size_t i = 0; i < all; ++i) u[i].hi = offset_[Index(i)];
  for (Index j = 0; j < dof(); ++j) {
    const auto &y = z[std::size_t(j)], &rate = z[std::size_t(dof() + j)];
    const double *hi = system_.shapes().col(j).data(), *lo = precise_->shapes.col(j).data();
    for (std::size_t i = 0; i < all; ++i) {
      const DoubleDouble shape{hi[i], lo[i]};
      u[i] = u[i] + shape * y;
      v[i] = v[i] + shape * rate;
    }
  }
  return {std::move(u), std::move(v)};
}

Numbers ForcedModes::precise_advanced(const Numbers& z, const DoubleDouble& s) const {
  const auto n = std::size_t(dof());
  Numbers later(2 * n);
  for (std::size_t j = 0; j < n; ++j) {
    const auto &y = z[j], &rate = z[n + j], &omega = precise_->omega[j], &load = precise_->loads[j];
    if (omega.hi == 0.0) {
      later[j] = y + s * (rate + load * s * 0.5);
      later[n + j] = rate + load * s;
      continue;
    }
    const auto [sine, cosine] = numerics::precise_sincospi(precise_->half_turns[j] * s);
    const auto rest = load / precise_->squares[j], from = y - rest;
    later[j] = rest + from * cosine + rate / omega * sine;
    later[n + j] = rate * cosine - omega * from * sine;
  }
  return later;
}

void ForcedModes::observe_precisely(const Vector& on_u, const Vector& on_a, const Vector& on_load,
                                    double constant, Observable& seen) const {
  const auto n = std::size_t(dof());
  Numbers offset(std::size_t(mass_.rows()));
  for (std::size_t i = 0; i < offset.size(); ++i) offset[i].hi = offset_[Index(i)];
  seen.precise_constant = DoubleDouble{constant, 0.0} + product_sum(on_u, offset) +
                          product_sum(on_load, precise_->forces);
  seen.precise_errors.resize(Index(n));
  const double sums = double(mass_.rows() + 4) * precise_->unit,
               of_u = precise_->shape_error * on_u.norm() / std::sqrt(precise_->least_mass),
               of_a = precise_->shape_error * on_a.norm() / std::sqrt(precise_->least_mass);
  seen.precise_constant_error = sums * (seen.constant_size + std::abs(seen.precise_constant.hi));
  for (std::size_t j = 0; j < n; ++j) {
    DoubleDouble u, a;
    for (Index i = 0; i < on_u.size(); ++i) {
      if (on_u[i] != 0.0) u = u + precise_shape(i, Index(j)) * on_u[i];
      if (on_a[i] != 0.0) a = a + precise_shape(i, Index(j)) * on_a[i];
    }
    seen.precise.push_back(u - precise_->squares[j] * a);
    const auto& load = precise_->loads[j];
    seen.precise_constant = seen.precise_constant + a * load;
    seen.precise_constant_error += std::abs(a.hi) * precise_->load_errors[Index(j)] +
                                   (of_a + sums * std::abs(a.hi)) * std::abs(load.hi);
    seen.precise_errors[Index(j)] =
        sums * seen.size[Index(j)] + of_u + precise_->squares[j].hi * of_a;
  }
}

DoubleDouble ForcedModes::dot(const Numbers& row, const Numbers& z, std::size_t first) {
  DoubleDouble sum;
  for (std::size_t j = 0; j < row.size(); ++j) sum = sum + row[j] * z[first + j];
  return sum;
}

}  // namespace clackers::exact
