// A piecewise motion as a reference solution: states, envelopes, bounds.
#include "clackers/exact/event_driven/piecewise_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Kinematics;
using model::Side;
using numerics::ModalState;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

PiecewiseMotion::Modal PiecewiseMotion::steady(double t) const {
  Modal sum(system_.modes().size());
  for (const auto& force : forces_) {
    const auto turn = std::polar(1.0, force.frequency * t);
    for (std::size_t j = 0; j < sum.size(); ++j) {
      const auto y = force.steady[Index(j)] * turn;
      sum[j].y += y.real();
      sum[j].rate -= force.frequency * y.imag();
    }
  }
  return sum;
}

PiecewiseMotion::Modal PiecewiseMotion::total(const Flight& flight, double t) const {
  auto sum = steady(t);
  for (std::size_t j = 0; j < sum.size(); ++j) {
    const auto free = numerics::advance(system_.modes()[j], flight.free[j], t - flight.t);
    sum[j].y += free.y;
    sum[j].rate += free.rate;
  }
  return sum;
}

VectorXd PiecewiseMotion::acceleration(const Modal& state, double t) const {
  VectorXd a(dof());
  for (Index j = 0; j < dof(); ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    const auto& now = state[std::size_t(j)];
    a[j] = -2.0 * mode.sigma * now.rate - mode.omega_square * now.y;
  }
  for (const auto& force : forces_)
    a += (force.modal * std::polar(1.0, force.frequency * t)).real();
  return a;
}

std::size_t PiecewiseMotion::flight_at(double t, Side side) const {
  model::require_inside(who_, t, end_);
  const auto after = side == Side::right ? std::ranges::upper_bound(flights_, t, {}, &Flight::t)
                                         : std::ranges::lower_bound(flights_, t, {}, &Flight::t);
  return after == flights_.begin() ? 0 : std::size_t(after - flights_.begin()) - 1;
}

void PiecewiseMotion::sample(std::span<const double> times, Side side,
                             model::SampleBuffers out) const {
  const auto n = std::size_t(dof());
  model::require_buffers(who_, out, times.size(), n);
  VectorXd y(dof()), rate(dof());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto now = total(flights_[flight_at(times[i], side)], times[i]);
    for (Index j = 0; j < dof(); ++j) {
      y[j] = now[std::size_t(j)].y;
      rate[j] = now[std::size_t(j)].rate;
    }
    const auto put = [&](std::span<double> to, const VectorXd& modal) {
      Eigen::Map<VectorXd>(to.data() + i * n, dof()).noalias() = system_.shapes() * modal;
    };
    put(out.u, y);
    put(out.v, rate);
    if (!out.a.empty()) put(out.a, acceleration(now, times[i]));
  }
}

// The energy of a mode, rate^2 + omega^2 y^2, does not grow.
PiecewiseMotion::Sizes PiecewiseMotion::sizes(const Flight& flight, double s) const {
  Sizes size{VectorXd(dof()), VectorXd(dof())};
  for (Index j = 0; j < dof(); ++j) {
    const double omega = system_.modes()[std::size_t(j)].omega;
    const auto& start = flight.free[std::size_t(j)];
    size.rate[j] = std::hypot(start.rate, omega * start.y);
    size.y[j] = std::abs(start.y) + s * std::abs(start.rate);
    if (omega > 0.0) size.y[j] = std::min(size.y[j], size.rate[j] / omega);
  }
  return size;
}

// What rounding does to the modes in s seconds: the sums and products of a flight and of a change to
// modes and back; frequencies, whose relative error of 4 epsilon turns a mode by omega s as much; the
// phase of the forces; and the residuals of the mode shapes, which act as forces do.
PiecewiseMotion::Sizes PiecewiseMotion::local_errors(const Flight& flight, double s) const {
  auto size = sizes(flight, s);
  VectorXd steady_y = VectorXd::Zero(dof()), steady_rate = steady_y;
  Sizes error{steady_y, steady_y};
  for (const auto& force : forces_) {
    const VectorXd y = force.steady.cwiseAbs();
    const double relative = epsilon * (16.0 + 2.0 * force.frequency * (flight.t + s));
    steady_y += y;
    steady_rate += force.frequency * y;
    error.y += relative * y;
    error.rate += relative * force.frequency * y;
  }
  for (Index j = 0; j < dof(); ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    const double turned = s * std::hypot(mode.omega, 2.0 * mode.sigma);
    const double relative = epsilon * (4.0 * double(dof() + 2) + 4.0 * turned);
    error.y[j] += relative * size.y[j];
    error.rate[j] += relative * size.rate[j];
  }
  size.y += steady_y;
  size.rate += steady_rate;
  VectorXd inertia(dof());
  for (Index j = 0; j < dof(); ++j)
    inertia[j] = system_.modes()[std::size_t(j)].omega_square * size.y[j];
  const VectorXd force =
      stiffness_residual_ * size.y + damping_residual_ * size.rate + mass_residual_ * inertia;
  error.y += mass_residual_ * size.y;
  error.rate += mass_residual_ * size.rate + s * force;
  for (Index j = 0; j < dof(); ++j) {
    const double omega = system_.modes()[std::size_t(j)].omega;
    error.y[j] += s * force[j] * (omega > 0.0 ? std::min(s, 1.0 / omega) : s);
  }
  return error;
}

// Each mode maps its own errors, (y, rate) interleaved.
MatrixXd PiecewiseMotion::covariance_after(const Flight& flight, double s) const {
  const Index n = dof();
  MatrixXd left(2 * n, 2 * n), both(2 * n, 2 * n);
  std::vector<Eigen::Matrix2d> maps;
  for (const auto& mode : system_.modes()) {
    const auto one = numerics::advance(mode, {1.0, 0.0}, s);
    const auto two = numerics::advance(mode, {0.0, 1.0}, s);
    maps.push_back((Eigen::Matrix2d() << one.y, two.y, one.rate, two.rate).finished());
  }
  for (Index j = 0; j < n; ++j)
    left.middleRows(2 * j, 2).noalias() =
        maps[std::size_t(j)] * flight.covariance.middleRows(2 * j, 2);
  for (Index j = 0; j < n; ++j)
    both.middleCols(2 * j, 2).noalias() =
        left.middleCols(2 * j, 2) * maps[std::size_t(j)].transpose();
  const auto error = local_errors(flight, s);
  for (Index j = 0; j < n; ++j) {
    both(2 * j, 2 * j) += error.y[j] * error.y[j];
    both(2 * j + 1, 2 * j + 1) += error.rate[j] * error.rate[j];
  }
  return both;
}

// With K flights of 2 n errors d_k each, twice a flight (its end, its impact), Cauchy and Schwarz
// give |row . sum F_k d_k| <= sqrt(4 n K) sqrt(sum row F_k D_k D_k' F_k' row').
double PiecewiseMotion::factor(std::size_t flight) const {
  return std::sqrt(4.0 * double(dof()) * double(flight + 1));
}

Kinematics PiecewiseMotion::error_bound(double t) const {
  const Index n = dof();
  Kinematics bound{VectorXd::Zero(n), VectorXd::Zero(n), VectorXd::Zero(n)};
  const auto last = flight_at(t, Side::right);
  for (auto k = flight_at(t, Side::left); k <= last; ++k) {
    const auto& flight = flights_[k];
    const MatrixXd covariance = covariance_after(flight, t - flight.t);
    const auto size = sizes(flight, t - flight.t);
    MatrixXd row = MatrixXd::Zero(1, 2 * n);
    const auto error = [&](const MatrixXd& x) {
      return factor(k) * std::sqrt((x * covariance * x.transpose())(0, 0));
    };
    for (Index i = 0; i < n; ++i) {
      double u = 0.0, v = 0.0, a = 0.0;  // what is summed, for the rounding of the sum
      MatrixXd of_u = row, of_v = row, of_a = row;
      for (Index j = 0; j < n; ++j) {
        const auto& mode = system_.modes()[std::size_t(j)];
        const double shape = system_.shapes()(i, j);
        of_u(0, 2 * j) = of_v(0, 2 * j + 1) = shape;
        of_a(0, 2 * j) = -shape * mode.omega_square;
        of_a(0, 2 * j + 1) = -2.0 * shape * mode.sigma;
        double y = size.y[j], rate = size.rate[j], force = 0.0;
        for (const auto& f : forces_) {
          y += std::abs(f.steady[j]);
          rate += f.frequency * std::abs(f.steady[j]);
          force += (2.0 + f.frequency * t) * std::abs(f.modal[j]);
        }
        u += std::abs(shape) * y;
        v += std::abs(shape) * rate;
        a += std::abs(shape) * (mode.omega_square * y + 2.0 * std::abs(mode.sigma) * rate + force);
      }
      const double rounding = epsilon * double(n + 4);
      bound.u[i] = std::max(bound.u[i], error(of_u) + rounding * u);
      bound.v[i] = std::max(bound.v[i], error(of_v) + rounding * v);
      bound.a[i] = std::max(bound.a[i], error(of_a) + rounding * a);
    }
  }
  return bound;
}

Kinematics PiecewiseMotion::envelope(double t) const {
  const auto& flight = flights_[flight_at(t, Side::left)];
  Flight now{t, {}, {}};
  for (std::size_t j = 0; j < flight.free.size(); ++j)
    now.free.push_back(numerics::advance(system_.modes()[j], flight.free[j], t - flight.t));
  auto size = sizes(now, 0.0);
  VectorXd a(dof());
  for (Index j = 0; j < dof(); ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    // Of a mode without stiffness the present displacement.
    if (mode.omega > 0.0) size.y[j] = size.rate[j] / mode.omega;
    a[j] = mode.omega > 0.0 ? mode.omega * size.rate[j] : 2.0 * std::abs(mode.sigma) * size.rate[j];
  }
  for (const auto& force : forces_) {
    const VectorXd y = force.steady.cwiseAbs();
    size.y += y;
    size.rate += force.frequency * y;
    a += force.frequency * force.frequency * y;
  }
  const MatrixXd shapes = system_.shapes().cwiseAbs();
  return {shapes * size.y, shapes * size.rate, shapes * a};
}

long long PiecewiseMotion::impact_count(double t) const {
  flight_at(t, Side::left);  // refuses a time outside
  return std::ranges::upper_bound(hits_, t, {}, &Hit::t) - hits_.begin();
}

model::MotionImpact PiecewiseMotion::impact(long long index) const {
  const auto count = std::ssize(hits_);
  if (index < 1 || index > count)
    throw InputError(
        fmt::format("{}: impact {} was asked for; allowed: {}.", who_, index,
                    count == 0 ? std::string("none, since nothing collides up to the end")
                               : fmt::format("1 to {}", count)),
        "beyond-last-impact");
  const auto& hit = hits_[std::size_t(index - 1)];
  model::MotionImpact impact;
  impact.index = index;
  impact.t = hit.t;
  impact.when = {hit.t - hit.time_error, hit.t + hit.time_error};
  impact.contact = hit.contact;
  impact.before = at(hit.t, Side::left);
  impact.after = at(hit.t, Side::right);
  impact.impulse = hit.impulse;
  const auto energy = [&](const Kinematics& k) {
    return 0.5 * (k.v.dot(mass_ * k.v) + k.u.dot(stiffness_ * k.u));
  };
  impact.energy_before = energy(impact.before);
  impact.energy_after = energy(impact.after);
  return impact;
}

}  // namespace clackers::exact
