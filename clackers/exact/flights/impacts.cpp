#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/flights/piecewise_builder.hpp"
#include "clackers/exact/flights/simultaneity.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

auto PiecewiseMotion::Builder::closing_first(const std::vector<Closing>& closings) const
    -> std::vector<Closing> {
  std::vector<Closing> together{closings.front()};
  const Closing& first = closings.front();
  const auto is_impact = [&](const Closing& closing) {
    return !closing.is_soft && !is_held(closing.contact);
  };
  for (const Closing& next : std::span(closings).subspan(1)) {
    if (next.first() > first.last()) continue;
    const auto acts = std::ranges::find_if(together, [&](const Closing& other) {
      return act_on_each_other(other.contact, next.contact);
    });
    const bool is_same = next.s - first.s <= 4.0 * epsilon * (flight().t + first.s) &&
                         is_impact(first) && is_impact(next);
    if (acts != together.end() &&
        (first.is_soft || next.is_soft || is_held(first.contact) != is_held(next.contact) ||
         (m_.has_bounds_ && !close_together(problem_, acts->contact, next.contact))))
      throw InputError(
          fmt::format("{}: contacts {} and {} close {:.3g} s apart near t = {:.9g} s, the error of "
                      "that is {:.3g} s, and the first impact changes the second; allowed: impacts "
                      "whose order is certain, or that are simultaneous by a symmetry of the "
                      "problem. Change a gap by more, or end the run earlier.",
                      m_.who_, std::min(acts->contact, next.contact) + 1,
                      std::max(acts->contact, next.contact) + 1, next.s - acts->s,
                      flight().t + first.s, acts->time_error + next.time_error),
          "not-admissible");
    if (acts != together.end() || is_same) together.push_back(next);
  }
  std::ranges::sort(together, {}, &Closing::contact);
  return together;
}

bool PiecewiseMotion::Builder::act_on_each_other(std::size_t a, std::size_t b) const {
  return std::abs(delassus(0, a, b)) >
         8.0 * double(m_.dof()) * epsilon * std::sqrt(delassus(0, a, a) * delassus(0, b, b));
}

void PiecewiseMotion::Builder::happen(const std::vector<Closing>& closings) {
  if (closings.front().is_soft)
    land(closings.front());
  else if (is_held(closings.front().contact))
    release(closings);
  else if (departs())
    depart(closings.front());
  else
    collide(closings);
}

double PiecewiseMotion::Builder::deviation(const State& state, const VectorXd& row) const {
  double size = row.cwiseAbs().dot(state.z.cwiseAbs());
  for (const auto& force : m_.regimes_[state.regime].forces())
    size += (1.0 + force.frequency * state.t) * row.cwiseAbs().dot(force.sizes(state.t));
  const double rounding = epsilon * double(m_.dof() + 4) * size;
  if (!m_.has_bounds_) return rounding;
  return state.errors.bounds(m_.regimes_[state.regime], row.transpose())[0] + rounding;
}

void PiecewiseMotion::Builder::collide(std::vector<Closing> closings) {
  const State before = arrived(closings);
  const double s = closings.front().s, t = before.t;
  const auto now = flight().regime, base = with_held(now, held(now), false);
  const auto& rows = rows_[base];
  const VectorXd a_before = modes().acceleration(before.z, t),
                 arriving = modes().velocity(before.z);
  fastest_ = std::max(fastest_, arriving.cwiseAbs().maxCoeff());
  State state = seen_in(base, before);
  auto closed = held(now);
  VectorXd q = VectorXd::Zero(Index(springs())), shared = VectorXd::Zero(state.z.size());
  for (const auto i : closed) shared -= watch(i, s).value * rows[i].impulse;
  // Terms of second order over those of first order.
  double nonlinear = 0.0;
  for (const auto& closing : closings) {
    closed.push_back(closing.contact);
    const auto gap = watch(closing.contact, s);
    const double delay = closing.gap_error / gap.slope;
    nonlinear +=
        std::abs(delay / gap.slope) * (std::abs(gap.second) + gap.third_bound * std::abs(delay));
    q[Index(closing.contact)] = (1.0 + problem_.contacts[closing.contact].restitution) *
                                rows[closing.contact].rate().dot(state.z);
  }
  std::ranges::sort(closed);
  auto impulses = solve(base, q, closed, t);
  State after = state;
  const VectorXd lost = strike(after, q, impulses);
  const auto carry = [&](const VectorXd& more) {
    if (!m_.has_bounds_) return;
    auto impact = saltation(base, closings, impulses, state.z, a_before, more);
    impact.rounding = (after.precise.empty() ? 4.0 * epsilon : 0x1p-96) * std::max(t, s);
    after.errors = state.errors;
    after.errors.pass(m_.regimes_[base], impact);
    after.errors.enlarge(1.0 + 4.0 * nonlinear);
    if (lost.size() > 0) after.errors.add(m_.regimes_[base], lost);
  };
  carry(shared);
  for (const auto& closing : closings) {
    m_.hits_.push_back({t, closing.time_error, impulses[Index(closing.contact)],
                        int(closing.contact), m_.flights_.size() - 1});
    after.time_error = std::max(after.time_error, closing.time_error);
  }
  std::vector<std::size_t> pushing;
  for (const auto i : closed)
    if (impulses[Index(i)] > 0.0) pushing.push_back(i);
  std::stable_partition(pushing.begin(), pushing.end(), [&](std::size_t i) { return !is_held(i); });
  const double late = closings.front().time_error;
  if (!pushing.empty()) m_.flights_.back().ends = Event{{t - late, t + late}, pushing};
  const auto& free = m_.regimes_[base];
  if (at_rest(free.displacement(after.z), free.velocity(after.z), arriving)) {
    begin(std::move(after));
    m_.flights_.back().free.setZero();
    is_over_ = true;
    return;
  }
  const auto after_rest = staying(closed, impulses, after);
  const auto next = resting(after, after_rest);
  if (next != base) {
    const auto seen = seen_in(next, after);
    const VectorXd of_free = seen.z - m_.regimes_[next].steady(t);
    for (const auto i : held(next))
      shared += m_.regimes_[next].now(*m_.forces_[next][i], of_free, t).value * rows[i].impulse;
    carry(shared);
  }
  begin(seen_in(after_impact(next), after));
}

void PiecewiseMotion::Builder::depart(const Closing& closing) {
  const auto i = closing.contact;
  double t = flight().t + closing.s;
  if (law_.grid > 0.0) {
    // A contact within a rounding of a grid time acts there.
    const double start = problem_.start.t;
    t = std::max(t, start + law_.grid * std::ceil((t - start) / law_.grid - 1e-9));
    if (t > m_.end_) {
      is_over_ = true;
      return;
    }
  }
  const auto& row = this->row(i);
  State state{flight().regime, t, m_.total(flight(), t), {}};
  if (const double rate = row.rate().dot(state.z); rate < 0.0) {
    const int count = int(m_.hits_.size()) + 1;
    double impulse = -(1.0 + contacts_[i].restitution) * rate / delassus(state.regime, i, i);
    if (count == law_.missed) impulse = 0.0;
    if (count == law_.doubled) impulse *= 2.0;
    VectorXd direction = contacts_[i].direction;
    if (!law_.impulse_factor.empty())
      direction.array() *= Eigen::Map<const Eigen::ArrayXd>(law_.impulse_factor.data(), m_.dof());
    state.z += impulse * modes().impulse(direction);
    m_.hits_.push_back({t, 0.0, impulse, int(i), m_.flights_.size() - 1});
  }
  passed_[i] =
      row.rate().dot(state.z) < 0.0 || (law_.grid > 0.0 && watch(i, t - flight().t).value < 0.0);
  opens_[i] = Begin::by_speed;
  begin(seen_in(after_impact(state.regime), state));
}

std::vector<std::size_t> PiecewiseMotion::Builder::staying(const std::vector<std::size_t>& closed,
                                                           const VectorXd& impulses,
                                                           const State& after) {
  std::vector<std::size_t> stay;
  for (const auto i : closed) {
    const bool was_held = is_held(i);
    const auto& row = rows_[after.regime][i];
    const bool is_struck = impulses[Index(i)] > 0.0;
    const bool is_concerned = std::ranges::any_of(closed, [&](std::size_t j) {
      return j != i && impulses[Index(j)] > 0.0 && act_on_each_other(i, j);
    });
    const double rate = row.rate().dot(after.z);
    const double allowed = certain_depth * deviation(after, row.rate());
    if (was_held && is_concerned &&
        std::max(rate, impulses[Index(i)] * row.rate().dot(row.impulse)) < allowed)
      throw InputError(
          fmt::format("{}: whether contact {}, which is closed, opens by the impact at t = {:.9g} "
                      "s is not certain; allowed: impacts after which it is. Change a number of "
                      "the problem, or end the run earlier.",
                      m_.who_, i + 1, after.t),
          "not-admissible");
    const bool rebounds =
        is_struck ? !was_held && problem_.contacts[i].restitution > 0.0 : !was_held || is_concerned;
    if (rebounds)
      opens_[i] = Begin::by_speed;
    else
      stay.push_back(i);
  }
  return stay;
}

bool PiecewiseMotion::Builder::at_rest(const VectorXd& u, const VectorXd& after,
                                       const VectorXd& before) const {
  const double small = touching_share * before.cwiseAbs().maxCoeff();
  return m_.regimes_[0].forces().empty() && stiffnesses_.empty() &&
         after.cwiseAbs().maxCoeff() <= small &&
         u.cwiseAbs().maxCoeff() * m_.regimes_[0].system().fastest() <= small;
}

VectorXd PiecewiseMotion::Builder::solve(std::size_t regime, const VectorXd& q,
                                         const std::vector<std::size_t>& contacts, double t) {
  const auto count = Index(springs());
  MatrixXd w = MatrixXd::Zero(count, count);
  VectorXd values = VectorXd::Zero(count);
  for (const auto i : contacts)
    for (const auto j : contacts) w(Index(i), Index(j)) = delassus(regime, i, j);
  numerics::PrincipalCholesky factors(contacts.size());
  const auto independent = factors.compute(w, contacts);
  if (independent < contacts.size())
    throw InputError(
        fmt::format("{}: contact {} and others close together at t = {:.9g} s, and its direction "
                    "depends linearly on theirs; allowed: contacts whose impulses are unique. "
                    "Leave one out.",
                    m_.who_, contacts[independent] + 1, t),
        "redundant-contacts");
  if (!lcp_.solve(w, q, contacts, values))
    throw InputError(fmt::format("{}: the impulses of {} contacts at t = {:.9g} s were not found.",
                                 m_.who_, contacts.size(), t),
                     "complementarity-failed");
  return values;
}

auto PiecewiseMotion::Builder::saltation(std::size_t regime, const std::vector<Closing>& closings,
                                         const VectorXd& impulses, const VectorXd& z,
                                         const VectorXd& a_before, VectorXd shared) const
    -> FlightErrors::Impact {
  const auto& rows = rows_[regime];
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < springs(); ++i)
    if (impulses[Index(i)] > 0.0) active.push_back(i);
  const auto count = Index(active.size());
  MatrixXd law(count, count), rates(count, z.size());
  VectorXd pressed(count);
  for (Index c = 0; c < count; ++c) {
    const auto i = active[std::size_t(c)];
    for (Index d = 0; d < count; ++d) law(c, d) = delassus(regime, i, active[std::size_t(d)]);
    rates.row(c) = rows[i].rate().transpose();
    pressed[c] = problem_.contacts[i].direction.dot(a_before);
  }
  const auto closes = [&](std::size_t i) {
    return std::ranges::find(closings, i, &Closing::contact) != closings.end();
  };
  FlightErrors::Impact found;
  law = numerics::inverse(law);
  for (Index c = 0; c < count; ++c)
    if (const auto i = active[std::size_t(c)]; closes(i))
      law.col(c) *= 1.0 + problem_.contacts[i].restitution;
  rates = law * rates;  // -impulses by z
  pressed = law * pressed;
  found.impulses.resize(z.size(), count);
  found.jumps.resize(z.size(), 0);
  found.gaps.resize(z.size(), 0);
  found.rates = rates.transpose();
  const auto add = [&](std::size_t contact, const VectorXd& jump) {
    const Index column = found.jumps.cols();
    for (auto* columns : {&found.jumps, &found.gaps})
      columns->conservativeResize(Eigen::NoChange, column + 1);
    found.jumps.col(column) = jump;
    found.gaps.col(column) = rows[contact].gap() / rows[contact].rate().dot(z);
  };
  for (Index c = 0; c < count; ++c) {
    const auto i = active[std::size_t(c)];
    found.impulses.col(c) = rows[i].impulse;
    const VectorXd jump = impulses[Index(i)] * m_.regimes_[regime].rate(rows[i].impulse) +
                          pressed[c] * rows[i].impulse;
    if (closes(i))
      add(i, jump);
    else
      shared += jump;
  }
  if (!shared.isZero(0.0)) add(closings.front().contact, shared);
  return found;
}

}  // namespace clackers::exact
