#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/recorder.hpp"
#include "clackers/methods/step_plan.hpp"

namespace clackers::methods {

/// A run of a scheme with its number of degrees of freedom known to the compiler. `TimeLoop` is the
/// scheme's step loop: advance(Recorder&) and work().
template <class TimeLoop, int Dof>
class SchemeRun final : public model::Run {
 public:
  template <class Scheme>
  SchemeRun(const Scheme& scheme, const model::ImpactProblem<>& problem, const StepPlan& plan)
      : recorder_(problem.dof()),
        walk_(scheme, model::with_dof<Dof>(problem), plan),
        name_(scheme.facts().name) {}

  model::Outcome advance(model::Sink& sink) override {
    recorder_.begin(sink);
    walk_.advance(recorder_);
    auto outcome = recorder_.finish(walk_.work());
    if (outcome.failed()) outcome.detail = name_ + ": " + outcome.detail + '.';
    return outcome;
  }

 private:
  Recorder<Dof> recorder_;
  TimeLoop walk_;
  std::string name_;
};

/// Makes a Method of a scheme: a value with facts(), objection(problem), contact_time(problem) and
/// the template TimeLoop<Dof>. Everything that does not depend on the number of degrees of freedom
/// happens here once.
template <class Scheme>
class SchemeMethod final : public Method {
 public:
  explicit SchemeMethod(Scheme scheme) : scheme_(std::move(scheme)) {}

  Facts facts() const override { return scheme_.facts(); }

  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const override {
    return scheme_.objection(problem);
  }

  double contact_time(const model::ImpactProblem<>& problem) const override {
    return scheme_.contact_time(problem);
  }

  std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>& problem,
                                      double step) const override {
    const auto who = facts().name;
    require_step(who, step);
    model::validate(problem);
    if (const auto no = objection(problem)) throw InputError(no->sentence, no->code);
    const auto plan = plan_steps(who, problem.start.t, problem.end, step);
    if (!problem.system.nonlinear) {
      if (problem.dof() == 1) return run<1>(problem, plan);
      if (problem.dof() == 2) return run<2>(problem, plan);
    }
    return run<model::any_dof>(problem, plan);
  }

 private:
  template <int Dof>
  std::unique_ptr<model::Run> run(const model::ImpactProblem<>& problem,
                                  const StepPlan& plan) const {
    using TimeLoop = typename Scheme::template TimeLoop<Dof>;
    return std::make_unique<SchemeRun<TimeLoop, Dof>>(scheme_, problem, plan);
  }

  Scheme scheme_;
};

}  // namespace clackers::methods
