#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/contact/impact_law.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"
#include "clackers/methods/time_loop.hpp"
#include "clackers/numerics/roots.hpp"

namespace clackers::methods {

/// A linear one-sided spring in place of each contact, in the integrator's own equilibrium:
///
///     M a + C v + K u + p(u) = f(t),   p = sum_j stiffness_j min(g_j, 0) b_j,   g_j = b_j . u -
///     gap_j
///
/// solved by Newton's iteration where the integrator is implicit in u. A contact lasts
/// pi sqrt(m_e / stiffness), m_e = 1 / (b . M^-1 b). It is elastic and models
/// eta = 1 alone. An impact is reported at the first touch of each contact, located on the step
/// map, with equal velocities before and after and no impulse: the force acts later, over the
/// contact time. The default stiffness of a contact is 1e4 times the diagonal stiffness of the
/// first degree of freedom in its row, or more: so much that a contact lasts at most a fortieth of
/// the shortest period of a mass in its row, alone on its springs. A softer contact lets the fast
/// mass bounce where the true masses do not collide.
///
/// Order       none: the error comes to stand at the contact time, of order stiffness^(-1/2).
/// Stability   that of the integrator with the stiffness of the closed contact.
/// Dissipation that of the integrator; energy is created or lost where a contact lasts few steps.
/// Memory      that of the integrator.
/// Cost        one to three factorizations a step.
/// Source      P. Wriggers, Computational Contact Mechanics, 2nd ed., Springer (2006).
struct Penalty {
  static constexpr std::string_view name = "penalty";
  static constexpr std::string_view summary =
      "a linear one-sided spring in place of each contact, as in finite-element codes";
  static const std::vector<Field<Penalty>>& fields();

  /// [N/m], > 0; NaN: the default above.
  double stiffness = std::numeric_limits<double>::quiet_NaN();

  /// Throws InputError unless 0 < stiffness < infinity, or NaN.
  void validate() const;
  Claim claim(const Facts& integrator) const;
  std::optional<Objection> objection(const std::string& who,
                                     const model::ImpactProblem<>& problem) const;
  /// The shortest of the contacts' [s]; 0 without contacts.
  double contact_time(const model::ImpactProblem<>& problem) const;
  /// Of each contact [N/m].
  template <int Dof>
  std::vector<double> stiffnesses(const model::ImpactProblem<Dof>& problem) const;

  template <class Integrator, int Dof>
  class TimeLoop;
};

/// The problem with springs in its system; the contacts stay to be looked at.
template <int Dof>
model::ImpactProblem<Dof> with_springs(model::ImpactProblem<Dof> problem,
                                       std::vector<double> stiffnesses);

/// A run with penalty springs.
template <class Integrator, int Dof>
class Penalty::TimeLoop {
 public:
  using Stepper = typename Integrator::template Stepper<Dof>;
  using State = model::State<Dof>;

  TimeLoop(const Integrator& integrator, const Penalty& penalty,
           const model::ImpactProblem<Dof>& rigid, const StepPlan& plan)
      : problem_(with_springs(rigid, penalty.stiffnesses(rigid))),
        plan_(plan),
        stepper_(integrator, problem_.system, plan.h),
        at_(problem_.start) {
    touches_.reserve(problem_.contacts.size());
  }
  TimeLoop(const TimeLoop&) = delete;
  TimeLoop& operator=(const TimeLoop&) = delete;

  void advance(Recorder<Dof>& out) {
    stepper_.reset();
    searches_ = 0;
    steps_ = time_loop(stepper_, plan_, problem_.start, out,
                       [&](const State& before, State& now, bool is_stepped) {
                         return report(before, now, is_stepped, out);
                       });
  }

  model::Work work() const {
    model::Work work;
    work.steps = steps_;
    work.event_searches = searches_;
    stepper_.add_work(work);
    return work;
  }

 private:
  struct Touch {
    double s;
    int contact;
  };

  // Reports the contacts first touched in this step, in order of time.
  bool report(const State& before, State& now, bool is_stepped, Recorder<Dof>& out) {
    touches_.clear();
    for (std::size_t i = 0; i < problem_.contacts.size(); ++i) {
      const auto& contact = problem_.contacts[i];
      const double g0 = contact.gap_at(before.u), g1 = contact.gap_at(now.u);
      if (!(g0 >= 0.0 && g1 < 0.0)) continue;
      // The step is looked into from its start, and taken again below as it was.
      if (touches_.empty() && is_stepped) stepper_.undo();
      const double length = now.t - before.t;
      const auto bracket =
          numerics::shrink([&](double s) { return contact.gap_at(stepper_.partial(before, s).u); },
                           {0.0, g0, length, g1}, std::numeric_limits<double>::epsilon() * length);
      touches_.push_back({bracket.a, static_cast<int>(i)});
      ++searches_;
    }
    if (touches_.empty()) return true;
    std::sort(touches_.begin(), touches_.end(),
              [](const Touch& one, const Touch& other) { return one.s < other.s; });
    for (const auto& [s, contact] : touches_) {
      at_ = before;
      if (s > 0.0) at_ = stepper_.partial(before, s);
      at_.t = std::min(before.t + s, now.t);
      if (!out.impact(at_, contact, at_.v, 0.0)) return false;
    }
    if (is_stepped) {
      const double t1 = now.t;
      now = before;
      stepper_.step(now);
      now.t = t1;
    }
    return stepper_.failed() ? out.fail_step(now.t, stepper_.failure()) : true;
  }

  model::ImpactProblem<Dof> problem_;
  StepPlan plan_;
  Stepper stepper_;
  State at_;
  std::vector<Touch> touches_;
  long long steps_ = 0, searches_ = 0;
};

}  // namespace clackers::methods
