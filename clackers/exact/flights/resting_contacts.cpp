// Contacts that stay closed: how that begins, and how it ends.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/flights/first_crossing.hpp"
#include "clackers/exact/flights/idle_contacts.hpp"
#include "clackers/exact/flights/piecewise_builder.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::size_t PiecewiseMotion::Builder::resting(const State& state,
                                              const std::vector<std::size_t>& contacts) {
  if (contacts.empty()) return state.regime;
  const auto& rows = rows_[state.regime];
  const VectorXd a = m_.regimes_[state.regime].acceleration(state.z, state.t);
  VectorXd q = VectorXd::Zero(Index(springs()));
  for (const auto i : contacts) q[Index(i)] = problem_.contacts[i].direction.dot(a);
  const auto forces = solve(state.regime, q, contacts, state.t);
  std::vector<std::size_t> pressed, unclear;
  for (const auto i : contacts) {
    double opening = q[Index(i)];
    for (const auto j : contacts) opening += delassus(state.regime, i, j) * forces[Index(j)];
    const double error = certain_depth * deviation(state, rows[i].seen.by_state.col(2));
    if (forces[Index(i)] * delassus(state.regime, i, i) > error)
      pressed.push_back(i);
    else if (opening > error)
      opens_[i] = Begin::by_acceleration;
    else
      unclear.push_back(i);
  }
  if (unclear.empty()) return with_held(state.regime, pressed, true);
  // A contact that never needs a force.
  const auto all = with_held(with_held(state.regime, pressed, true), unclear, true);
  for (const auto i : unclear)
    if (m_.forces_[all][i]->vanishes()) pressed.push_back(i);
  std::erase_if(unclear, [&](std::size_t i) { return m_.forces_[all][i]->vanishes(); });
  const auto sure = with_held(state.regime, pressed, true);
  return unclear.empty() ? sure : resting_by_jerk(seen_in(sure, state), unclear);
}

std::size_t PiecewiseMotion::Builder::resting_by_jerk(const State& state,
                                                      const std::vector<std::size_t>& contacts) {
  const auto& modes = m_.regimes_[state.regime];
  const VectorXd free = state.z - modes.steady(state.t);
  VectorXd q = VectorXd::Zero(Index(springs()));
  for (const auto i : contacts)
    q[Index(i)] = modes.now(rows_[state.regime][i].seen, free, state.t).third;
  const auto rates = solve(state.regime, q, contacts, state.t);
  std::vector<std::size_t> pressed, unclear;
  for (const auto i : contacts) {
    double opening = q[Index(i)];
    for (const auto j : contacts) opening += delassus(state.regime, i, j) * rates[Index(j)];
    const double error =
        certain_depth * deviation(state, rows_[state.regime][i].seen.by_state.col(3));
    if (rates[Index(i)] * delassus(state.regime, i, i) > error)
      pressed.push_back(i);
    else if (opening > error)
      opens_[i] = Begin::by_jerk;
    else
      unclear.push_back(i);
  }
  const auto sure = with_held(state.regime, pressed, true);
  return unclear.empty() ? sure : resting_idle(seen_in(sure, state), unclear);
}

std::size_t PiecewiseMotion::Builder::resting_idle(const State& state,
                                                   const std::vector<std::size_t>& contacts) {
  const auto all = with_held(state.regime, contacts, true);
  const bool is_start = m_.hits_.empty() && state.t == problem_.start.t;
  for (const auto i : contacts) {
    if (!m_.forces_[all][i]->vanishes() &&
        !(is_start && is_idle_from_start(problem_, closed_[all], i)))
      throw InputError(
          fmt::format("{}: contact {} is closed at t = {:.9g} s without a speed, a force or a rate "
                      "of it that the error lets be seen; allowed: motions in which it is certain "
                      "whether a contact opens. Start with the contact open, or end the run "
                      "earlier.",
                      m_.who_, i + 1, state.t),
          "not-admissible");
    opens_[i] = Begin::idle;
  }
  return all;
}

// A later or earlier release by time_error changes the gap rate by a term of second order.
void PiecewiseMotion::Builder::release(std::vector<Closing> closings) {
  const State held = arrived(closings);
  const double s = closings.front().s, t = held.t;
  std::vector<std::size_t> contacts;
  for (const auto& closing : closings) contacts.push_back(closing.contact);
  const double late = closings.front().time_error;
  m_.flights_.back().ends = Event{{t - late, t + late}, contacts};
  auto open = seen_in(with_held(held.regime, contacts, false), held);
  const auto next = resting_by_jerk(open, contacts);
  for (const auto& closing : closings) {
    if (closed_[next][closing.contact] && contacts.size() == 1)
      refuse_graze(closing.contact, t, 0.0, closing.gap_error);
    const auto& row = rows_[open.regime][closing.contact];
    const double jerk = std::abs(watch(closing.contact, s).slope);
    if (m_.has_bounds_)
      open.errors.add_columns(0.5 * jerk * std::pow(closing.time_error, 2) * row.impulse);
  }
  begin(seen_in(next, open));
}

bool PiecewiseMotion::Builder::come_to_rest(std::size_t i, double level, bool is_resolved) {
  const double eta = problem_.contacts[i].restitution, t = flight().t;
  const auto gap = watch(i, 0.0);
  const double fall = -gap.second;
  if (departs() || !(eta < 1.0 && gap.slope > 0.0 && fall > 0.0)) return false;
  if (is_resolved && gap.slope * gap.slope > 600.0 * fall * level) return false;
  const auto base = flight().regime, next = with_held(base, {i}, true);
  const State now = here();
  auto held = seen_in(next, now);
  const auto& modes = m_.regimes_[next];
  const double w = delassus(base, i, i);
  const auto force = modes.now(*m_.forces_[next][i], held.z - modes.steady(t), t);
  const double uncertain = deviation(now, row(i).rate()), speed = gap.slope + uncertain;
  double least = 0.9 * std::min(fall, w * force.value);
  double most = 1.1 * std::max(fall, w * force.value);
  no_rest_ = "the force that closes the contact is small or changes fast";
  if (!(least > 0.0)) return false;
  // The impacts change what the modes add up to by their speeds at most.
  const double bumps = 2.0 * speed / ((1.0 - eta) * w);
  const double third =
      gap.third_bound + this->modes().bound(row(i).seen.by_state.col(3),
                                            this->modes().sizes(bumps * row(i).impulse, 0.0, 0.0));
  double beta = 0.0, seconds = 0.0;
  const auto lasts = [&] {
    beta = third * speed / (least * least);
    const double ratio = eta * (1.0 + 4.8 * beta);
    if (!(beta <= 0.2 && ratio < 1.0)) return false;
    seconds = 2.0 * speed * (1.0 + beta) / (least * (1.0 - ratio));
    return true;
  };
  if (!lasts()) return false;
  const double change = w * seconds * (std::abs(force.slope) + 0.5 * seconds * force.curvature);
  if (!(w * force.value - change >= least && w * force.value + change <= most)) return false;
  least = std::min(fall, w * force.value) - change;
  most = std::max(fall, w * force.value) + change;
  lasts();
  no_rest_ = "another contact may close or open before";
  const double height = 0.5 * speed * speed / least * (1.0 + beta);
  auto skipped = left_out({i, seconds, height, speed * (1.0 + 4.8 * beta), most}, now, held);
  if (!skipped) return false;
  constexpr double most_skipped = 1e-3;
  if (m_.has_bounds_ && speed > most_skipped * fastest_)
    throw InputError(
        fmt::format(
            "{}: impacts of contact {} accumulate, and from t = {:.9g} s on their height of {:.3g} m is too "
            "close to its error of {:.3g} m for them to be followed; allowed: impacts that are followed down to "
            "{:g} of the largest speed. End the run earlier.",
            m_.who_, i + 1, t, height, level, most_skipped),
        "not-admissible");

  // The sum of the flights to second order in the speed; docs/manual/explanation/derivations.
  const VectorXd response = this->modes().velocity(row(i).impulse) / w;
  const double alpha = w * force.value, jerk = -w * force.slope,
               drag = row(i).rate().dot(this->modes().impulse(this->modes().damping() * response));
  const double rho = 2.0 / 3.0 * (jerk + drag * alpha) / (alpha * alpha),
               kappa = (2.0 * rho - 2.0 * drag / alpha) / alpha;
  const double v = gap.slope, once = 1.0 - eta, twice = 1.0 - eta * eta;
  const double sum = 2.0 * v / (alpha * once) +
                     v * v *
                         (kappa / twice + 2.0 / alpha * (2.0 * jerk / (alpha * alpha) - rho) * eta /
                                              (once * twice));
  double time_error = 4.0 * epsilon * t;
  std::erase_if(m_.hits_, [&](const Hit& hit) {
    const bool is_first = hit.t == t && hit.contact == int(i);
    if (is_first) time_error += hit.time_error;
    return is_first;
  });
  const double shortest = std::max(0.0, 2.0 * (gap.slope - uncertain) * (1.0 - beta) /
                                            (most * (1.0 - eta * (1.0 - 4.8 * beta))));
  skipped->rest = t + seconds + time_error;
  // A flight with the speed V is followed by others for V 2 eta/most at least.
  skipped->scale = 2.0 * speed * eta * (1.0 - beta) * (1.0 - 4.8 * beta) / most;
  m_.flights_.pop_back();
  opens_ = begins_;
  m_.unresolved_.push_back(std::move(*skipped));
  begin(std::move(held));
  m_.closed_.back() = {int(i),  std::min(t + sum, m_.end_),
                       m_.end_, {t + shortest - time_error, skipped->rest},
                       false,   true,
                       t};
  return true;
}

auto PiecewiseMotion::Builder::left_out(const Bounce& bounce, const State& free, State& held) const
    -> std::optional<Unresolved> {
  const auto [contact, seconds, gap, rate, acceleration, drift] = bounce;
  const auto &before = m_.regimes_[free.regime], &after = m_.regimes_[held.regime];
  const auto& row = rows_[free.regime][contact];
  const VectorXd response = before.velocity(row.impulse) / row.rate().dot(row.impulse);
  const VectorXd of_damping = after.impulse(before.damping() * response),
                 of_stiffness = after.impulse(before.stiffness() * response);
  const auto accelerated = [&](const VectorXd& force) {
    return VectorXd(after.velocity(after.impulse(force)).cwiseAbs());
  };
  const VectorXd slowing = after.velocity(of_damping);
  // What slows a mass slows its neighbours.
  const VectorXd pulling =
      accelerated(before.stiffness() * response) + 2.0 * accelerated(after.damping() * slowing);
  // 2 % for what is of higher order.
  Unresolved skipped{
      contact,
      held.t,
      held.t + seconds,
      {1.02 * gap * (response.cwiseAbs() + 2.0 * seconds * slowing.cwiseAbs()),
       1.02 * rate * response.cwiseAbs() + 2.0 * gap * slowing.cwiseAbs(),
       1.02 * (acceleration * response.cwiseAbs() + rate * slowing.cwiseAbs() + gap * pulling)}};
  // What the other contacts may do while this one is not where it is held.
  const VectorXd z = held.z - after.steady(held.t), z_free = free.z - before.steady(held.t);
  const auto size = after.sizes(z, 0.0);
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    if (j == contact || part_[j] != part_[contact]) continue;
    const bool is_held = j < springs() && closed_[held.regime][j];
    const auto& seen = is_held ? *m_.forces_[held.regime][j] : rows_[held.regime][j].seen;
    if (is_held && seen.vanishes()) continue;
    const auto ahead = after.now(seen, z, held.t);
    const double sign = j >= springs() && closed_[held.regime][j] ? -1.0 : 1.0;
    const double lost = seconds * (std::abs(ahead.slope) + 0.5 * seconds * ahead.curvature);
    double error =
        certain_gap * (deviation(held, seen.by_state.col(0)) + after.rounding(seen, size, held.t));
    if (!is_held) error += gap * std::abs(contacts_[j].direction.dot(response));
    if (!(sign * ahead.value - lost > error)) return std::nullopt;
    // Between its impacts the contact leaves a held one the force of the flights, unless that needs none.
    if (is_held && !m_.forces_[free.regime][j]->vanishes() &&
        !(before.now(*m_.forces_[free.regime][j], z_free, held.t).value - 2.0 * lost > error))
      return std::nullopt;
  }
  const VectorXd momentum = gap * seconds * of_stiffness + drift * of_damping;
  const VectorXd displacement =
      2.0 * gap * seconds * after.change(slowing, VectorXd::Zero(m_.dof()));
  // The neighbours are braked themselves while they are slowed.
  const VectorXd braking = 2.0 * gap * seconds * after.impulse(after.damping() * slowing);
  if (m_.has_bounds_)
    for (const auto& error : {momentum, displacement, braking}) held.errors.add_columns(error);
  return skipped;
}

// With the acceleration a and the rate -j of it, within a tenth, the gap of a contact that closes opens
// again by less than a^3/j^2 and is closed for good within 4 a/j, as long as a > 0; from a gap g the first
// closing comes within that and (12 g/j)^(1/3).
void PiecewiseMotion::Builder::land(const Closing& closing) {
  const auto i = closing.contact;
  const double s = closing.s;
  const State now = arrived(s);
  const double t = now.t;
  auto held = seen_in(with_held(now.regime, {i}, true), now);
  const auto gap = watch(i, s);
  const double level = std::abs(gap.value) + certain_gap * closing.gap_error;
  const double opening = std::max(gap.second, 0.0) + deviation(now, row(i).seen.by_state.col(2));
  const double fall = -gap.third;
  const double fourth =
      modes().fourth_bound(row(i).seen, modes().advanced(flight().free, s), m_.end_);
  const double seconds = 4.0 * opening / fall + std::cbrt(12.0 * level / fall);
  if (!(fall > 0.0 && seconds * fourth <= 0.1 * fall))
    refuse_graze(i, t, gap.value, closing.gap_error);
  const double acceleration = opening + 1.2 * fall * seconds;
  const double rate =
      std::abs(gap.slope) + deviation(now, row(i).rate()) + 2.0 * opening * opening / fall;
  const double height = level + std::pow(opening, 3) / (fall * fall);
  auto skipped = left_out({i, seconds, height, rate, acceleration, level}, now, held);
  if (!skipped) refuse_graze(i, t, gap.value, closing.gap_error);
  m_.unresolved_.push_back(std::move(*skipped));
  begin(std::move(held));
  m_.closed_.back().begins = {t, t + seconds};
  m_.closed_.back().from = std::min(t + opening / fall, m_.end_);
}

}  // namespace clackers::exact
