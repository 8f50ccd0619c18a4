#include "clackers/study/check/case_family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::study {
namespace {

using diagnose::CaseFamily, diagnose::CaseParameter;
using Change = std::function<void(model::ImpactProblem<>&, double)>;
using Motion = std::shared_ptr<const model::Motion>;

cases::Settings changed(cases::Settings values, std::span<const CaseParameter> parameters) {
  for (const auto& parameter : parameters)
    for (auto& [known, number] : values)
      if (known == parameter.name) number = parameter.value;
  return values;
}

// With spring i changed: its contact and its stiffness.
void change_spring(model::ImpactProblem<>& problem, std::size_t i, const auto& change) {
  const auto* springs = model::one_sided_springs(problem);
  auto contacts = springs->contacts();
  auto stiffnesses = springs->stiffnesses();
  change(contacts[i], stiffnesses[i]);
  problem.system.nonlinear =
      std::make_shared<model::OneSidedSprings>(std::move(contacts), std::move(stiffnesses));
}

struct ContactNumber {
  CaseParameter parameter;
  Change change;
};

std::vector<ContactNumber> contact_numbers(const model::ImpactProblem<>& problem) {
  std::vector<ContactNumber> all;
  if (!problem.unstated.empty() || !problem.frictions.empty()) return all;
  const auto add = [&](std::string name, double value, const char* unit, Change change) {
    all.push_back({{std::move(name), value, unit, false}, std::move(change)});
  };
  if (const auto* springs = model::one_sided_springs(problem))
    for (std::size_t i = 0; i < springs->contacts().size(); ++i) {
      add(fmt::format("stiffness of one-sided spring {}", i + 1), springs->stiffnesses()[i], "N/m",
          [i](auto& p, double value) {
            change_spring(p, i, [&](auto&, double& k) { k = value; });
          });
      add(fmt::format("gap of one-sided spring {}", i + 1), springs->contacts()[i].gap, "m",
          [i](auto& p, double value) {
            change_spring(p, i, [&](auto& c, double&) { c.gap = value; });
          });
    }
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    add(fmt::format("gap of contact {}", i + 1), contact.gap, "m",
        [i](auto& p, double value) { p.contacts[i].gap = value; });
    all.back().parameter.gap_of = int(i);
    add(fmt::format("restitution of contact {}", i + 1), contact.restitution, "1",
        [i](auto& p, double value) { p.contacts[i].restitution = value; });
  }
  return all;
}

}  // namespace

CaseFamily family_of(const cases::Case& problem) {
  CaseFamily family;
  for (std::size_t i = 0; i < problem.values.size(); ++i)
    if (const auto& [name, value] = problem.values[i]; !value.is_word())
      family.parameters.push_back({name, value, problem.entry->parameters[i].unit});
  auto numbers = contact_numbers(problem.problem);
  for (const auto& number : numbers) family.parameters.push_back(number.parameter);
  family.motion_of =
      [&problem, numbers = std::move(numbers)](std::span<const CaseParameter> values) -> Motion {
    try {
      Motion motion;
      if (std::ranges::all_of(values, &CaseParameter::is_setting)) {
        motion = cases::make(problem.entry->name, changed(problem.values, values)).motion;
      } else {
        auto other = problem.problem;
        for (const auto& value : values)
          for (const auto& number : numbers)
            if (number.parameter.name == value.name) number.change(other, value.value);
        motion = std::make_shared<const exact::PiecewiseMotion>(other);
      }
      return motion->dof() == problem.motion->dof() ? motion : nullptr;
    } catch (const InputError&) {
      return nullptr;
    }
  };
  return family;
}

}  // namespace clackers::study
