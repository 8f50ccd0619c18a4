#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "clackers/base/parameter.hpp"
#include "clackers/methods/method_specification.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/methods/stepping/recorder.hpp"
#include "clackers/methods/stepping/step_plan.hpp"

// How the type of a contact treatment, or of a method that stands alone, becomes a row of the
// registry: by its name, summary and card. Included by the source of each type, which compiles its loops
// for every size with `template Row row<Penalty>();`.
namespace clackers::methods {

/// A parameter that is a member of the value type T: a number, or a name out of `words`, which then
/// say what is allowed. The default is that of T{}, or NaN with the words for it. A type with
/// parameters lists them in `T::fields()` and checks them in `validate()`.
template <class T>
struct Field {
  std::string_view name, allowed, meaning;
  std::variant<double T::*, std::string T::*> member;
  std::string_view default_words{};
  std::vector<Word> words{};

  ParameterValue get(const T& x) const {
    if (const auto* number = std::get_if<double T::*>(&member)) return x.*(*number);
    return x.*std::get<std::string T::*>(member);
  }
  std::string allowed_text() const {
    std::string text(allowed);
    for (const auto& word : words)
      text += (text.empty() ? std::string(name) + " = " : ", ") + word.name;
    return text;
  }
  void set(T& x, const ParameterValue& value) const {
    if (const auto* number = std::get_if<double T::*>(&member))
      x.*(*number) = value;
    else
      x.*std::get<std::string T::*>(member) = value.text();
  }
};

template <class T>
std::span<const Field<T>> fields_of() {
  if constexpr (requires { T::fields(); })
    return T::fields();
  else
    return {};
}

template <class T>
std::vector<Parameter> parameters_of() {
  std::vector<Parameter> all;
  static const T standard{};
  for (const Field<T>& field : fields_of<T>())
    all.push_back({std::string(field.name), field.get(standard), "", field.allowed_text(),
                   std::string(field.meaning), std::string(field.default_words), field.words});
  return all;
}

/// The value with these parameters. Throws InputError with did-you-mean for names that it does not
/// have, for a name given twice, and for numbers outside their range.
template <class T>
T configured(const Settings& given) {
  T x{};
  const auto values = complete(T::name, parameters_of<T>(), given);
  for (const Field<T>& field : fields_of<T>()) field.set(x, value_of(values, field.name));
  if constexpr (requires { x.validate(); }) x.validate();
  return x;
}

/// The specification of a value: its name, and the parameters that differ from their default with
/// digits that read back to the same number.
template <class T>
std::string specification(const T& x) {
  Settings values;
  for (const Field<T>& field : fields_of<T>()) values.emplace_back(field.name, field.get(x));
  return specification(T::name, parameters_of<T>(), values);
}

/// A run with its number of degrees of freedom known to the compiler. `Loop` is built from the
/// parts of the method, the problem and the plan; it has advance(Recorder&) and work().
template <class Loop, int Dof>
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
  Loop loop_;
};

/// Method::prepare() of a method whose loop for each size is Loop<Dof>.
template <template <int> class Loop, class... Parts>
std::unique_ptr<model::Run> prepare_run(const Method& method, const model::ImpactProblem<>& problem,
                                        const Resolution& resolution, const Parts&... parts) {
  const auto plan = checked_plan(method, problem, resolution);
  const auto run = [&]<int Dof>() -> std::unique_ptr<model::Run> {
    return std::make_unique<MethodRun<Loop<Dof>, Dof>>(method.facts().name, problem, plan,
                                                       parts...);
  };
  if (problem.dof() == 1) return run.template operator()<1>();
  if (problem.dof() == 2) return run.template operator()<2>();
  return run.template operator()<model::any_dof>();
}

/// A contact treatment or a method that has a law of friction.
template <class T>
concept TakesFriction = requires {
  T::takes_friction;
};

/// A contact treatment of type T.
template <class T>
class TypedTreatment final : public Treatment {
 public:
  explicit TypedTreatment(const T& treatment) : treatment_(treatment) {}

  std::string specification() const override { return methods::specification(treatment_); }
  Claim claim(const Facts& integrator) const override { return treatment_.claim(integrator); }
  std::optional<Objection> objection_to(const Facts& method) const override {
    if constexpr (requires { treatment_.objection_to(method); })
      return treatment_.objection_to(method);
    else
      return std::nullopt;
  }
  double model_order() const override {
    if constexpr (requires { treatment_.model_order(); }) return treatment_.model_order();
    return 0.0;
  }
  std::optional<Objection> objection(const Facts& method,
                                     const model::ImpactProblem<>& problem) const override {
    if (!problem.unstated.empty()) return objection_to_unstated(method.name, problem.unstated);
    if (!TakesFriction<T> && !problem.frictions.empty()) return objection_to_friction(method.name);
    return treatment_.objection(method, problem);
  }
  double contact_time(const model::ImpactProblem<>& problem) const override {
    return treatment_.contact_time(problem);
  }
  std::unique_ptr<model::Run> prepare(const Method& method, const Integrator& integrator,
                                      const model::ImpactProblem<>& problem,
                                      const Resolution& resolution) const override {
    return prepare_run<T::template Loop>(method, problem, resolution, integrator, treatment_);
  }

 private:
  T treatment_;
};

/// A method of type T that brings its own integration.
template <class T>
class StandaloneMethod final : public Method {
 public:
  explicit StandaloneMethod(const T& scheme) : scheme_(scheme) {}

  Facts facts() const override { return scheme_.facts(); }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const override {
    if (!problem.unstated.empty())
      return objection_to_unstated(std::string(T::name), problem.unstated);
    if (!TakesFriction<T> && !problem.frictions.empty())
      return objection_to_friction(std::string(T::name));
    return scheme_.objection(problem);
  }
  std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>& problem,
                                      const Resolution& resolution) const override {
    return prepare_run<T::template Loop>(*this, problem, resolution, scheme_);
  }

 private:
  T scheme_;
};

template <class T>
concept IsTreatment = requires(const T& x, const Facts& facts) {
  x.claim(facts);
};

template <class T>
Row row() {
  Row row;
  const auto card = [] {
    if constexpr (requires { T::card(); })
      return T::card();
    else
      return std::string(T::card);
  };
  row.entry = {std::string(T::name), IsTreatment<T> ? "contact" : "method", std::string(T::summary),
               parameters_of<T>(), card()};
  if constexpr (IsTreatment<T>)
    row.treatment = [](const Settings& settings) {
      return std::make_shared<TypedTreatment<T>>(configured<T>(settings));
    };
  else
    row.method = [](const Settings& settings) {
      return std::make_shared<StandaloneMethod<T>>(configured<T>(settings));
    };
  return row;
}

}  // namespace clackers::methods
