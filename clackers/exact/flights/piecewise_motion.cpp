// A piecewise motion as a reference solution: states, envelopes, bounds.
#include "clackers/exact/flights/piecewise_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/base/constants.hpp"
#include "clackers/exact/flights/simultaneity.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Kinematics;
using model::Side;

VectorXd PiecewiseMotion::total(const Flight& flight, double t) const {
  return modes(flight).steady(t) + modes(flight).advanced(flight.free, t - flight.t);
}

std::size_t PiecewiseMotion::flight_at(double t, Side side) const {
  model::require_inside(who_, t, end_);
  const auto after = side == Side::right ? std::ranges::upper_bound(flights_, t, {}, &Flight::t)
                                         : std::ranges::lower_bound(flights_, t, {}, &Flight::t);
  return after == flights_.begin() ? 0 : std::size_t(after - flights_.begin()) - 1;
}

auto PiecewiseMotion::event(std::size_t flight) const -> std::optional<Event> {
  const auto& ends = flights_[flight].ends;
  if (!ends) return std::nullopt;
  const auto first = ends->contacts.front();
  for (const auto other : ends->contacts)
    if (other != first && is_held(flight, other) == is_held(flight, first) &&
        !close_together(problem_, first, other))
      return std::nullopt;
  return ends;
}

bool PiecewiseMotion::is_held(std::size_t flight, std::size_t contact) const {
  return contact < problem_.contacts.size() && forces_[flights_[flight].regime][contact];
}

bool PiecewiseMotion::may_end(std::size_t flight, double t) const {
  const auto& ends = flights_[flight].ends;
  if (!ends || !(ends->when.lo <= t && t <= ends->when.hi)) return false;
  const auto i = ends->contacts.front();
  return t != flights_[flight + 1].t || i >= problem_.contacts.size() || is_held(flight, i);
}

Kinematics PiecewiseMotion::in_flight(const Flight& flight, double t) const {
  const auto& modes = this->modes(flight);
  const VectorXd now = total(flight, t);
  return {modes.displacement(now), modes.velocity(now), modes.acceleration(now, t)};
}

bool PiecewiseMotion::is_resolved(std::size_t flight) const {
  return std::ranges::none_of(
      unresolved_, [&](const auto& skipped) { return skipped.from <= flights_[flight].t; });
}

std::vector<std::size_t> PiecewiseMotion::held_in(std::size_t regime) const {
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < problem_.contacts.size(); ++i)
    if (forces_[regime][i]) held.push_back(i);
  return held;
}

void PiecewiseMotion::sample(std::span<const double> times, Side side,
                             model::SampleBuffers out) const {
  constexpr std::size_t most_times = 32;
  const auto n = std::size_t(dof());
  model::require_buffers(who_, out, times.size(), n);
  const Flight* before = nullptr;
  std::vector<numerics::ModalState> states;
  MatrixXd now;  // of times of one flight
  for (std::size_t i = 0, count = 1; i < times.size(); i += count, count = 1) {
    const auto& flight = flights_[flight_at(times[i], side)];
    const auto& modes = this->modes(flight);
    // Fits sample thousands of motions.
    if (!has_bounds_ && out.a.empty() && modes.forces().empty() && modes.dof() == dof()) {
      if (std::exchange(before, &flight) != &flight) states = ForcedModes::states(flight.free);
      modes.system().sample(states, times[i] - flight.t, out.u.subspan(i * n, n),
                            out.v.subspan(i * n, n));
      continue;
    }
    while (count < most_times && i + count < times.size() &&
           &flights_[flight_at(times[i + count], side)] == &flight)
      ++count;
    now.resize(2 * modes.dof(), Index(count));
    for (std::size_t k = 0; k < count; ++k) now.col(Index(k)) = total(flight, times[i + k]);
    const auto at = [&](std::span<double> to) {
      return Eigen::Map<MatrixXd>(to.data() + i * n, dof(), Index(count));
    };
    at(out.u) = modes.derived_states(0, now).colwise() + modes.offset();
    at(out.v) = modes.derived_states(1, now);
    for (std::size_t k = 0; !out.a.empty() && k < count; ++k)
      Eigen::Map<VectorXd>(out.a.data() + (i + k) * n, dof()) =
          modes.acceleration(now.col(Index(k)), times[i + k]);
  }
  // The start is given, not the sum of its modes.
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] != flights_.front().t || flight_at(times[i], side) != 0) continue;
    std::ranges::copy(problem_.start.u, out.u.begin() + std::ptrdiff_t(i * n));
    std::ranges::copy(problem_.start.v, out.v.begin() + std::ptrdiff_t(i * n));
  }
}

FlightErrors PiecewiseMotion::errors_after(const Flight& flight, double s) const {
  if (!has_bounds_) return {};
  auto errors = flight.errors;
  errors.carry(modes(flight), s);
  errors.add(modes(flight),
             modes(flight).local_errors(flight.free, flight.t, s, flight.is_precise));
  return errors;
}

VectorXd PiecewiseMotion::local_errors(const Flight& flight, double s) const {
  const auto& modes = this->modes(flight);
  VectorXd errors = modes.local_errors(flight.free, flight.t, s, flight.is_precise);
  if (flight.is_precise) errors += modes.rounding_errors(flight.free, flight.t, s);
  return errors;
}

namespace {

// The rows by which u^(order) is seen in a state, some at a time: all of a fine mesh take gigabytes.
void for_rows(const ForcedModes& modes, int order, auto&& function) {
  constexpr Index most = 256;
  const auto all = modes.system().dof();
  for (Index first = 0; first < all; first += most)
    function(first, modes.system().derivative(order, first, std::min(most, all - first)));
}

}  // namespace

Kinematics PiecewiseMotion::error_bound(double t) const {
  const Index n = dof();
  const VectorXd least = VectorXd::Constant(n, has_bounds_ ? 0.0 : infinity);
  Kinematics bound{least, least, least}, apart = bound, late = bound;
  if (!has_bounds_) return bound;
  auto k = flight_at(t, Side::left), last = flight_at(t, Side::right);
  if (k > 0 && may_end(k - 1, t)) --k;
  if (last + 1 < flights_.size() && may_end(last, t)) ++last;
  for (; k <= last; ++k) {
    const auto& flight = flights_[k];
    const auto& modes = this->modes(flight);
    const double s = std::max(0.0, t - flight.t);
    const VectorXd local = local_errors(flight, s);
    // What is summed, for the rounding of the sum.
    const auto size = modes.sizes(flight.free, s);
    VectorXd whole(2 * modes.dof()), load = VectorXd::Zero(n);
    whole << size.y, size.rate;
    for (const auto& force : modes.forces()) {
      whole += force.sizes(t);
      load += (2.0 + force.frequency * t) * force.acceleration.cwiseAbs();
    }
    const auto raise = [&](VectorXd& to, int order, const VectorXd& more) {
      VectorXd rounding = epsilon * double(n + 4) * (modes.derived_sizes(order, whole) + more);
      if (order == 2) rounding += modes.acceleration_defect(whole);
      for_rows(modes, order, [&](Index first, const MatrixXd& rows) {
        auto some = to.segment(first, rows.rows());
        some = some.cwiseMax(flight.errors.bounds(modes, rows, s) + rows.cwiseAbs() * local +
                             rounding.segment(first, rows.rows()));
      });
    };
    raise(bound.u, 0, modes.offset().cwiseAbs());
    raise(bound.v, 1, VectorXd::Zero(n));
    raise(bound.a, 2, load);
    if (k == last || !may_end(k, t)) continue;
    const auto now = in_flight(flight, t), next = in_flight(flights_[k + 1], t);
    late.u += (next.u - now.u).cwiseAbs();
    late.v += (next.v - now.v).cwiseAbs();
    late.a += (next.a - now.a).cwiseAbs();
  }
  for (const auto& skipped : unresolved_) {
    if (t < skipped.from || t > skipped.until) continue;
    const double share =
        skipped.scale > 0.0 ? std::min(1.0, std::max(0.0, skipped.rest - t) / skipped.scale) : 1.0;
    apart.u = apart.u.cwiseMax(share * share * skipped.bound.u);
    apart.v = apart.v.cwiseMax(share * skipped.bound.v);
    apart.a = apart.a.cwiseMax(skipped.bound.a);
  }
  bound.u += apart.u + late.u;
  bound.v += apart.v + late.v;
  bound.a += apart.a + late.a;
  return bound;
}

Kinematics PiecewiseMotion::envelope(double t) const {
  const auto& flight = flights_[flight_at(t, Side::left)];
  const auto& modes = this->modes(flight);
  auto size = modes.sizes(modes.advanced(flight.free, t - flight.t), 0.0);
  // Of a mode that turns by a radian at most up to the end the present displacement.
  for (Index j = 0; j < modes.dof(); ++j)
    if (const double omega = modes.system().modes()[std::size_t(j)].omega; omega * end_ > 1.0)
      size.y[j] = size.rate[j] / omega;
  const auto of = [&](int order) {
    VectorXd most = (order == 0 ? 1.0 : 0.0) * modes.offset().cwiseAbs();
    for_rows(modes, order, [&](Index first, const MatrixXd& rows) {
      for (Index i = 0; i < rows.rows(); ++i)
        most[first + i] += modes.bound(rows.row(i).transpose(), size);
    });
    return VectorXd(most + modes.steady_sizes(order, t));
  };
  return {of(0), of(1), of(2)};
}

VectorXd PiecewiseMotion::contact_forces(double t, Side side) const {
  const auto& flight = flights_[flight_at(t, side)];
  const auto& forces = forces_[flight.regime];
  VectorXd values = VectorXd::Zero(Index(forces.size()));
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (forces[i])
      values[Index(i)] =
          modes(flight).now(*forces[i], modes(flight).advanced(flight.free, t - flight.t), t).value;
  return values;
}

long long PiecewiseMotion::impact_count(double t) const {
  flight_at(t, Side::left);  // refuses a time outside
  return std::ranges::upper_bound(hits_, t, {}, &Hit::t) - hits_.begin();
}

model::MotionImpact PiecewiseMotion::impact(long long index) const {
  model::require_impact(who_, index, std::ssize(hits_), end_);
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
    return 0.5 * (k.v.dot(regimes_[0].mass() * k.v) + k.u.dot(regimes_[0].stiffness() * k.u));
  };
  impact.energy_before = energy(impact.before);
  impact.energy_after = energy(impact.after);
  return impact;
}

}  // namespace clackers::exact
