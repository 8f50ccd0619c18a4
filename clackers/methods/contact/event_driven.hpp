#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/methods/contact/constrained_system.hpp"
#include "clackers/methods/contact/crossing.hpp"
#include "clackers/methods/contact/impact_law.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"
#include "clackers/methods/recorder.hpp"
#include "clackers/methods/step_plan.hpp"

namespace clackers::methods {

/// Impacts located inside the step. A contact j with gap g_j and Newton's law,
///
///     g_j = b_j . u - gap_j >= 0,   b_j . v(+) = -eta_j b_j . v(-),   M [v(+) - v(-)] = b_j P
///
/// has an impact where the step map crosses g_j = 0 from above with b_j . v < 0; the state there is
/// that of the integrator's partial step. The integrator is restarted from v(+) and completes the
/// rest of the step, so output stays on the grid. Crossings are looked for whenever the cubic
/// through gap and gap rate at both ends of the step does not stay open, also when both ends are.
/// A crossing with b_j . v >= 0 is grazing: the integrator is restarted there without an impulse.
///
/// A contact is an active constraint when it is closed, its gap rate is 0 and the free motion would
/// close it: after an impact with eta = 0, or from a start at rest. It is deactivated where its
/// force changes sign. One contact is handled at a time: two that share a mass and are closed
/// together end the run, and so do more than 1000 events in one step.
///
/// Order       that of the integrator.
/// Stability   that of the integrator.
/// Dissipation none at impacts with eta = 1.
/// Memory      what the integrator remembers is dropped at each impact.
/// Cost        two products a contact and step; about ten partial steps an impact.
/// Source      L. F. Shampine, I. Gladwell, R. W. Brankin, ACM Trans. Math. Softw. 17, 11-25
/// (1991).
struct EventDriven {
  static constexpr std::string_view name = "event-driven";
  static constexpr std::string_view summary =
      "impacts located inside the step, the rest of the step completed after them";
  static const std::vector<Field<EventDriven>>& fields();

  static constexpr int most_events = 1000;  ///< in one step; a message and the card repeat it

  void validate() const {}
  Claim claim(const Facts& integrator) const {
    return {Behaviour::proper, integrator.smooth_order, {}};
  }
  std::optional<Objection> objection(const std::string& who,
                                     const model::ImpactProblem<>& problem) const {
    return objection_to_closed_contacts(who, problem);
  }
  double contact_time(const model::ImpactProblem<>&) const { return 0.0; }

  template <class Integrator, int Dof>
  class TimeLoop;
};

/// A run with located impacts. While nothing is near a contact and no contact is active, a step is the
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
        constrained_(problem_.system, laws_),
        free_stepper_(integrator, problem_.system, plan.h),
        constrained_stepper_(integrator, constrained_.system(), plan.h),
        is_suppressed_(laws_.size(), false),
        from_(problem_.start),
        v_before_(problem_.start.v) {}
  TimeLoop(const TimeLoop&) = delete;
  TimeLoop& operator=(const TimeLoop&) = delete;

  void advance(Recorder<Dof>& out) {
    State now = problem_.start, before = now;
    start(now);
    if (!out.append(now)) return;
    for (long long k = 1; k <= plan_.total; ++k) {
      const double t1 = plan_.time(k);
      const bool is_whole = k <= plan_.whole;
      before = now;
      if (is_whole && !constrained_.is_any_active()) [[likely]] {
        free_stepper_.step(now);
      } else if (is_whole) {
        constrained_stepper_.step(now);
      } else {
        now = stepper().partial(before, t1 - before.t);
      }
      now.t = t1;  // counted over the whole run, whatever the stepper was restarted from
      if (!has_no_event(before, now)) [[unlikely]]
        if (!complete(before, now, is_whole, out)) return;
      ++steps_;
      if (!out.append(now)) return;
    }
  }

  model::Work work() const {
    model::Work work;
    work.steps = steps_;
    work.event_searches = searches_;
    free_stepper_.add_work(work);
    constrained_stepper_.add_work(work);
    return work;
  }

 private:
  struct Event {
    double s;
    std::size_t contact;
    bool is_release;
  };

  Stepper& stepper() { return constrained_.is_any_active() ? constrained_stepper_ : free_stepper_; }

  GapSample sample(std::size_t i, double s, const State& x) const {
    return {s, laws_[i].contact.gap_at(x.u), laws_[i].contact.gap_rate(x.v)};
  }

  void start(const State& now) {
    steps_ = searches_ = 0;
    free_stepper_.reset();
    constrained_stepper_.reset();
    constrained_.deactivate_all();
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (const auto at = sample(i, 0.0, now); at.g == 0.0 && at.rate == 0.0)
        activate_if_pressed(i, now);
    stepper().restart(now);
  }

  // True where nothing can have happened between the two ends of a step.
  bool has_no_event(const State& before, const State& now) {
    if (stepper().failed()) return false;
    const double length = now.t - before.t;
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (constrained_.is_any_active() && constrained_.is_active(i)) {
        if (!(constrained_.contact_force(i, now) >= 0.0)) return false;
      } else if (!GapCubic(sample(i, 0.0, before), sample(i, length, now)).stays_above(0.0)) {
        return false;
      }
    return true;
  }

  // A closed contact whose gap rate is 0 becomes active if the free motion would close it.
  void activate_if_pressed(std::size_t i, const State& now) {
    if (!(constrained_.contact_force(i, now) > 0.0)) return;
    constrained_.activate(i, now.u);
    constrained_stepper_.rebuild();
  }

  // Everything that happens between `before` and `now`, the end of the step as it would be without
  // it. False: the run ends.
  bool complete(const State& before, State& now, bool is_stepped, Recorder<Dof>& out) {
    const double t1 = now.t;
    if (stepper().failed()) return out.fail_step(t1, stepper().failure());
    if (is_stepped) stepper().undo();  // partial steps are from `before`
    is_suppressed_.assign(is_suppressed_.size(), false);
    from_ = before;
    int events = 0;
    while (true) {
      if (stepper().failed()) return out.fail_step(t1, stepper().failure());
      if (!now.u.allFinite() || !now.v.allFinite()) return out.fail_diverged(t1);
      const auto event = first_event(now);
      if (!event) break;
      if (++events > most_events)
        return out.fail("too-many-impacts", from_.t, "more than 1000 impacts in one step");
      if (!apply(*event, t1, out)) return false;
      stepper().restart(from_);
      now = from_;
      if (t1 > from_.t) now = stepper().partial(from_, t1 - from_.t);
      now.t = t1;
    }
    if (events > 0) return finish_step(now, out);
    if (is_stepped) {  // nothing happened: the step is taken again as it was
      now = from_;
      stepper().step(now);
      now.t = t1;
    }
    return true;
  }

  // The end of a step with events.
  bool finish_step(const State& now, Recorder<Dof>& out) {
    // Flights shorter than the rounding of time end before they are seen to reverse: going on would
    // let the structure pass through the contact.
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (!constrained_.is_active(i) && !is_suppressed_[i] &&
          laws_[i].contact.gap_rate(now.v) < 0.0 &&
          laws_[i].contact.gap_at(now.u) < -laws_[i].rounding(now.u))
        return out.fail("too-many-impacts", from_.t,
                        "impacts accumulate, closer than rounding of the time can separate");
    stepper().restart(now);
    return true;
  }

  // Moves from_ to the later side of an event. False: the run ends.
  bool apply(const Event& event, double t1, Recorder<Dof>& out) {
    const std::size_t i = event.contact;
    if (event.is_release) {
      move_to(event.s, t1);
      constrained_.deactivate(i, from_.u);
      if (constrained_.is_any_active()) constrained_stepper_.rebuild();
    } else {
      const double arrived_after = event.s;
      move_to(event.s, t1);
      if (!(laws_[i].contact.gap_rate(from_.v) < 0.0)) {
        // Gap and rate of the step map disagree by its error: grazing, where no impulse is defined.
        // Where the motion does not leave this instant, the contact is watched again after the next
        // event, or from the end of the step.
        if (!(arrived_after > 0.0)) is_suppressed_[i] = true;
        return true;
      }
      if (!apply_impact(i, out)) return false;
    }
    is_suppressed_.assign(is_suppressed_.size(), false);
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
      if (is_suppressed_[i]) continue;
      const auto s =
          constrained_.is_active(i) ? release_time(i, length, now) : impact_time(i, length, now);
      if (s && (!first || *s < first->s)) first = Event{*s, i, constrained_.is_active(i)};
    }
    return first;
  }

  std::optional<double> release_time(std::size_t i, double length, const State& now) {
    const double before = constrained_.contact_force(i, from_),
                 after = constrained_.contact_force(i, now);
    if (before < 0.0) return 0.0;
    if (!(after < 0.0)) return std::nullopt;
    const double unit = std::numeric_limits<double>::epsilon() * length;
    ++searches_;
    return numerics::shrink(
               [&](double s) { return constrained_.contact_force(i, stepper().partial(from_, s)); },
               {0.0, before, length, after}, unit)
        .b;
  }

  std::optional<double> impact_time(std::size_t i, double length, const State& now) {
    const auto a = sample(i, 0.0, from_), b = sample(i, length, now);
    const double rounding = std::max(laws_[i].rounding(from_.u), laws_[i].rounding(now.u));
    // Violated at the start: closing, the impact is now; opening, it is watched again once open.
    if (a.g < -rounding) return a.rate < 0.0 ? std::optional(0.0) : std::nullopt;
    if (GapCubic(a, b).stays_above(-rounding)) return std::nullopt;
    int budget = 200;  // a graze halves a piece about 26 times before it is rounding, twice each
    ++searches_;
    return first_crossing([&](double s) { return sample(i, s, stepper().partial(from_, s)); }, a, b,
                          rounding, budget);
  }

  // The impulse at from_. False: the run ends.
  bool apply_impact(std::size_t i, Recorder<Dof>& out) {
    const auto& law = laws_[i];
    for (std::size_t j = 0; j < laws_.size(); ++j)
      if (j != i && is_closed(j) && are_coupled(law, laws_[j]))
        return out.fail("simultaneous-contacts", from_.t,
                        simultaneous(std::min(i, j), std::max(i, j)));
    v_before_ = from_.v;
    const double impulse = law.apply(from_.v);
    if (!out.impact(from_, static_cast<int>(i), v_before_, impulse)) return false;
    if (law.contact.restitution == 0.0) activate_if_pressed(i, from_);
    return true;
  }

  bool is_closed(std::size_t i) const {
    return constrained_.is_active(i) ||
           laws_[i].contact.gap_at(from_.u) <= laws_[i].rounding(from_.u);
  }

  model::ImpactProblem<Dof> problem_;
  StepPlan plan_;
  std::vector<ImpactLaw<Dof>> laws_;
  ConstrainedSystem<Dof> constrained_;
  Stepper free_stepper_, constrained_stepper_;
  std::vector<bool> is_suppressed_;
  State from_;
  Vector v_before_;
  long long steps_ = 0, searches_ = 0;
};

}  // namespace clackers::methods
