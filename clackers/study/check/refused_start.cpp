#include "clackers/study/check/initial_state.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/diagnose/start_parameters.hpp"
#include "clackers/study/check/case_family.hpp"

namespace clackers::study {
namespace {

void refuse_by(const std::string& name, diagnose::Diagnosis found) {
  // A first row that is explained to all its digits has no gain worth a number.
  std::erase_if(found.evidence, [](const diagnose::Fact& fact) { return fact.name == "gain"; });
  throw InputError(fmt::format("{}: {}", name, diagnose::sentence_of(found)),
                   diagnose::find_cause(found.code)->code);
}

// "N=5,xi1=0.25"; empty where no parameters start the case so.
std::string settings_of(const diagnose::FirstRows& opening, const cases::Case& problem) {
  std::string settings;
  for (const auto& parameter :
       diagnose::start_parameters(opening, problem.problem, *problem.motion, family_of(problem)))
    settings +=
        fmt::format("{}{}={}", settings.empty() ? "" : ",", parameter.name, parameter.value);
  return settings;
}

}  // namespace

void refuse_start(const std::string& name, const diagnose::FirstRows& opening,
                  const cases::Case& problem, const StartDifference& most) {
  const auto& case_name = problem.entry->name;
  const auto start = fmt::format(
      "{}: {} starts at {:.6g}, and that of {} at {:.6g}: {:.2g} of the envelope apart.", name,
      most.name, most.given, case_name, most.expected, most.relative);
  if (const auto settings = settings_of(opening, problem); !settings.empty())
    throw InputError(
        fmt::format("{} With --set {} the case starts as the history does.", start, settings),
        "not-this-case");
  if (const auto cause = diagnose::diagnose_start(opening, problem.problem, *problem.motion))
    refuse_by(name, *cause);
  throw InputError(
      fmt::format("{} Neither one parameter of the case nor two, nor units, signs or exchanged "
                  "columns explain it. Give the case the parameters of the run with --set; they "
                  "are listed by: clackers show {}.",
                  start, case_name),
      "not-this-case");
}

void refuse_reading(const std::string& name, const diagnose::FirstRows& opening,
                    const cases::Case& problem) {
  const auto cause = diagnose::diagnose_start(opening, problem.problem, *problem.motion);
  if (!cause || cause->code == Code("starts-at-rest").name()) return;
  if (diagnose::find_cause(cause->code)->group == diagnose::CauseGroup::reading)
    refuse_by(name, *cause);
}

}  // namespace clackers::study
