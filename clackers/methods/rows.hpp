#pragma once

#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "clackers/methods/contact/event_driven.hpp"
#include "clackers/methods/contact/penalty.hpp"
#include "clackers/methods/contact/reversal.hpp"
#include "clackers/methods/parameters.hpp"
#include "clackers/methods/recorder.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/methods/step_plan.hpp"

// How a type becomes a row of the registry. Included by the source of each type, which compiles
// its step loops with `template Row row<Newmark>();`.
namespace clackers::methods {

/// Every contact treatment that an integrator can be joined with.
using Treatments = std::tuple<EventDriven, Reversal, Penalty>;

/// A run with its number of degrees of freedom known to the compiler. `TimeLoop` is built from the
/// parts of the method, the problem and the plan; it has advance(Recorder&) and work().
template <class TimeLoop, int Dof>
class MethodRun final : public model::Run {
 public:
  template <class... Parts>
  MethodRun(std::string name, const model::ImpactProblem<>& problem, const StepPlan& plan,
            const Parts&... parts)
      : name_(std::move(name)),
        recorder_(problem.dof()),
        loop_(parts..., model::with_dof<Dof>(problem), plan) {}

  model::Outcome advance(model::Sink& sink) override {
    recorder_.begin(sink);
    loop_.advance(recorder_);
    auto outcome = recorder_.finish(loop_.work());
    if (outcome.failed()) outcome.detail = name_ + ": " + outcome.detail + '.';
    return outcome;
  }

 private:
  std::string name_;
  Recorder<Dof> recorder_;
  TimeLoop loop_;
};

/// Method::prepare() of a method whose loop for each size is TimeLoop<Dof>.
template <template <int> class TimeLoop, class... Parts>
std::unique_ptr<model::Run> prepare_run(const Method& method, const model::ImpactProblem<>& problem,
                                        double step, const Parts&... parts) {
  const auto plan = checked_plan(method, problem, step);
  const auto run = [&]<int Dof>() -> std::unique_ptr<model::Run> {
    return std::make_unique<MethodRun<TimeLoop<Dof>, Dof>>(method.facts().name, problem, plan,
                                                           parts...);
  };
  if (!problem.system.nonlinear) {
    if (problem.dof() == 1) return run.template operator()<1>();
    if (problem.dof() == 2) return run.template operator()<2>();
  }
  return run.template operator()<model::any_dof>();
}

/// An integrator joined with a contact treatment, which computes the claim through impacts from the
/// integrator's facts.
template <class Integrator, class Treatment>
class JoinedMethod final : public Method {
 public:
  JoinedMethod(const Integrator& integrator, const Treatment& treatment)
      : integrator_(integrator), treatment_(treatment) {}

  Facts facts() const override {
    auto facts = integrator_.facts();
    facts.through_impacts = treatment_.claim(facts);
    facts.name += '+' + specification(treatment_);
    return facts;
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const override {
    return treatment_.objection(facts().name, problem);
  }
  double contact_time(const model::ImpactProblem<>& problem) const override {
    return treatment_.contact_time(problem);
  }
  std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>& problem,
                                      double step) const override {
    return prepare_run<TimeLoop>(*this, problem, step, integrator_, treatment_);
  }

 private:
  template <int Dof>
  using TimeLoop = typename Treatment::template TimeLoop<Integrator, Dof>;

  Integrator integrator_;
  Treatment treatment_;
};

/// A method that brings its own integration.
template <class Scheme>
class StandaloneMethod final : public Method {
 public:
  explicit StandaloneMethod(const Scheme& scheme) : scheme_(scheme) {}

  Facts facts() const override { return scheme_.facts(); }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const override {
    return scheme_.objection(problem);
  }
  std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>& problem,
                                      double step) const override {
    return prepare_run<Scheme::template TimeLoop>(*this, problem, step, scheme_);
  }

 private:
  Scheme scheme_;
};

/// The method of an integrator and the treatment with this name; empty if no treatment has it.
template <class Integrator, class... Every>
std::shared_ptr<const Method> join(const Integrator& integrator, std::string_view treatment,
                                   const Settings& settings, std::tuple<Every...>) {
  std::shared_ptr<const Method> joined;
  const auto try_one = [&]<class Treatment>(const Treatment*) {
    if (treatment == Treatment::name)
      joined = std::make_shared<JoinedMethod<Integrator, Treatment>>(
          integrator, configured<Treatment>(settings));
  };
  (try_one(static_cast<const Every*>(nullptr)), ...);
  return joined;
}

template <class T>
concept IsIntegrator = requires {
  typename T::template Stepper<1>;
};
template <class T>
concept IsTreatment = requires(const T& x, const Facts& facts) {
  x.claim(facts);
};

template <class T>
Row row() {
  const auto entry = [](const char* kind) {
    return Entry{std::string(T::name), kind, std::string(T::summary), parameters_of<T>(),
                 std::string(card(T::name))};
  };
  if constexpr (IsIntegrator<T>) {
    return {entry("integrator"),
            [](const Settings& settings, std::string_view treatment, const Settings& of_treatment) {
              return join(configured<T>(settings), treatment, of_treatment, Treatments{});
            }};
  } else if constexpr (IsTreatment<T>) {
    return {entry("contact"), nullptr};
  } else {
    return {entry("method"),
            [](const Settings& settings, std::string_view,
               const Settings&) -> std::shared_ptr<const Method> {
              return std::make_shared<StandaloneMethod<T>>(configured<T>(settings));
            }};
  }
}

}  // namespace clackers::methods
