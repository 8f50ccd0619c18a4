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

// Of a problem file the numbers of its contacts: what else it states acts between impacts and is measured there.
CaseFamily family_of_file(const cases::Case& problem) {
  CaseFamily family;
  std::vector<Change> changes;
  const auto add = [&](std::string name, double value, const char* unit, Change change) {
    family.parameters.push_back({std::move(name), value, unit});
    changes.push_back(std::move(change));
  };
  if (const auto* springs = model::one_sided_springs(problem.problem))
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
  for (std::size_t i = 0; i < problem.problem.contacts.size(); ++i) {
    const auto& contact = problem.problem.contacts[i];
    add(fmt::format("gap of contact {}", i + 1), contact.gap, "m",
        [i](auto& p, double value) { p.contacts[i].gap = value; });
    add(fmt::format("restitution of contact {}", i + 1), contact.restitution, "1",
        [i](auto& p, double value) { p.contacts[i].restitution = value; });
  }
  family.motion_of =
      [&problem, changes, known = family.parameters](
          std::span<const CaseParameter> values) -> std::shared_ptr<const model::Motion> {
    auto other = problem.problem;
    for (const auto& [name, value, unit] : values)
      changes[std::size_t(std::ranges::find(known, name, &CaseParameter::name) - known.begin())](
          other, value);
    try {
      return std::make_shared<const exact::PiecewiseMotion>(other);
    } catch (const InputError&) {
      return nullptr;
    }
  };
  return family;
}

}  // namespace

bool is_of_a_file(const cases::Case& problem) {
  return !problem.values.empty() && std::ranges::all_of(problem.values, [](const auto& setting) {
    return setting.second.is_word();
  });
}

CaseFamily family_of(const cases::Case& problem) {
  if (is_of_a_file(problem)) return family_of_file(problem);
  CaseFamily family;
  for (std::size_t i = 0; i < problem.values.size(); ++i)
    if (const auto& [name, value] = problem.values[i]; !value.is_word())
      family.parameters.push_back({name, value, problem.entry->parameters[i].unit});
  family.motion_of =
      [&problem](std::span<const CaseParameter> values) -> std::shared_ptr<const model::Motion> {
    try {
      return cases::make(problem.entry->name, changed(problem.values, values)).motion;
    } catch (const InputError&) {
      return nullptr;
    }
  };
  return family;
}

}  // namespace clackers::study
