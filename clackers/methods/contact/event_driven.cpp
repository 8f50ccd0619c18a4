#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "clackers/methods/contact/constrained_system.hpp"
#include "clackers/methods/contact/crossing.hpp"
#include "clackers/methods/contact/friction_rows.hpp"
#include "clackers/methods/contact/impact_resolution.hpp"
#include "clackers/methods/contact/stick_slip.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/stepping/time_loop.hpp"

namespace clackers::methods {

struct EventDriven {
  static constexpr std::string_view name = default_treatment;
  static constexpr bool takes_friction = true;
  static constexpr std::string_view summary =
      "impacts located inside the step, the rest of the step completed after them";
  static constexpr std::string_view card =
      R"(Impacts located inside the step. Contacts j with gaps g_j and Newton's law,

    g_j = b_j . u - gap_j >= 0,   M [v(+) - v(-)] = sum_j b_j P_j,
    0 <= b_j . v(+) + eta_j b_j . v(-) _|_ P_j >= 0

have an impact where the step map crosses g_j = 0 from above with b_j . v < 0; the state there
is that of the integrator's partial step. All contacts that are closed there, within rounding,
and do not separate take part in it at once, so nothing depends on their numbers. A neighbour
that touches at rest takes its part of the momentum, and so do neighbours that close so soon after
that the errors of the run so far cannot tell the instants apart. The
integrator is restarted from v(+) and completes the rest of the step, so output stays on the grid. Crossings are looked for whenever
the cubic through gap and gap rate at both ends of the step does not stay open, also when both
ends are. A crossing with b_j . v >= 0 is grazing: the integrator is restarted there without an
impulse. A step of an adaptive integrator ends at the event, located on the dense output; the state
there is only in the report of the impact.

Contacts that are closed with gap rate 0, after an impact with eta = 0 or from a start at rest,
are active constraints where their accelerations A and forces F say so: 0 <= A _|_ F >= 0,
solved for all of them. A contact is let go where its force changes sign, looked for at the ends of
steps, and of an adaptive integrator at every eighth of them. Contacts that are
closed at once with linearly dependent b_j end the run, and so do more than 1000 events in one
step.

A row of dry friction slides, which is a force, or sticks, which is a constraint: it stops where the
cubic through sliding speed and its rate, and then the step map, cross 0, and sticks there if the
force that holds it is within its limit. It slides where that force crosses the limit, looked for at
the ends of steps. Friction of a contact does so while the contact is active; at an impact with the
impulse P it has the impulse that ends the slip, at most mu P. Rows of friction share no mass with
contacts and each other, and only loads press on the contacts that have friction.

Order       that of the integrator.
Stability   that of the integrator.
Dissipation none at impacts with eta = 1.
Memory      what the integrator remembers is dropped at each impact.
Rest        impacts with eta < 1 of a contact that is pressed, A < 0, accumulate; the last of them
            is taken with eta = 0, after which the contact is active: where the next flight would
            rise by less than rounding of the gap, or the closing speed is below 2^-26 of the
            largest one of the run and the next flight shorter than 2^-16 h, or 2^-16 of the run
            of an adaptive integrator.
Cost        two products a contact and step; about ten partial steps an impact, seventy more where
            contacts that share a mass close in one step.
Source      L. F. Shampine, I. Gladwell, R. W. Brankin, ACM Trans. Math. Softw. 17, 11-25 (1991).
)";

  static constexpr int most_events = 1000;  ///< in one step; a message and the card repeat it

  Claim claim(const Facts& integrator) const {
    return {Behaviour::proper, integrator.smooth_order, {}};
  }
  std::optional<Objection> objection(const Facts& method,
                                     const model::ImpactProblem<>& problem) const {
    if (auto no = objection_to_stick_slip(method.name, problem)) return no;
    return objection_to_closed_contacts(method.name, problem);
  }
  double contact_time(const model::ImpactProblem<>&) const { return 0.0; }

  template <int Dof>
  class Loop;
};

/// A run with located impacts, stick and slip. While nothing is near a contact, none is active and
/// nothing rubs, a step is the integrator's own and a few comparisons; all else is off that path.
template <int Dof>
class EventDriven::Loop {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  Loop(const Integrator& integrator, const EventDriven&, model::ImpactProblem<Dof> problem,
       const StepPlan& plan)
      : problem_(std::move(problem)),
        time_loop_(plan, problem_),
        contacts_(problem_),
        with_frictions_(with_frictions(problem_)),
        rows_(with_frictions_ ? *with_frictions_ : contacts_),
        constrained_(problem_.system, rows_),
        stick_slip_(problem_, rows_, constrained_),
        resolution_(contacts_, plan, problem_.start),
        h_(plan.is_adaptive() ? plan.end - plan.start : plan.h),
        is_suppressed_(contacts_.size(), false),
        is_struck_(contacts_.size(), false),
        from_(problem_.start),
        later_(problem_.start),
        v_before_(problem_.start.v),
        impulses_(contacts_.no_impulses()),
        is_adaptive_(plan.is_adaptive()) {
    for (auto* list : {&closed_, &before_, &captured_}) list->reserve(rows_.size());
    if (!problem_.frictions.empty())
      problem_.system.add_load = [this, load = problem_.system.add_load](double t,
                                                                         std::span<double> force) {
        if (load) load(t, force);
        stick_slip_.add_forces(force);
      };
    free_stepper_ = integrator.stepper(problem_.system, plan);
    constrained_stepper_ = integrator.stepper(constrained_.system(), plan);
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void advance(Recorder<Dof>& out) {
    steps_ = 0;
    if (start(out))
      steps_ = time_loop_.run(*this, problem_.start, out);
    else
      out.append(problem_.start);
  }

  model::Work work() const {
    return work_of(steps_, searches_ + stick_slip_.searches(), *free_stepper_,
                   *constrained_stepper_);
  }

  AnyStepper<Dof>& stepper() {
    return constrained_.is_any_active() ? *constrained_stepper_ : *free_stepper_;
  }

  bool is_open() const { return !constrained_.is_any_active(); }
  void pass(std::size_t count, auto&& before) { resolution_.pass(count, before); }

  // True where nothing can have happened between the two ends of a step.
  bool is_quiet(const State& before, const State& now) {
    pass(1, [&](std::size_t) -> const State& { return before; });
    const double length = now.t - before.t;
    // The longer steps of an adaptive integrator may hold a release and the closing after it.
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (constrained_.is_active(i)
              ? is_adaptive_ || !(constrained_.release_margin(i, now) >= 0.0)
              : !GapCubic(sample(i, 0.0, before), sample(i, length, now)).stays_above(0.0))
        return false;
    return stick_slip_.is_quiet(before, now);
  }

  // Everything that happens between `before` and `now`, the end of the step as it would be without
  // it.
  Handled handle(const State& before, State& now, Recorder<Dof>& out) {
    const double t1 = now.t;
    is_suppressed_.assign(is_suppressed_.size(), false);
    is_struck_.assign(is_struck_.size(), false);
    from_ = before;
    if (!(before.t < counted_until_)) {
      counted_until_ = t1;
      counted_ = 0;
    }
    bool is_changed = false;
    while (true) {
      if (stepper().failed()) return ended(out.fail_step(t1, stepper().failure()));
      if (!now.u.allFinite() || !now.v.allFinite()) return ended(out.fail_diverged(t1));
      const auto event = first_event(now);
      if (!event) break;
      if (++counted_ > most_events)
        return ended(out.fail("too-many-impacts", from_.t, "more than 1000 events in one step"));
      if (!apply(*event, now, out)) return Handled::ended;
      is_changed = true;
      resolution_.begin_flight(from_);
      if (is_adaptive_) {
        if (event->kind != Event::Kind::friction && is_suppressed_[event->row])
          continue;  // where the step began
        now = from_;
        stepper().restart(now);
        return Handled::shortened;
      }
      stepper().restart(from_);
      now = from_;
      if (t1 > from_.t) now = stepper().partial(from_, t1 - from_.t);
      now.t = t1;
    }
    if (passes_through(now, is_changed))
      return ended(out.fail("too-many-impacts", from_.t,
                            "impacts accumulate, closer than rounding of the time can separate"));
    if (!is_changed) return Handled::unchanged;
    stepper().go_on(from_, t1 - from_.t, now);
    return Handled::changed;
  }

 private:
  struct Event {
    enum class Kind { impact, release, friction };
    double s;
    std::size_t row;  // a contact, or a row of friction
    Kind kind;
  };

  static Handled ended(bool) { return Handled::ended; }

  GapSample sample(std::size_t i, double s, const State& x) const {
    return {s, contacts_.gap(i, x.u), contacts_.gap_rate(i, x.v)};
  }

  // False: the run ends.
  bool start(Recorder<Dof>& out) {
    searches_ = 0;
    fastest_ = 0.0;
    counted_until_ = problem_.start.t;
    free_stepper_->reset();
    constrained_stepper_->reset();
    constrained_.activate({}, problem_.start.u);
    stick_slip_.begin();
    from_ = problem_.start;
    find_closed();
    std::erase_if(closed_, [&](std::size_t i) { return !is_resting(i, from_.v); });
    if (!decide(from_, out)) return false;
    stepper().restart(from_);
    resolution_.begin(from_);
    return true;
  }

  // Flights shorter than the rounding of time end before they are seen to reverse: going on would let
  // the structure pass through the contact. Without an event in the step it was in one before, which
  // left a contact violated.
  bool passes_through(const State& now, bool has_event) const {
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if ((is_struck_[i] ||
           (!has_event && contacts_.gap(i, from_.u) < -contacts_.rounding(i, from_.u))) &&
          !constrained_.is_active(i) && !is_suppressed_[i] && contacts_.gap_rate(i, now.v) < 0.0 &&
          contacts_.gap(i, now.u) < -contacts_.rounding(i, now.u))
        return true;
    return false;
  }

  // Moves from_ to the later side of an event between it and `now`. False: the run ends.
  bool apply(const Event& event, const State& now, Recorder<Dof>& out) {
    const std::size_t i = event.row;
    const bool is_release = event.kind == Event::Kind::release;
    // In a long step the contact may be pressed again at its end.
    const double soon = event.s + 0x1p-6 * (now.t - from_.t - event.s);
    later_ = is_release && is_adaptive_ ? stepper().partial(from_, soon) : now;
    move_to(event.s, now.t);
    if (event.kind == Event::Kind::friction) {
      before_.assign(constrained_.active().begin(), constrained_.active().end());
      stick_slip_.change(i, from_);
      rebuild();
    } else if (is_release) {
      if (!release(later_, out)) return false;
      if (constrained_.is_active(i)) {
        // Its force only touches 0.
        is_suppressed_[i] = true;
        return true;
      }
    } else if (!(contacts_.gap_rate(i, from_.v) < -contacts_.rate_rounding(i, from_.v))) {
      // Gap and rate of the step map disagree by its error: grazing, where no impulse is defined.
      // Where the motion does not leave this instant, the contact is watched again after the next
      // event, or from the end of the step.
      if (!(event.s > 0.0)) is_suppressed_[i] = true;
      return true;
    } else if (!apply_impact(i, out)) {
      return false;
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

  // The next impact, release or change of friction between from_ and `now`.
  std::optional<Event> first_event(const State& now) {
    const double length = now.t - from_.t;
    std::optional<Event> first;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const bool is_release = constrained_.is_active(i);
      const auto s = is_suppressed_[i] ? closing_time(i, length, now)
                     : is_release      ? release_time(i, length, now)
                                       : impact_time(i, length, now);
      // Of an impact and a release at one instant the impact, which decides all contacts anew.
      const auto kind = is_release ? Event::Kind::release : Event::Kind::impact;
      if (s && (!first || *s < first->s || (*s == first->s && kind < first->kind)))
        first = Event{*s, i, kind};
    }
    const auto change = stick_slip_.first_event(from_, now, stepper());
    if (change && (!first || change->s < first->s))
      first = Event{change->s, change->row, Event::Kind::friction};
    return first;
  }

  std::optional<double> release_time(std::size_t i, double length, const State& now) {
    const double before = constrained_.release_margin(i, from_),
                 after = constrained_.release_margin(i, now);
    if (before < 0.0) return 0.0;
    const auto margin = [&](double s) {
      return constrained_.release_margin(i, stepper().partial(from_, s));
    };
    double last = length, at_last = after;
    constexpr int pieces = 8;
    for (int k = 1; is_adaptive_ && k < pieces && !(at_last < 0.0); ++k)
      if (const double s = k * length / pieces, m = margin(s); m < 0.0) last = s, at_last = m;
    if (!(at_last < 0.0)) return std::nullopt;
    const double unit = std::numeric_limits<double>::epsilon() * length;
    ++searches_;
    return numerics::shrink(margin, {0.0, before, last, at_last}, unit).b;
  }

  // Where a contact that grazed at from_ closes after all, in a long step of an adaptive integrator.
  std::optional<double> closing_time(std::size_t i, double length, const State& now) {
    if (!is_adaptive_ || constrained_.is_active(i)) return std::nullopt;
    const double most = -2.0 * contacts_.rate_rounding(i, from_.v);
    const double before = contacts_.gap_rate(i, from_.v) - most,
                 after = contacts_.gap_rate(i, now.v) - most;
    if (!(contacts_.gap(i, now.u) < -contacts_.rounding(i, now.u)) || !(before > 0.0) ||
        !(after < 0.0))
      return std::nullopt;
    ++searches_;
    return numerics::shrink(
               [&](double s) { return sample(i, s, stepper().partial(from_, s)).rate - most; },
               {0.0, before, length, after}, std::numeric_limits<double>::epsilon() * length)
        .b;
  }

  std::optional<double> impact_time(std::size_t i, double length, const State& now) {
    const auto a = sample(i, 0.0, from_), b = sample(i, length, now);
    const double rounding = std::max(contacts_.rounding(i, from_.u), contacts_.rounding(i, now.u));
    // Violated at the start: closing, the impact is now; opening, it is watched again once open.
    if (a.g < -rounding) return a.rate < 0.0 ? std::optional(0.0) : std::nullopt;
    if (GapCubic(a, b).stays_above(-rounding)) return std::nullopt;
    int budget = 200;  // a graze halves a piece about 26 times before it is rounding, twice each
    ++searches_;
    return first_crossing([&](double s) { return sample(i, s, stepper().partial(from_, s)); }, a, b,
                          rounding, budget);
  }

  // The impulses at from_, where contact `first` closes. False: the run ends.
  bool apply_impact(std::size_t first, Recorder<Dof>& out) {
    find_closed();
    if (!std::ranges::binary_search(closed_, first))
      closed_.insert(std::ranges::lower_bound(closed_, first), first);
    resolution_.add_to(closed_, first, from_, stepper());
    // Contacts that separate take no part.
    std::erase_if(closed_, [&](std::size_t i) {
      return contacts_.gap_rate(i, from_.v) > 0.0 && !is_resting(i, from_.v);
    });
    v_before_ = from_.v;
    captured_.clear();
    for (const auto i : closed_)
      if (ends_in_rest(i)) captured_.push_back(i);
    if (const auto no = contacts_.impact(closed_, from_.v, impulses_, captured_))
      return fail(*no, out);
    stick_slip_.impact(impulses_, from_.v);
    for (const auto i : closed_) {
      const double impulse = impulses_[static_cast<Eigen::Index>(i)];
      if (!(impulse > 0.0)) continue;
      is_struck_[i] = true;
      if (!out.impact(from_, static_cast<int>(i), v_before_, impulse)) return false;
    }
    std::erase_if(closed_, [&](std::size_t i) { return !is_resting_after_impact(i); });
    return decide(from_, out);
  }

  // Whether the impact of contact i, which closes at from_, is the last of those that accumulate; see
  // the card.
  bool ends_in_rest(std::size_t i) {
    const double speed = -contacts_.gap_rate(i, from_.v), eta = contacts_.restitution(i);
    fastest_ = std::max(fastest_, speed);
    const double press = -constrained_.gap_acceleration(i, from_);
    if (!(speed > 0.0 && press > 0.0 && eta < 1.0)) return false;
    const double rebound = eta * speed, flight = 2.0 * rebound / press;
    return 0.25 * rebound * flight <= contacts_.rounding(i, from_.u) ||
           (speed <= 0x1p-26 * fastest_ && flight <= 0x1p-16 * h_);
  }

  // The contacts that hold the structure at from_ let it go. False: the run ends.
  bool release(const State& later, Recorder<Dof>& out) {
    find_closed();
    std::erase_if(closed_, [&](std::size_t i) { return !is_resting(i, from_.v); });
    return decide(later, out);
  }

  // Which of the contacts in closed_, with gap rate 0, become or stay active; `later` see
  // ConstrainedSystem. False: the run ends.
  bool decide(const State& later, Recorder<Dof>& out) {
    before_.assign(constrained_.active().begin(), constrained_.active().end());
    if (const auto no = constrained_.decide(closed_, from_, later)) return fail(*no, out);
    if (!problem_.frictions.empty()) stick_slip_.settle(from_);
    rebuild();
    return true;
  }
  // Where other rows are held than those of before_.
  void rebuild() {
    if (constrained_.is_any_active() && !std::ranges::equal(before_, constrained_.active()))
      constrained_stepper_->rebuild();
  }

  // The contacts closed at from_, also those that close within rounding of its time.
  void find_closed() {
    const double instant = 4.0 * std::numeric_limits<double>::epsilon() * (std::abs(from_.t) + h_);
    closed_.clear();
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const double approach = instant * std::max(0.0, -contacts_.gap_rate(i, from_.v));
      if (constrained_.is_active(i) ||
          contacts_.gap(i, from_.u) <= contacts_.rounding(i, from_.u) + approach)
        closed_.push_back(i);
    }
  }

  // Whether the gap rate of a closed contact is 0: by its constraint, or within rounding.
  bool is_resting(std::size_t i, const Vector& v) const {
    return constrained_.is_active(i) ||
           std::abs(contacts_.gap_rate(i, v)) <= contacts_.rate_rounding(i, v);
  }

  // Newton's law leaves the rate -eta U(-) where there is an impulse.
  bool is_resting_after_impact(std::size_t i) const {
    if (impulses_[static_cast<Eigen::Index>(i)] > 0.0)
      return contacts_.restitution(i) == 0.0 || is_resting(i, v_before_) ||
             std::ranges::binary_search(captured_, i);
    if (!is_resting(i, v_before_)) return false;
    return std::abs(contacts_.gap_rate(i, from_.v) - contacts_.gap_rate(i, v_before_)) <=
           contacts_.rate_rounding(i, v_before_) + contacts_.rate_rounding(i, from_.v);
  }

  bool fail(const Objection& objection, Recorder<Dof>& out) {
    return out.fail(objection.code, from_.t, objection.sentence);
  }

  model::ImpactProblem<Dof> problem_;
  TimeLoop<Dof> time_loop_;
  ContactSet<Dof> contacts_;
  std::optional<ContactSet<Dof>> with_frictions_;
  ContactSet<Dof>& rows_;  // all there are
  ConstrainedSystem<Dof> constrained_;
  StickSlip<Dof> stick_slip_;
  ImpactResolution<Dof> resolution_;
  std::unique_ptr<AnyStepper<Dof>> free_stepper_, constrained_stepper_;
  double h_;
  std::vector<bool> is_suppressed_, is_struck_;  // in this step
  State from_, later_;
  Vector v_before_;
  Eigen::VectorXd impulses_;
  std::vector<std::size_t> closed_, before_, captured_;
  double fastest_ = 0.0;  // largest closing speed of the run
  bool is_adaptive_;
  double counted_until_ = 0.0;  // events are counted until the end of a step as it was begun
  int counted_ = 0;
  long long steps_ = 0, searches_ = 0;
};

template Row row<EventDriven>();

}  // namespace clackers::methods
