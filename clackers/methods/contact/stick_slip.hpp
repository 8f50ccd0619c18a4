#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "clackers/base/constants.hpp"
#include "clackers/methods/contact/constrained_system.hpp"
#include "clackers/methods/contact/crossing.hpp"
#include "clackers/methods/integrator.hpp"

namespace clackers::methods {

/// The rows of friction in a run with located events. A row slides one way or the other, which is a
/// force, or sticks, which is a constraint; it changes where its sliding speed crosses 0 and where the
/// force that holds it crosses its limit. A row of a contact rubs while the contact is active, and at
/// its impacts. For problems that objection_to_stick_slip() takes.
template <int Dof>
class StickSlip {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  struct Event {
    double s;  ///< after the state that the search began from [s]
    std::size_t row;
  };

  /// `rows` are the contacts of the problem, then its rows of friction; `constrained` is of them. Both
  /// must outlive this.
  StickSlip(const model::ImpactProblem<Dof>& problem, const ContactSet<Dof>& rows,
            ConstrainedSystem<Dof>& constrained)
      : frictions_(problem.frictions),
        contacts_(problem.contacts.size()),
        rows_(rows),
        constrained_(constrained) {
    held_.reserve(rows.size());
    begin();
  }

  void begin() {
    searches_ = 0;
    rubs_.assign(frictions_.size(), false);
    sign_.assign(frictions_.size(), 0);
  }
  long long searches() const { return searches_; }

  /// Adds the forces of the rows that slide to those of the load.
  void add_forces(std::span<double> force) const {
    Eigen::Map<Vector> all(force.data(), std::ssize(force));
    for (std::size_t i = 0; i < frictions_.size(); ++i) {
      if (sign_[i] == 0) continue;
      const auto& f = frictions_[i];
      double normal = 1.0;
      if (f.contact) {
        const auto j = to_index(*f.contact);
        normal = -rows_.response().velocity.col(j).dot(all) / rows_.response().delassus(j, j);
      }
      all -= sign_[i] * f.kinetic * normal * f.direction;
    }
  }

  /// The impulses of friction at contacts with these impulses.
  void impact(const Eigen::VectorXd& impulses, Vector& v) const {
    for (std::size_t i = 0; i < frictions_.size(); ++i) {
      const auto& f = frictions_[i];
      const auto j = at(i);
      if (!f.contact) continue;
      const double most = f.limit * impulses[to_index(*f.contact)],
                   stops = -f.sliding_speed(v) / rows_.response().delassus(j, j);
      v += std::clamp(stops, -most, most) * rows_.response().velocity.col(j);
    }
  }

  /// Which rows rub and stick at `now`, after its contacts were decided.
  void settle(const State& now) {
    for (std::size_t i = 0; i < frictions_.size(); ++i) {
      const auto& contact = frictions_[i].contact;
      rubs_[i] = !contact || constrained_.is_active(*contact);
      const double s = speed(i, now);
      sign_[i] = !rubs_[i] || std::abs(s) <= rounding(i, now) ? 0 : s > 0.0 ? 1 : -1;
    }
    constrain(now);
    for (std::size_t i = 0; i < frictions_.size(); ++i)
      if (rubs_[i] && sign_[i] == 0) decide(i, now);
  }

  /// True where no row changes between the two ends of a step.
  bool is_quiet(const State& before, const State& now) {
    for (std::size_t i = 0; i < frictions_.size(); ++i)
      if (rubs_[i] &&
          (sign_[i] == 0 ? margin(i, now) < 0.0
                         : !GapCubic(sample(i, 0.0, before), sample(i, now.t - before.t, now))
                                .stays_above(-std::max(rounding(i, before), rounding(i, now)))))
        return false;
    return true;
  }

  /// The first change between `from` and `now`.
  std::optional<Event> first_event(const State& from, const State& now, AnyStepper<Dof>& stepper) {
    std::optional<Event> first;
    for (std::size_t i = 0; i < frictions_.size(); ++i) {
      if (!rubs_[i]) continue;
      const auto s =
          sign_[i] == 0 ? slip_time(i, from, now, stepper) : stop_time(i, from, now, stepper);
      if (s && (!first || *s < first->s)) first = Event{*s, i};
    }
    return first;
  }

  /// Row i slides at `now` no more in its direction, or sticks no more.
  void change(std::size_t i, State& now) {
    if (sign_[i] == 0) return slide(i, now);
    now.v -= speed(i, now) / rows_.response().delassus(at(i), at(i)) *
             rows_.response().velocity.col(at(i));
    sign_[i] = 0;
    constrain(now);
    decide(i, now);
  }

 private:
  Eigen::Index at(std::size_t i) const { return to_index(contacts_ + i); }
  double speed(std::size_t i, const State& x) const { return frictions_[i].sliding_speed(x.v); }
  double rounding(std::size_t i, const State& x) const {
    return rows_.rate_rounding(contacts_ + i, x.v) +
           8.0 * epsilon * std::abs(frictions_[i].velocity);
  }
  // How much more force a row that sticks can hold.
  double margin(std::size_t i, const State& x) {
    const auto& f = frictions_[i];
    const auto& forces = constrained_.contact_forces(x);
    const double limit = f.limit * (f.contact ? forces[to_index(*f.contact)] : 1.0);
    return limit * (1.0 + 64.0 * epsilon) - std::abs(forces[at(i)]);
  }
  // The sliding speed in the direction of sliding, in place of a gap.
  GapSample sample(std::size_t i, double s, const State& x) {
    return {s, sign_[i] * speed(i, x), sign_[i] * constrained_.gap_acceleration(contacts_ + i, x)};
  }

  std::optional<double> slip_time(std::size_t i, const State& from, const State& now,
                                  AnyStepper<Dof>& stepper) {
    const double length = now.t - from.t, before = margin(i, from), after = margin(i, now);
    if (before < 0.0) return 0.0;
    if (!(after < 0.0)) return std::nullopt;
    ++searches_;
    return numerics::shrink([&](double s) { return margin(i, stepper.partial(from, s)); },
                            {0.0, before, length, after},
                            std::numeric_limits<double>::epsilon() * length)
        .b;
  }

  std::optional<double> stop_time(std::size_t i, const State& from, const State& now,
                                  AnyStepper<Dof>& stepper) {
    const auto a = sample(i, 0.0, from), b = sample(i, now.t - from.t, now);
    const double noise = std::max(rounding(i, from), rounding(i, now));
    if (a.g < -noise) return 0.0;
    if (GapCubic(a, b).stays_above(-noise)) return std::nullopt;
    int budget = 200;
    ++searches_;
    return first_crossing([&](double s) { return sample(i, s, stepper.partial(from, s)); }, a, b,
                          noise, budget);
  }

  // Row i, without sliding speed, sticks where its limit allows that.
  void decide(std::size_t i, const State& now) {
    if (margin(i, now) < 0.0) slide(i, now);
  }
  // Against the force that would have held it.
  void slide(std::size_t i, const State& now) {
    sign_[i] = constrained_.contact_forces(now)[at(i)] > 0.0 ? -1 : 1;
    constrain(now);
  }
  void constrain(const State& now) {
    held_.clear();
    for (const auto i : constrained_.active())
      if (i < contacts_) held_.push_back(i);
    for (std::size_t i = 0; i < frictions_.size(); ++i)
      if (rubs_[i] && sign_[i] == 0) held_.push_back(contacts_ + i);
    constrained_.hold(held_, now);
  }

  std::vector<model::Friction<Dof>> frictions_;
  std::size_t contacts_;  // rows before those of friction
  const ContactSet<Dof>& rows_;
  ConstrainedSystem<Dof>& constrained_;
  std::vector<bool> rubs_;
  std::vector<int> sign_;  // of the sliding speed; 0 where it sticks or does not rub
  std::vector<std::size_t> held_;
  long long searches_ = 0;
};

}  // namespace clackers::methods
