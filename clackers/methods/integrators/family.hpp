#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/methods/method_specification.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/methods/stepping/stepper.hpp"

// How the members of a family of integrators become rows of the registry.
namespace clackers::methods {

/// A parameter of an integrator and its range.
struct Range {
  std::string_view name;
  double value;  ///< the default
  double least, most;
  std::string_view allowed, meaning;
  std::string_view hint = {};  ///< what to do about a value outside
};

/// The values of all parameters, in their order.
using Values = std::span<const double>;

/// One integrator of a family. `Family` is a value with the data of the family, facts() and what
/// Stepper asks for.
template <class Family>
struct Member {
  std::string name, summary;
  std::vector<Range> parameters;
  std::function<Family(Values)> method;
  std::string card;
};

template <class Family>
class FamilyIntegrator final : public Integrator {
 public:
  FamilyIntegrator(const Family& family, std::string_view name, std::string text)
      : family_(family), name_(name), text_(std::move(text)) {}

  Facts facts() const override {
    auto facts = family_.facts();
    facts.name = text_;
    return facts;
  }
  Eigen::MatrixXd coefficients() const override {
    if constexpr (requires { family_.coefficients(); }) return family_.coefficients();
    return {};
  }
  StepperPointer<1> stepper(const model::SmoothSystem<1>& system,
                            const StepPlan& plan) const override {
    return std::make_unique<Stepper<Family, 1>>(family_, name_, system, plan);
  }
  StepperPointer<2> stepper(const model::SmoothSystem<2>& system,
                            const StepPlan& plan) const override {
    return std::make_unique<Stepper<Family, 2>>(family_, name_, system, plan);
  }
  StepperPointer<model::any_dof> stepper(const model::SmoothSystem<>& system,
                                         const StepPlan& plan) const override {
    return std::make_unique<Stepper<Family, model::any_dof>>(family_, name_, system, plan);
  }

 private:
  Family family_;
  std::string_view name_;
  std::string text_;
};

/// The row of a member. Its integrator is made after checks of names and ranges.
template <class Family>
Row row(const Member<Family>& member) {
  Row row;
  row.entry = {member.name, "integrator", member.summary, {}, member.card};
  for (const auto& range : member.parameters)
    row.entry.parameters.push_back({std::string(range.name),
                                    range.value,
                                    "",
                                    std::string(range.allowed),
                                    std::string(range.meaning),
                                    {},
                                    {}});
  row.integrator = [member, parameters = row.entry.parameters](const Settings& given) {
    const auto settings = complete(member.name, parameters, given);
    std::vector<double> values;
    for (const auto& range : member.parameters) {
      values.push_back(value_of(settings, range.name));
      if (!(values.back() >= range.least && values.back() <= range.most))
        refuse(member.name, range.name, values.back(), range.allowed, range.hint);
    }
    return std::make_shared<FamilyIntegrator<Family>>(
        member.method(values), member.name, specification(member.name, parameters, settings));
  };
  return row;
}

template <class Family>
std::vector<Row> rows(std::initializer_list<Member<Family>> members) {
  std::vector<Row> all;
  for (const auto& member : members) all.push_back(row(member));
  return all;
}

inline constexpr double always = std::numeric_limits<double>::infinity();

}  // namespace clackers::methods
