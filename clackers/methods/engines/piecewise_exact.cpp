#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/methods/engines/constrained_motion.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/numerics/double_double.hpp"

namespace clackers::methods {

namespace {

using numerics::FirstRoot;

// A quantity is noise below this share of the amplitude that it has in other states of the motion.
constexpr double noise = 1e3 * std::numeric_limits<double>::epsilon();
// Over the frequency of the fastest mode: the shortest step to a first contact.
constexpr double shortest_step = 2e-8;

constexpr const char* no_modes =
    "the free motion has equal eigenvalues of coupled modes and is no sum of modes";

}  // namespace

struct PiecewiseExact {
  static constexpr std::string_view name = "piecewise-exact";
  static constexpr std::string_view summary =
      "closed-form modal motion between impacts, the first contact proven";
  static constexpr std::string_view card =
      R"(The motion in closed form from one event to the next, for M a + C v + K u = 0 with contacts
g_j = b_j . u - gap_j >= 0 and Newton's law. Between events

    u = rest + sum_j shape_j y_j + rate_shape_j y_j',   y_j'' + 2 sigma_j y_j' + omega_j^2 y_j = 0

with the modes of the structure, complex ones where the damping couples them. The next event is the
first zero of any open gap or of any contact force, proven: from a known state, bounds of the
second and third derivative exclude a zero up to a point, the next known state is there, and
modes that are fast and too small to close the gap count only by their amplitude. A dip of a gap
below 0 may remain unnoticed where it is less than 1e-16 of the amplitudes. All contacts that are
closed together take part in one impact, 0 <= b_j.v(+) + eta b_j.v(-) _|_ P_j >= 0.

A contact is an active constraint when it is closed, its gap rate is 0 and the others would
close it, until its force is negative: after an impact with eta = 0, from a start at rest, or
at rest. States are delivered after each step, which the motion does not depend on.

Order       none: exact but for rounding, at every step.
Stability   for every h.
Dissipation none but that of the structure.
Memory      none.
Rest        when impacts have accumulated, so that the gap would rise by less than its rounding before
            the next one; what is left out is shorter than 1e-6 of a period.
Cost        a sine, a cosine and an exponential a mode for each state, and about 15 such an impact,
            at any ratio of the frequencies; an eigenvalue problem for each set of active contacts.
Source      A. Soroushian, G. Ahmadi, S. Amiri, Sci. Iran. B (2018), for the sums of modes between
            impacts; V. Acary, B. Brogliato, Numerical Methods for Nonsmooth Dynamical Systems,
            Springer (2008), chapter 8, for events.
)";

  static constexpr int most_idle_events = 1000;  ///< without time passing; a message repeats it

  Facts facts() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {.name = specification(*this),
            .smooth_order = infinity,
            .is_linear_only = true,
            .stability_limit = infinity,
            .radius_at_infinity = 1.0,
            .through_impacts = {Behaviour::exact, 0.0, {}}};
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    const auto who = std::string(name);
    const auto& s = problem.system;
    if (s.nonlinear)
      return Objection{who +
                           ": the problem has a nonlinear force, and the motion is known in closed "
                           "form for linear ones only. Use a method that steps, such as rk4.",
                       "linear-only"};
    if (s.add_load)
      return Objection{who +
                           ": the problem has a load f(t), and the motion is known in closed form "
                           "only without a load. Use a method that steps, such as rk4.",
                       "linear-only"};
    if (!numerics::ModalSystem::make(s.mass, s.damping, s.stiffness))
      return Objection{who + ": " + no_modes + ". Use a method that steps, such as rk4.",
                       "linear-only"};
    return objection_to_closed_contacts(who, problem);
  }

  template <int Dof>
  class Loop;
};

/// A run from event to event.
template <int Dof>
class PiecewiseExact::Loop {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  Loop(const PiecewiseExact&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : problem_(std::move(problem)),
        plan_(plan),
        contacts_(problem_),
        motions_(problem_.system.mass, problem_.system.damping, problem_.system.stiffness,
                 rows_of(problem_), gaps_of(problem_)),
        now_(problem_.start),
        output_(problem_.start),
        v_before_(problem_.start.v),
        force_(problem_.start.v),
        u_size_(problem_.start.u),
        v_size_(problem_.start.v),
        is_active_(contacts_.size(), false),
        phases_(contacts_.size(), Phase::open),
        acceleration_noise_(contacts_.size(), 0.0),
        accelerations_(Eigen::VectorXd::Zero(Eigen::Index(contacts_.size()))),
        impulses_(accelerations_) {}
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void advance(Recorder<Dof>& out) {
    start();
    if (!out.append(now_) || !settle(out)) return;
    while (true) {
      const auto event = next_event();
      if (event.status == FirstRoot::Status::undecided) {
        out.fail_diverged(now_.t);
        return;
      }
      const bool is_last = event.status == FirstRoot::Status::none;
      const auto at = time_ + numerics::DoubleDouble{event.s, 0.0};
      if (!deliver(is_last ? std::numeric_limits<double>::infinity() : at.hi, out) || is_last)
        return;
      idle_events_ = at.hi > time_.hi ? 0 : idle_events_ + 1;
      sample(event.s, now_);
      time_ = at;
      now_.t = std::min(at.hi, plan_.end);
      if (!happen(event, out) || !settle(out)) return;
    }
  }

  model::Work work() const {
    model::Work work;
    work.steps = next_ - 1;
    work.force_evaluations = evaluations_;
    work.event_searches = searches_;
    return work;
  }

 private:
  // What an inactive contact does at the beginning of a flight.
  enum class Phase {
    open,       // its gap is watched
    departing,  // closed and without speed; its gap is watched from where it is surely open
    idle,       // nothing but rounding moves it
    pressed     // it has to be active
  };
  struct Event {
    FirstRoot::Status status = FirstRoot::Status::none;
    double s = 0.0;
    std::size_t contact = 0;
  };

  static Eigen::MatrixXd rows_of(const model::ImpactProblem<Dof>& problem) {
    Eigen::MatrixXd rows(problem.contacts.size(), problem.dof());
    for (std::size_t i = 0; i < problem.contacts.size(); ++i)
      rows.row(Eigen::Index(i)) = problem.contacts[i].direction;
    return rows;
  }
  static Eigen::VectorXd gaps_of(const model::ImpactProblem<Dof>& problem) {
    Eigen::VectorXd gaps(problem.contacts.size());
    for (std::size_t i = 0; i < problem.contacts.size(); ++i)
      gaps[Eigen::Index(i)] = problem.contacts[i].gap;
    return gaps;
  }
  static std::span<double> span(Vector& x) { return {x.data(), std::size_t(x.size())}; }

  void start() {
    now_ = problem_.start;
    time_ = {now_.t, 0.0};
    next_ = 1;
    idle_events_ = 0;
    evaluations_ = searches_ = 0;
    is_release_ = rebounds_ = false;
    std::fill(is_active_.begin(), is_active_.end(), false);
    motion_ = motions_.of(is_active_);
    begin_flight();
    measure_amplitudes();
    closed_.clear();
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (contacts_.gap(i, now_.u) <= contacts_.rounding(i, now_.u)) closed_.push_back(i);
  }

  void begin_flight() {
    states_.resize(motion_->modes.modes().size());
    motion_->to_modes(span(now_.u), span(now_.v), states_);
  }
  // With the constraints that are active now. False: the run ends.
  bool begin_flight(Recorder<Dof>& out) {
    if (motion_->is_active != is_active_) {
      const auto* motion = motions_.of(is_active_);
      if (motion == nullptr) return out.fail("linear-only", now_.t, no_modes);
      motion_ = motion;
    }
    begin_flight();
    return true;
  }

  void sample(double s, State& to) {
    motion_->sample(states_, s, span(to.u), span(to.v));
    ++evaluations_;
  }

  // The states of the plan before `t`.
  bool deliver(double t, Recorder<Dof>& out) {
    for (; next_ <= plan_.total; ++next_) {
      output_.t = plan_.time(next_);
      if (!(output_.t < t)) return true;
      sample((output_.t - time_.hi) - time_.lo, output_);
      if (!out.append(output_)) return false;
    }
    return true;
  }

  Event next_event() {
    Event first;
    double until = (plan_.end - time_.hi) - time_.lo;
    const double fastest = std::max(motion_->modes.fastest(), 1e-3 / std::max(until, 1e-300));
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (phases_[i] == Phase::idle) continue;
      const auto& form = motion_->forms[i];
      const double from = phases_[i] == Phase::departing ? departure(form) : 0.0;
      if (from >= until) continue;
      ahead_.begin(motion_->modes, form, states_, 1.0);
      const auto counted = [&](double s) {
        ++evaluations_;
        return ahead_(s);
      };
      const auto root = numerics::first_root(counted, from, until, shortest_step / fastest,
                                             std::numeric_limits<int>::max());
      if (root.status == FirstRoot::Status::undecided) return {root.status};
      if (root.status == FirstRoot::Status::none) continue;
      first = {root.status, root.s, i};
      until = root.s;
    }
    if (first.status == FirstRoot::Status::found) ++searches_;
    return first;
  }

  // Up to where a closed gap without speed is surely open: with a and j its second and third
  // derivative, g >= s^2/2 (a - B s/3) where |g'''| <= B, and for a = 0 g >= s^3/6 (j - B s/4) where
  // |g''''| <= B.
  double departure(const numerics::ModalForm& form) const {
    const auto& modes = motion_->modes;
    const double second = form.derivative(states_, 2);
    if (second > noise * form.derivative_bound(modes, states_, 2))
      return 1.5 * second / form.derivative_bound(modes, states_, 3);
    return 2.0 * form.derivative(states_, 3) / form.derivative_bound(modes, states_, 4);
  }

  // What happens at now_. False: the run ends.
  bool happen(const Event& event, Recorder<Dof>& out) {
    constexpr auto too_many = "more than 1000 impacts at one instant";
    if (idle_events_ > most_idle_events) return out.fail("too-many-impacts", now_.t, too_many);
    find_closed(event);
    is_release_ = is_active_[event.contact];
    rebounds_ = false;
    if (closed_.size() == 1 && !is_release_ && contacts_.restitution(event.contact) == 1.0)
      return rebound(event.contact, out);
    measure_amplitudes();
    if (is_release_) {
      is_active_[event.contact] = false;
      return true;
    }
    // An impact may close a contact that has been separating.
    for (int i = 0; i < most_idle_events; ++i) {
      closing_.clear();
      bool is_any = false;
      for (const auto j : closed_) {
        const double rate = contacts_.gap_rate(j, now_.v);
        if (rate <= noise_of_rate(j)) closing_.push_back(j);
        is_any = is_any || rate < -noise_of_rate(j);
      }
      if (!is_any) return true;
      v_before_ = now_.v;
      if (const auto no = contacts_.impact(closing_, now_.v, impulses_))
        return out.fail(no->code, now_.t, no->sentence);
      for (const auto j : closing_) {
        const double impulse = impulses_[Eigen::Index(j)];
        if (impulse * contacts_.inverse_effective_mass(j) > noise_of_rate(j) &&
            !out.impact(now_, static_cast<int>(j), v_before_, impulse))
          return false;
      }
    }
    return out.fail("too-many-impacts", now_.t, too_many);
  }

  // An elastic impact at the one contact that is closed.
  bool rebound(std::size_t i, Recorder<Dof>& out) {
    const double rate = contacts_.gap_rate(i, now_.v);
    rebounds_ = rate < 0.0;
    // Grazing: the next flight begins here, without an impulse.
    if (!rebounds_) {
      measure_amplitudes();
      return true;
    }
    const double impulse = -2.0 * rate / contacts_.inverse_effective_mass(i);
    v_before_ = now_.v;
    now_.v += impulse * contacts_.response().velocity.col(Eigen::Index(i));
    return out.impact(now_, static_cast<int>(i), v_before_, impulse);
  }

  // The contacts closed at an event: its own, active and idle ones, and those that may be closed as
  // far as rounding can tell.
  void find_closed(const Event& event) {
    closed_.clear();
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (i == event.contact || is_active_[i] || phases_[i] == Phase::idle ||
          contacts_.gap(i, now_.u) <= motion_->forms[i].rounding(motion_->modes, states_, event.s))
        closed_.push_back(i);
  }

  // Amplitudes of the flight that ends: beside them noise is seen as such.
  void measure_amplitudes() {
    for (Eigen::Index i = 0; i < u_size_.size(); ++i) u_size_[i] = std::abs(motion_->rest[i]);
    v_size_.setZero();
    motion_->modes.add_amplitudes(states_, span(u_size_), span(v_size_));
  }
  double noise_of_rate(std::size_t i) const {
    return noise * contacts_.row(i).cwiseAbs().dot(v_size_);
  }

  // The flight from now_: which contacts are active, and what the other closed ones do. False: the run
  // ends.
  bool settle(Recorder<Dof>& out) {
    std::fill(phases_.begin(), phases_.end(), Phase::open);
    if (rebounds_) return begin_flight(out);
    find_accelerations();
    resting_.clear();
    for (const auto i : closed_)
      if (is_at_rest(i)) resting_.push_back(i);
    // The force of a released contact is 0; the others go on as they are.
    if (!is_release_ && !activate(out)) return false;
    while (true) {
      if (!begin_flight(out)) return false;
      bool is_changed = false;
      for (const auto i : resting_) {
        if (is_active_[i]) continue;
        phases_[i] = phase_of(i);
        if (phases_[i] != Phase::pressed) continue;
        phases_[i] = Phase::open;
        is_active_[i] = is_changed = true;
      }
      if (!is_changed) return true;
    }
  }

  // Accelerations of the closed gaps without contact forces.
  void find_accelerations() {
    const auto& s = problem_.system;
    force_.noalias() = -(s.stiffness * now_.u);
    force_.noalias() -= s.damping * now_.v;
    const Vector size = s.stiffness.cwiseAbs() * u_size_ + s.damping.cwiseAbs() * v_size_;
    for (const auto i : closed_) {
      const auto response = contacts_.response().velocity.col(Eigen::Index(i));
      accelerations_[Eigen::Index(i)] = response.dot(force_);
      acceleration_noise_[i] = noise * response.cwiseAbs().dot(size);
    }
  }

  // Without speed, or with so little that the gap would rise by less than its rounding.
  bool is_at_rest(std::size_t i) const {
    const double rate = contacts_.gap_rate(i, now_.v);
    if (rate <= noise_of_rate(i)) return true;
    const double acceleration = accelerations_[Eigen::Index(i)];
    const double terms =
        contacts_.row(i).cwiseAbs().dot(u_size_) + std::abs(problem_.contacts[i].gap);
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * terms;
    return acceleration < -acceleration_noise_[i] && rate * rate <= -2.0 * acceleration * rounding;
  }

  // Those of the resting contacts that the motion without them would close.
  bool activate(Recorder<Dof>& out) {
    std::fill(is_active_.begin(), is_active_.end(), false);
    if (resting_.empty()) return true;
    if (const auto no = contacts_.solve(contacts_.response(), resting_, accelerations_, impulses_))
      return out.fail(no->code, now_.t, no->sentence);
    for (const auto i : resting_)
      is_active_[i] =
          impulses_[Eigen::Index(i)] * contacts_.inverse_effective_mass(i) > acceleration_noise_[i];
    return true;
  }

  Phase phase_of(std::size_t i) const {
    const auto& form = motion_->forms[i];
    const auto& modes = motion_->modes;
    double floor = acceleration_noise_[i];
    for (int k = 2; k <= 3; ++k) {
      const double derivative = form.derivative(states_, k);
      floor = std::max(floor, noise * form.derivative_bound(modes, states_, k));
      if (derivative > floor) return Phase::departing;
      if (derivative < -floor) return Phase::pressed;
      floor *= modes.fastest();
    }
    return Phase::idle;
  }

  const model::ImpactProblem<Dof> problem_;
  StepPlan plan_;
  ContactSet<Dof> contacts_;
  ConstrainedMotions motions_;
  const ConstrainedMotion* motion_ = nullptr;  // of this flight
  std::vector<numerics::ModalState> states_;   // at its beginning
  numerics::FormAhead ahead_;
  numerics::DoubleDouble time_;  // of its beginning
  State now_, output_;
  Vector v_before_, force_, u_size_, v_size_;
  std::vector<bool> is_active_;
  std::vector<Phase> phases_;
  std::vector<double> acceleration_noise_;
  std::vector<std::size_t> closed_, closing_, resting_;
  Eigen::VectorXd accelerations_, impulses_;
  bool is_release_ = false, rebounds_ = false;
  int idle_events_ = 0;
  long long next_ = 1, evaluations_ = 0, searches_ = 0;
};

template Row row<PiecewiseExact>();

}  // namespace clackers::methods
