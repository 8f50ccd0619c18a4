#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "clackers/methods/contact/crossing.hpp"
#include "clackers/methods/contact/event_driven.hpp"
#include "clackers/methods/contact/held_system.hpp"
#include "clackers/methods/contact/impact_law.hpp"
#include "clackers/methods/recorder.hpp"
#include "clackers/methods/step_plan.hpp"

namespace clackers::methods {

/// A run with located impacts. While nothing is near a contact and nothing rests, a step is the
/// integrator's own and a few comparisons; all else is off that path.
template <class Integrator, int Dof>
class EventDriven::TimeLoop {
 public:
  using Stepper = typename Integrator::template Stepper<Dof>;
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  TimeLoop(const Integrator& integrator, const EventDriven&, model::ImpactProblem<Dof> problem,
           const StepPlan& plan)
      : problem_(std::move(problem)),
        plan_(plan),
        laws_(impact_laws(problem_)),
        held_(problem_.system, laws_),
        free_stepper_(integrator, problem_.system, plan.h),
        held_stepper_(integrator, held_.system(), plan.h),
        is_muted_(laws_.size(), false),
        from_(problem_.start),
        v_before_(problem_.start.v) {}
  TimeLoop(const TimeLoop&) = delete;
  TimeLoop& operator=(const TimeLoop&) = delete;

  void advance(Recorder<Dof>& out) {
    State now = problem_.start, before = now;
    start(now);
    if (!out.push(now)) return;
    for (long long k = 1; k <= plan_.total; ++k) {
      const double t1 = plan_.time(k);
      const bool is_whole = k <= plan_.whole;
      before = now;
      if (is_whole && !held_.is_any_held()) [[likely]] {
        free_stepper_.step(now);
      } else if (is_whole) {
        held_stepper_.step(now);
      } else {
        now = stepper().partial(before, t1 - before.t);
      }
      now.t = t1;  // counted over the whole run, whatever the stepper was restarted from
      if (!is_quiet(before, now)) [[unlikely]]
        if (!complete(before, now, is_whole, out)) return;
      ++steps_;
      if (!out.push(now)) return;
    }
  }

  model::Work work() const {
    model::Work work;
    work.steps = steps_;
    work.event_searches = searches_;
    free_stepper_.add_work(work);
    held_stepper_.add_work(work);
    return work;
  }

 private:
  struct Event {
    double s;
    std::size_t contact;
    bool is_release;
  };
  enum class Firing { impact, grazed, ended_run };

  Stepper& stepper() { return held_.is_any_held() ? held_stepper_ : free_stepper_; }

  GapSample sample(std::size_t i, double s, const State& x) const {
    return {s, laws_[i].contact.gap_at(x.u), laws_[i].contact.gap_rate(x.v)};
  }

  void start(const State& now) {
    steps_ = searches_ = 0;
    free_stepper_.reset();
    held_stepper_.reset();
    held_.release_all();
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (const auto at = sample(i, 0.0, now); at.g == 0.0 && at.rate == 0.0)
        hold_if_pressed(i, now);
    stepper().restart(now);
  }

  // True where nothing can have happened between the two ends of a step.
  bool is_quiet(const State& before, const State& now) {
    if (stepper().failed()) return false;
    const double length = now.t - before.t;
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (held_.is_any_held() && held_.is_held(i)) {
        if (!(held_.contact_force(i, now) >= 0.0)) return false;
      } else if (!GapCubic(sample(i, 0.0, before), sample(i, length, now)).stays_above(0.0)) {
        return false;
      }
    return true;
  }

  // A contact that has just lost its rate rests if free motion would close it.
  void hold_if_pressed(std::size_t i, const State& now) {
    if (!(held_.contact_force(i, now) > 0.0)) return;
    held_.hold(i, now.u);
    held_stepper_.rebuild();
  }

  // Everything that happens between `before` and `now`, the end of the step as it would be without
  // it. False: the run ends.
  bool complete(const State& before, State& now, bool is_stepped, Recorder<Dof>& out) {
    const double t1 = now.t;
    if (stepper().failed()) return out.fail_newton(t1);
    if (is_stepped) stepper().undo();  // partial steps are from `before`
    is_muted_.assign(is_muted_.size(), false);
    from_ = before;
    bool is_new_flight = false;
    for (int impacts = 0;;) {
      if (stepper().failed()) return out.fail_newton(t1);
      if (!now.u.allFinite() || !now.v.allFinite()) return out.fail_diverged(t1);
      const auto event = first_event(now);
      if (!event) break;
      if (event->is_release) {
        move_to(event->s, t1);
        held_.release(event->contact, from_.u);
        if (held_.is_any_held()) held_stepper_.rebuild();
      } else {
        const Firing firing = fire(*event, t1, out);
        if (firing == Firing::ended_run) return false;
        if (firing == Firing::grazed) continue;
      }
      if (++impacts > most_impacts)
        return out.fail(
            "too-many-impacts",
            fmt::format("t = {} s: more than {} impacts in one step", from_.t, most_impacts));
      stepper().restart(from_);
      is_new_flight = true;
      now = from_;
      if (t1 > from_.t) now = stepper().partial(from_, t1 - from_.t);
      now.t = t1;
    }
    if (is_new_flight) {
      // Flights shorter than the rounding of time end before they are seen to turn round: going on
      // would let the structure pass through the contact.
      for (std::size_t i = 0; i < laws_.size(); ++i)
        if (!held_.is_held(i) && laws_[i].contact.gap_rate(now.v) < 0.0 &&
            laws_[i].contact.gap_at(now.u) < -laws_[i].rounding(now.u))
          return out.fail(
              "too-many-impacts",
              fmt::format("t = {} s: impacts accumulate, closer than time can tell them apart",
                          from_.t));
      stepper().restart(now);
    } else if (is_stepped) {  // nothing happened: the step is taken again as it was
      now = from_;
      stepper().step(now);
      now.t = t1;
    }
    return true;
  }

  void move_to(double s, double t1) {
    if (!(s > 0.0)) return;
    const double t = from_.t + s;
    from_ = stepper().partial(from_, s);
    from_.t = std::min(t, t1);  // s reaches t1 - from_.t at most; its rounding may pass it
  }

  // The next impact or release between from_ and `now`.
  std::optional<Event> first_event(const State& now) {
    const double length = now.t - from_.t;
    std::optional<Event> first;
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      if (is_muted_[i]) continue;
      const auto s = held_.is_held(i) ? release_time(i, length, now) : impact_time(i, length, now);
      if (s && (!first || *s < first->s)) first = Event{*s, i, held_.is_held(i)};
    }
    return first;
  }

  std::optional<double> release_time(std::size_t i, double length, const State& now) {
    const double before = held_.contact_force(i, from_), after = held_.contact_force(i, now);
    if (before < 0.0) return 0.0;
    if (!(after < 0.0)) return std::nullopt;
    const double unit = std::numeric_limits<double>::epsilon() * length;
    ++searches_;
    return numerics::shrink(
               [&](double s) { return held_.contact_force(i, stepper().partial(from_, s)); },
               {0.0, before, length, after}, unit)
        .b;
  }

  std::optional<double> impact_time(std::size_t i, double length, const State& now) {
    const auto a = sample(i, 0.0, from_), b = sample(i, length, now);
    const double rounding = std::max(laws_[i].rounding(from_.u), laws_[i].rounding(now.u));
    // Violated at the start: closing, it fires at once; leaving, it is watched again once open.
    if (a.g < -rounding) return a.rate < 0.0 ? std::optional(0.0) : std::nullopt;
    if (GapCubic(a, b).stays_above(-rounding)) return std::nullopt;
    int budget = 200;  // a graze halves a piece about 26 times before it is rounding, twice each
    ++searches_;
    return first_crossing([&](double s) { return sample(i, s, stepper().partial(from_, s)); }, a, b,
                          rounding, budget);
  }

  // Moves from_ to the later side of an impact, unless it was a graze or ended the run.
  Firing fire(const Event& event, double t1, Recorder<Dof>& out) {
    const std::size_t i = event.contact;
    const auto& law = laws_[i];
    const State& there = event.s > 0.0 ? stepper().partial(from_, event.s) : from_;
    if (!(law.contact.gap_rate(there.v) < 0.0)) {
      // Opening and rate of the step map disagree by its error: a graze, where no impulse is
      // defined. The contact is watched again from the end of the step.
      is_muted_[i] = true;
      return Firing::grazed;
    }
    move_to(event.s, t1);
    for (std::size_t j = 0; j < laws_.size(); ++j)
      if (j != i && is_closed(j) && are_coupled(law, laws_[j])) {
        out.fail("simultaneous-contacts", simultaneous(from_.t, std::min(i, j), std::max(i, j)));
        return Firing::ended_run;
      }
    v_before_ = from_.v;
    const double impulse = law.apply(from_.v);
    if (!out.impact(from_, static_cast<int>(i), v_before_, impulse)) return Firing::ended_run;
    if (law.contact.restitution == 0.0) hold_if_pressed(i, from_);
    return Firing::impact;
  }

  bool is_closed(std::size_t i) const {
    return held_.is_held(i) || laws_[i].contact.gap_at(from_.u) <= laws_[i].rounding(from_.u);
  }

  model::ImpactProblem<Dof> problem_;
  StepPlan plan_;
  std::vector<ImpactLaw<Dof>> laws_;
  HeldSystem<Dof> held_;
  Stepper free_stepper_, held_stepper_;
  std::vector<bool> is_muted_;
  State from_;
  Vector v_before_;
  long long steps_ = 0, searches_ = 0;
};

}  // namespace clackers::methods
