#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/methods/contact/impact_law.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"
#include "clackers/methods/time_loop.hpp"

namespace clackers::methods {

/// Velocities reversed at the end of the step, as a code does that looks at a contact only there:
/// where a step ends with
///
///     g = b . u1 - gap < 0 and b . v1 < 0:   b . v1(+) = -eta b . v1(-),   M [v1(+) - v1(-)] = b P
///
/// The penetration stays as it is. Which contacts are reversed is decided by the end of the step as
/// the integrator leaves it; one that starts to close by the impulse of another is looked at again
/// at the end of the next step. Two that share a mass and are reversed in the same step end the run.
///
/// Order       1 of the upper envelope whatever the integrator's; errors of neighbouring steps
///             scatter.
/// Stability   that of the integrator.
/// Dissipation none in kinetic energy with eta = 1; the energy of the penetration is wrong at
///             random.
/// Memory      what the integrator remembers is dropped at each impact.
/// Cost        two products a contact and step.
/// Source      common practice; the order is the position of the impact in its step, known to h.
struct Reversal {
  static constexpr std::string_view name = "reversal";
  static constexpr std::string_view summary =
      "velocities reversed at the end of the step in which a contact is penetrated";
  static const std::vector<Field<Reversal>>& fields();

  void validate() const {}
  Claim claim(const Facts& integrator) const;
  std::optional<Objection> objection(const std::string& who,
                                     const model::ImpactProblem<>& problem) const;
  double contact_time(const model::ImpactProblem<>&) const { return 0.0; }

  template <class Integrator, int Dof>
  class TimeLoop;
};

/// A run with end-of-step reversal.
template <class Integrator, int Dof>
class Reversal::TimeLoop {
 public:
  using Stepper = typename Integrator::template Stepper<Dof>;
  using State = model::State<Dof>;

  TimeLoop(const Integrator& integrator, const Reversal&, model::ImpactProblem<Dof> problem,
           const StepPlan& plan)
      : problem_(std::move(problem)),
        plan_(plan),
        laws_(impact_laws(problem_)),
        stepper_(integrator, problem_.system, plan.h),
        v_before_(problem_.start.v),
        is_reversed_(laws_.size(), false) {}
  TimeLoop(const TimeLoop&) = delete;
  TimeLoop& operator=(const TimeLoop&) = delete;

  void advance(Recorder<Dof>& out) {
    stepper_.reset();
    steps_ = time_loop(stepper_, plan_, problem_.start, out,
                       [&](const State&, State& now, bool) { return reverse(now, out); });
  }

  model::Work work() const {
    model::Work work;
    work.steps = steps_;
    stepper_.add_work(work);
    return work;
  }

 private:
  bool reverse(State& now, Recorder<Dof>& out) {
    // Decided before any reversal, so that the numbers of the contacts do not matter.
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      const auto& contact = laws_[i].contact;
      is_reversed_[i] = contact.gap_at(now.u) < 0.0 && contact.gap_rate(now.v) < 0.0;
      for (std::size_t j = 0; j < i; ++j)
        if (is_reversed_[i] && is_reversed_[j] && are_coupled(laws_[i], laws_[j]))
          return out.fail("simultaneous-contacts", now.t, simultaneous(j, i));
    }
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      if (!is_reversed_[i]) continue;
      v_before_ = now.v;
      const double impulse = laws_[i].apply(now.v);
      if (!out.impact(now, static_cast<int>(i), v_before_, impulse)) return false;
      stepper_.restart(now);
    }
    return true;
  }

  model::ImpactProblem<Dof> problem_;
  StepPlan plan_;
  std::vector<ImpactLaw<Dof>> laws_;
  Stepper stepper_;
  model::Vector<Dof> v_before_;
  std::vector<bool> is_reversed_;
  long long steps_ = 0;
};

}  // namespace clackers::methods
