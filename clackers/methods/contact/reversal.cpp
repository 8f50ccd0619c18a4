#include <memory>
#include <utility>

#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/stepping/time_loop.hpp"

namespace clackers::methods {

struct Reversal {
  static constexpr std::string_view name = "reversal";
  static constexpr std::string_view summary =
      "velocities reversed at the end of the step in which a contact is penetrated";
  static constexpr std::string_view card =
      R"(Velocities reversed at the end of the step, as a code does that looks at a contact only there:
where a step ends with

    g = b . u1 - gap < 0 and b . v1 < 0,

Newton's law changes the velocity: M [v1(+) - v1(-)] = sum_j b_j P_j with

    0 <= b_j . v1(+) + eta_j b_j . v1(-) _|_ P_j >= 0

for all contacts j that are closed or violated there and do not separate. The penetration stays
as it is. Contacts with linearly dependent b_j in one step end the run.

Order       1 of the upper envelope whatever the integrator's; errors of neighbouring steps
            scatter.
Stability   that of the integrator.
Dissipation none in kinetic energy with eta = 1; the energy of the penetration is wrong at
            random.
Memory      what the integrator remembers is dropped at each impact.
Rest        none: a pressed contact has an impact in each step and sinks with the speed
            (1 - eta)/(1 + eta) A h/2, A the acceleration that presses it.
Cost        two products a contact and step.
Source      common practice; the order is the position of the impact in its step, known to h.
)";

  Claim claim(const Facts&) const { return {Behaviour::irregular, 1.0, {}}; }
  /// To adaptive ones.
  std::optional<Objection> objection_to(const Facts& method) const {
    if (!method.is_adaptive) return std::nullopt;
    return Objection{
        method.name +
            ": reversal errs by the step in which an impact falls, and an adaptive "
            "integrator chooses its steps without regard to impacts. Use event-driven.",
        "integrator-not-taken"};
  }
  std::optional<Objection> objection(const Facts& method,
                                     const model::ImpactProblem<>& problem) const {
    return objection_to_closed_contacts(method.name, problem);
  }
  double contact_time(const model::ImpactProblem<>&) const { return 0.0; }

  template <int Dof>
  class Loop;
};

/// A run with end-of-step reversal.
template <int Dof>
class Reversal::Loop {
 public:
  using State = model::State<Dof>;

  Loop(const Integrator& integrator, const Reversal&, model::ImpactProblem<Dof> problem,
       const StepPlan& plan)
      : problem_(std::move(problem)),
        time_loop_(plan, problem_),
        contacts_(problem_),
        stepper_(integrator.stepper(problem_.system, plan)),
        v_before_(problem_.start.v),
        impulses_(contacts_.no_impulses()) {
    closed_.reserve(contacts_.size());
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void advance(Recorder<Dof>& out) {
    stepper_->reset();
    stepper_->restart(problem_.start);
    steps_ = time_loop_.run(*this, problem_.start, out);
  }

  model::Work work() const { return work_of(steps_, 0, *stepper_); }

  AnyStepper<Dof>& stepper() { return *stepper_; }

  bool is_open() const { return true; }

  bool is_quiet(const State&, const State& now) const {
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (contacts_.gap(i, now.u) < 0.0 && contacts_.gap_rate(i, now.v) < 0.0) return false;
    return true;
  }

  Handled handle(const State&, State& now, Recorder<Dof>& out) {
    closed_.clear();
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (contacts_.gap(i, now.u) <= contacts_.rounding(i, now.u) &&
          contacts_.gap_rate(i, now.v) <= contacts_.rate_rounding(i, now.v))
        closed_.push_back(i);
    v_before_ = now.v;
    if (const auto no = contacts_.impact(closed_, now.v, impulses_)) {
      out.fail(no->code, now.t, no->sentence);
      return Handled::ended;
    }
    for (const auto i : closed_)
      if (const double impulse = impulses_[static_cast<Eigen::Index>(i)]; impulse > 0.0)
        if (!out.impact(now, static_cast<int>(i), v_before_, impulse)) return Handled::ended;
    stepper_->restart(now);
    return Handled::changed;
  }

 private:
  model::ImpactProblem<Dof> problem_;
  TimeLoop<Dof> time_loop_;
  ContactSet<Dof> contacts_;
  std::unique_ptr<AnyStepper<Dof>> stepper_;
  model::Vector<Dof> v_before_;
  Eigen::VectorXd impulses_;
  std::vector<std::size_t> closed_;
  long long steps_ = 0;
};

template Row row<Reversal>();

}  // namespace clackers::methods
