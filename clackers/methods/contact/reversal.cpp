#include "clackers/methods/contact/reversal.hpp"

#include <memory>
#include <utility>

#include "clackers/methods/contact/impact_law.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/stepping/time_loop.hpp"

namespace clackers::methods {

const std::vector<Field<Reversal>>& Reversal::fields() {
  static const std::vector<Field<Reversal>> none;
  return none;
}

Claim Reversal::claim(const Facts&) const { return {Behaviour::irregular, 1.0, {}}; }

std::optional<Objection> Reversal::objection(const Facts& method,
                                             const model::ImpactProblem<>& problem) const {
  return objection_to_closed_contacts(method.name, problem);
}

/// A run with end-of-step reversal.
template <int Dof>
class Reversal::Loop {
 public:
  using State = model::State<Dof>;

  Loop(const Integrator& integrator, const Reversal&, model::ImpactProblem<Dof> problem,
       const StepPlan& plan)
      : problem_(std::move(problem)),
        time_loop_(plan, problem_.dof()),
        laws_(impact_laws(problem_)),
        stepper_(integrator.stepper(problem_.system, plan)),
        v_before_(problem_.start.v),
        is_reversed_(laws_.size(), false) {}
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void advance(Recorder<Dof>& out) {
    stepper_->reset();
    stepper_->restart(problem_.start);
    steps_ = time_loop_.run(*this, problem_.start, out);
  }

  model::Work work() const {
    model::Work work;
    work.steps = steps_;
    stepper_->add_work(work);
    return work;
  }

  AnyStepper<Dof>& stepper() { return *stepper_; }

  bool is_quiet(const State&, const State& now) const {
    for (const auto& law : laws_)
      if (is_closing(law.contact, now)) return false;
    return true;
  }

  Handled handle(const State&, State& now, Recorder<Dof>& out) {
    // Decided before any reversal, so that the numbers of the contacts do not matter.
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      is_reversed_[i] = is_closing(laws_[i].contact, now);
      for (std::size_t j = 0; j < i; ++j)
        if (is_reversed_[i] && is_reversed_[j] && are_coupled(laws_[i], laws_[j])) {
          out.fail("simultaneous-contacts", now.t, simultaneous(j, i));
          return Handled::ended;
        }
    }
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      if (!is_reversed_[i]) continue;
      v_before_ = now.v;
      const double impulse = laws_[i].apply(now.v);
      if (!out.impact(now, static_cast<int>(i), v_before_, impulse)) return Handled::ended;
    }
    stepper_->restart(now);
    return Handled::changed;
  }

 private:
  static bool is_closing(const model::Contact<Dof>& contact, const State& now) {
    return contact.gap_at(now.u) < 0.0 && contact.gap_rate(now.v) < 0.0;
  }

  model::ImpactProblem<Dof> problem_;
  TimeLoop<Dof> time_loop_;
  std::vector<ImpactLaw<Dof>> laws_;
  std::unique_ptr<AnyStepper<Dof>> stepper_;
  model::Vector<Dof> v_before_;
  std::vector<bool> is_reversed_;
  long long steps_ = 0;
};

template Row row<Reversal>();

}  // namespace clackers::methods
