#include "clackers/methods/contact/event_driven.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "clackers/methods/contact/constrained_system.hpp"
#include "clackers/methods/contact/crossing.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/stepping/time_loop.hpp"

namespace clackers::methods {

const std::vector<Field<EventDriven>>& EventDriven::fields() {
  static const std::vector<Field<EventDriven>> none;
  return none;
}

/// A run with located impacts. While nothing is near a contact and no contact is active, a step is the
/// integrator's own and a few comparisons; all else is off that path.
template <int Dof>
class EventDriven::Loop {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  Loop(const Integrator& integrator, const EventDriven&, model::ImpactProblem<Dof> problem,
       const StepPlan& plan)
      : problem_(std::move(problem)),
        time_loop_(plan, problem_.dof()),
        laws_(impact_laws(problem_)),
        constrained_(problem_.system, laws_),
        free_stepper_(integrator.stepper(problem_.system, plan)),
        constrained_stepper_(integrator.stepper(constrained_.system(), plan)),
        is_suppressed_(laws_.size(), false),
        from_(problem_.start),
        v_before_(problem_.start.v) {}
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void advance(Recorder<Dof>& out) {
    start(problem_.start);
    steps_ = time_loop_.run(*this, problem_.start, out);
  }

  model::Work work() const {
    model::Work work;
    work.steps = steps_;
    work.event_searches = searches_;
    free_stepper_->add_work(work);
    constrained_stepper_->add_work(work);
    return work;
  }

  AnyStepper<Dof>& stepper() {
    return constrained_.is_any_active() ? *constrained_stepper_ : *free_stepper_;
  }

  // True where nothing can have happened between the two ends of a step.
  bool is_quiet(const State& before, const State& now) {
    const double length = now.t - before.t;
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (constrained_.is_any_active() && constrained_.is_active(i)) {
        if (!(constrained_.contact_force(i, now) >= 0.0)) return false;
      } else if (!GapCubic(sample(i, 0.0, before), sample(i, length, now)).stays_above(0.0)) {
        return false;
      }
    return true;
  }

  // Everything that happens between `before` and `now`, the end of the step as it would be without
  // it.
  Handled handle(const State& before, State& now, Recorder<Dof>& out) {
    const double t1 = now.t;
    is_suppressed_.assign(is_suppressed_.size(), false);
    from_ = before;
    int events = 0;
    while (true) {
      if (stepper().failed()) return ended(out.fail_step(t1, stepper().failure()));
      if (!now.u.allFinite() || !now.v.allFinite()) return ended(out.fail_diverged(t1));
      const auto event = first_event(now);
      if (!event) break;
      if (++events > most_events)
        return ended(out.fail("too-many-impacts", from_.t, "more than 1000 impacts in one step"));
      if (!apply(*event, t1, out)) return Handled::ended;
      stepper().restart(from_);
      now = from_;
      if (t1 > from_.t) now = stepper().partial(from_, t1 - from_.t);
      now.t = t1;
    }
    if (events == 0) return Handled::unchanged;
    return finish_step(now, out) ? Handled::changed : Handled::ended;
  }

 private:
  struct Event {
    double s;
    std::size_t contact;
    bool is_release;
  };

  static Handled ended(bool) { return Handled::ended; }

  GapSample sample(std::size_t i, double s, const State& x) const {
    return {s, laws_[i].contact.gap_at(x.u), laws_[i].contact.gap_rate(x.v)};
  }

  void start(const State& now) {
    searches_ = 0;
    free_stepper_->reset();
    constrained_stepper_->reset();
    constrained_.deactivate_all();
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (const auto at = sample(i, 0.0, now); at.g == 0.0 && at.rate == 0.0)
        activate_if_pressed(i, now);
    stepper().restart(now);
  }

  // A closed contact whose gap rate is 0 becomes active if the free motion would close it.
  void activate_if_pressed(std::size_t i, const State& now) {
    if (!(constrained_.contact_force(i, now) > 0.0)) return;
    constrained_.activate(i, now.u);
    constrained_stepper_->rebuild();
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
      if (constrained_.is_any_active()) constrained_stepper_->rebuild();
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
  TimeLoop<Dof> time_loop_;
  std::vector<ImpactLaw<Dof>> laws_;
  ConstrainedSystem<Dof> constrained_;
  std::unique_ptr<AnyStepper<Dof>> free_stepper_, constrained_stepper_;
  std::vector<bool> is_suppressed_;
  State from_;
  Vector v_before_;
  long long steps_ = 0, searches_ = 0;
};

template Row row<EventDriven>();

}  // namespace clackers::methods
