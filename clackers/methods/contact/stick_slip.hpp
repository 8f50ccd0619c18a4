#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "clackers/base/constants.hpp"
#include "clackers/methods/contact/constrained_system.hpp"
#include "clackers/methods/contact/crossing.hpp"
#include "clackers/methods/contact/friction_rows.hpp"
#include "clackers/methods/stepping/recorder.hpp"
#include "clackers/methods/stepping/time_loop.hpp"

namespace clackers::methods {

/// A run with located stick and slip. A row of friction slides one way or the other, which is a constant
/// force, or sticks, which is a constraint; it changes where its sliding speed crosses 0 and where the
/// force that holds it crosses its limit.
template <int Dof>
class StickSlip {
 public:
  using State = model::State<Dof>;

  StickSlip(const Integrator& integrator, const model::ImpactProblem<Dof>& problem,
            const StepPlan& plan)
      : problem_(problem),
        load_(problem.system.add_load),
        time_loop_(plan, problem_),
        rows_(friction_rows(problem)),
        constrained_(problem_.system, rows_),
        sign_(rows_.size(), 0),
        from_(problem.start),
        is_adaptive_(plan.is_adaptive()) {
    problem_.system.add_load = [this](double t, std::span<double> force) { add_forces(t, force); };
    free_stepper_ = integrator.stepper(problem_.system, plan);
    constrained_stepper_ = integrator.stepper(constrained_.system(), plan);
    sticking_.reserve(rows_.size());
  }
  StickSlip(const StickSlip&) = delete;
  StickSlip& operator=(const StickSlip&) = delete;

  void advance(Recorder<Dof>& out) {
    searches_ = 0;
    free_stepper_->reset();
    constrained_stepper_->reset();
    from_ = problem_.start;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double s = speed(i, from_);
      sign_[i] = std::abs(s) <= rounding(i, from_) ? 0 : s > 0.0 ? 1 : -1;
    }
    constrain();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (sign_[i] == 0) decide(i);
    stepper().restart(from_);
    steps_ = time_loop_.run(*this, problem_.start, out);
  }

  model::Work work() const {
    return work_of(steps_, searches_, *free_stepper_, *constrained_stepper_);
  }

  AnyStepper<Dof>& stepper() {
    return constrained_.is_any_active() ? *constrained_stepper_ : *free_stepper_;
  }
  bool is_open() const { return false; }

  bool is_quiet(const State& before, const State& now) {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (sign_[i] == 0 ? margin(i, now) < 0.0
                        : !GapCubic(sample(i, 0.0, before), sample(i, now.t - before.t, now))
                               .stays_above(-std::max(rounding(i, before), rounding(i, now))))
        return false;
    return true;
  }

  Handled handle(const State& before, State& now, Recorder<Dof>& out) {
    const double t1 = now.t;
    from_ = before;
    for (int count = 0;; ++count) {
      if (stepper().failed()) {
        out.fail_step(t1, stepper().failure());
        return Handled::ended;
      }
      if (!now.u.allFinite() || !now.v.allFinite()) {
        out.fail_diverged(t1);
        return Handled::ended;
      }
      const auto event = first_event(now);
      if (!event) {
        if (count == 0) return Handled::unchanged;
        stepper().go_on(from_, t1 - from_.t, now);
        return Handled::changed;
      }
      if (count == most_events) {
        out.fail("too-many-impacts", from_.t,
                 "more than 1000 changes of stick and slip in one step");
        return Handled::ended;
      }
      if (event->s > 0.0) {
        const double t = std::min(from_.t + event->s, t1);
        from_ = stepper().partial(from_, event->s);
        from_.t = t;
      }
      change(event->row);
      stepper().restart(from_);
      now = from_;
      if (is_adaptive_) return Handled::shortened;
      if (t1 > from_.t) now = stepper().partial(from_, t1 - from_.t);
      now.t = t1;
    }
  }

 private:
  static constexpr int most_events = 1000;  ///< in one step; a message and the card repeat it

  struct Event {
    double s;
    std::size_t row;
  };

  const model::Friction<Dof>& friction(std::size_t i) const { return problem_.frictions[i]; }
  double speed(std::size_t i, const State& x) const { return friction(i).sliding_speed(x.v); }
  double rounding(std::size_t i, const State& x) const {
    return rows_.rate_rounding(i, x.v) + 8.0 * epsilon * std::abs(friction(i).velocity);
  }
  // How much more force a row that sticks can hold.
  double margin(std::size_t i, const State& x) {
    const double limit = friction(i).limit;
    return limit * (1.0 + 64.0 * epsilon) - std::abs(constrained_.contact_forces(x)[to_index(i)]);
  }
  // The sliding speed in the direction of sliding, in place of a gap.
  GapSample sample(std::size_t i, double s, const State& x) {
    return {s, sign_[i] * speed(i, x), sign_[i] * constrained_.gap_acceleration(i, x)};
  }

  void add_forces(double t, std::span<double> force) const {
    if (load_) load_(t, force);
    for (std::size_t i = 0; i < sign_.size(); ++i)
      if (sign_[i] != 0)
        for (std::size_t k = 0; k < force.size(); ++k)
          force[k] -= sign_[i] * friction(i).kinetic * friction(i).direction[to_index(k)];
  }

  std::optional<Event> first_event(const State& now) {
    const double length = now.t - from_.t;
    std::optional<Event> first;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto s = sign_[i] == 0 ? slip_time(i, length, now) : stop_time(i, length, now);
      if (s && (!first || *s < first->s)) first = Event{*s, i};
    }
    return first;
  }

  std::optional<double> slip_time(std::size_t i, double length, const State& now) {
    const double before = margin(i, from_), after = margin(i, now);
    if (before < 0.0) return 0.0;
    if (!(after < 0.0)) return std::nullopt;
    ++searches_;
    return numerics::shrink([&](double s) { return margin(i, stepper().partial(from_, s)); },
                            {0.0, before, length, after},
                            std::numeric_limits<double>::epsilon() * length)
        .b;
  }

  std::optional<double> stop_time(std::size_t i, double length, const State& now) {
    const auto a = sample(i, 0.0, from_), b = sample(i, length, now);
    const double noise = std::max(rounding(i, from_), rounding(i, now));
    if (a.g < -noise) return 0.0;
    if (GapCubic(a, b).stays_above(-noise)) return std::nullopt;
    int budget = 200;
    ++searches_;
    return first_crossing([&](double s) { return sample(i, s, stepper().partial(from_, s)); }, a, b,
                          noise, budget);
  }

  // Row i slides no more in its direction, or sticks no more.
  void change(std::size_t i) {
    if (sign_[i] == 0) return slide(i);
    const auto& response = rows_.response();
    from_.v -= speed(i, from_) / response.delassus(to_index(i), to_index(i)) *
               response.velocity.col(to_index(i));
    sign_[i] = 0;
    constrain();
    decide(i);
  }
  // Row i, without sliding speed, sticks where its limit allows that.
  void decide(std::size_t i) {
    if (margin(i, from_) < 0.0) slide(i);
  }
  // Against the force that would have held it.
  void slide(std::size_t i) {
    sign_[i] = constrained_.contact_forces(from_)[to_index(i)] > 0.0 ? -1 : 1;
    constrain();
  }
  void constrain() {
    sticking_.clear();
    for (std::size_t i = 0; i < sign_.size(); ++i)
      if (sign_[i] == 0) sticking_.push_back(i);
    constrained_.hold(sticking_, from_);
    if (!sticking_.empty()) constrained_stepper_->rebuild();
  }

  model::ImpactProblem<Dof> problem_;  // its load has the forces of sliding
  model::Load load_;
  TimeLoop<Dof> time_loop_;
  ContactSet<Dof> rows_;
  ConstrainedSystem<Dof> constrained_;
  std::unique_ptr<AnyStepper<Dof>> free_stepper_, constrained_stepper_;
  std::vector<int> sign_;  // of the sliding speed; 0 sticks
  std::vector<std::size_t> sticking_;
  State from_;
  bool is_adaptive_;
  long long steps_ = 0, searches_ = 0;
};

}  // namespace clackers::methods
