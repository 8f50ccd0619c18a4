#include "clackers/study/check/refused_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/diagnose/start_parameters.hpp"

namespace clackers::study {
namespace {

using diagnose::Diagnosis;

// The cause and its cure. A code that has no sentence here gives none.
std::string sentence(const Diagnosis& cause, const std::string& case_name) {
  const auto& text = cause.text;
  const auto is = [&](Code code) { return cause.code == code.name(); };
  const auto factor =
      std::isnan(cause.value) ? std::string() : fmt::format(", and {:.6g} times", cause.value);
  if (is("unit-scaled")) {
    const auto blank = text.find(' ');
    const bool is_part = blank != std::string::npos || text == "u" || text == "v";
    const auto unit = text == "u" || text == "v" ? std::string() : text.substr(blank + 1);
    const auto numbers =
        is_part ? (text[0] == 'u' ? "All displacements" : "All velocities") : "All numbers";
    return fmt::format("{} of the first row are {:.6g} times those of {}{} Divide them by {:.6g}.",
                       numbers, cause.value, case_name,
                       unit.empty() ? "." : fmt::format(": in {}?", unit), cause.value);
  }
  if (is("columns-exchanged"))
    return fmt::format("Columns are exchanged{}: --columns {}.", factor, text);
  if (is("masses-exchanged"))
    return fmt::format("The masses are exchanged{}: --columns {}.", factor, text);
  if (is("sign-reversed"))
    return fmt::format(
        "The first row is that of {} with the sign of {} reversed: measure in the direction of the "
        "case, or change these signs.",
        case_name, text);
  if (is("starts-at-rest"))
    return fmt::format(
        "The history starts at rest, the case with v{:.0f} = {:.6g}: a free decay from its largest "
        "displacement has v(0) = -sigma u(0) with damping. Start from the state of: clackers show "
        "{}.",
        cause.fact("mass"), cause.fact("expected"), case_name);
  if (is("velocity-at-half-steps"))
    return fmt::format(
        "Velocities of the first row are those half a step {}: v(0) {} a(0) h/2, as leapfrog keeps "
        "them. Write velocities at the times of the rows.",
        cause.value > 0.0 ? "later" : "earlier", cause.value > 0.0 ? "+" : "-");
  if (is("time-shifted"))
    return fmt::format(
        "The first row is the state of the case {:.6g} {} {}: shift the times, or write the initial "
        "state at t = 0.",
        std::abs(cause.value), cause.unit, cause.value < 0.0 ? "later" : "earlier");
  if (is("time-unit"))
    return fmt::format("Times are {:.6g} times those of {}{} Convert them to seconds.", cause.value,
                       case_name, text.empty() ? "." : fmt::format(": in {}?", text));
  return {};
}

void refuse_by(const std::string& name, const Diagnosis& cause, const std::string& case_name) {
  const auto message = sentence(cause, case_name);
  if (message.empty()) return;
  for (const Code code : diagnose::diagnosis_codes)
    if (code.name() == cause.code) throw InputError(fmt::format("{}: {}", name, message), code);
}

cases::Settings changed(cases::Settings values,
                        std::span<const diagnose::StartParameter> parameters) {
  for (const auto& [name, value] : parameters)
    for (auto& [known, number] : values)
      if (known == name) number = value;
  return values;
}

// "N=5,xi1=0.25"; empty where no parameters start the case so.
std::string settings_of(const diagnose::Opening& opening, const cases::Case& problem) {
  std::vector<diagnose::StartParameter> parameters;
  for (const auto& [name, value] : problem.values) parameters.push_back({name, value});
  const auto motion_of = [&](std::span<const diagnose::StartParameter> values)
      -> std::shared_ptr<const model::Motion> {
    try {
      return cases::make(problem.entry->name, changed(problem.values, values)).motion;
    } catch (const InputError&) {
      return nullptr;
    }
  };
  std::string settings;
  for (const auto& [name, value] :
       diagnose::start_parameters(opening, problem.problem, *problem.motion, parameters, motion_of))
    settings += fmt::format("{}{}={}", settings.empty() ? "" : ",", name, value);
  return settings;
}

}  // namespace

void refuse_start(const std::string& name, const diagnose::Opening& opening,
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
    refuse_by(name, *cause, case_name);
  throw InputError(
      fmt::format("{} Neither one parameter of the case nor two, nor units, signs or exchanged "
                  "columns explain it. Give the case the parameters of the run with --set; they "
                  "are listed by: clackers show {}.",
                  start, case_name),
      "not-this-case");
}

void refuse_reading(const std::string& name, const diagnose::Opening& opening,
                    const cases::Case& problem) {
  const auto cause = diagnose::diagnose_start(opening, problem.problem, *problem.motion);
  if (!cause) return;
  constexpr std::array<Code, 5> codes = {"unit-scaled", "columns-exchanged", "masses-exchanged",
                                         "sign-reversed", "time-unit"};
  for (const Code code : codes)
    if (cause->code == code.name()) refuse_by(name, *cause, problem.entry->name);
}

}  // namespace clackers::study
