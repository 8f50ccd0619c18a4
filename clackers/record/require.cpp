#include "clackers/record/require.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "clackers/base/check.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"
#include "clackers/judge/convergence/judge.hpp"

namespace clackers::record {
namespace {

constexpr auto forms = "agrees, order:2, error:1e-3, or a behaviour such as proper";

double number_of(std::string_view whole, std::string_view digits, double most) {
  const auto value = finite_number(digits);
  if (!value)
    refuse("clackers", "--require", whole, forms, "The number takes a decimal point.",
           "bad-syntax");
  if (!(*value > 0.0 && *value <= most))
    refuse("clackers", "--require", whole, fmt::format("0 < number <= {}", most));
  return *value;
}

Behaviour behaviour_required(std::string_view word) {
  std::vector<std::string> words{"agrees", "order", "error"};
  for (const auto behaviour : {Behaviour::exact, Behaviour::proper, Behaviour::reduced,
                               Behaviour::irregular, Behaviour::stagnating, Behaviour::divergent}) {
    if (to_string(behaviour) == word) return behaviour;
    words.emplace_back(to_string(behaviour));
  }
  refuse_name("requirement", word, words, forms);
}

double tolerance_of(const judge::LadderFit& fit) {
  return fit.on_envelope ? judge::envelope_order_tolerance : judge::order_tolerance;
}

// What was found instead of what is required; nothing when it is met.
std::optional<Unmet> shortfall(const Subject& subject, const Requirement& requirement) {
  const auto instead = [&](std::string_view found, double value = unknown) {
    return Unmet{{}, subject.name, std::string(found), value};
  };
  const auto& fit = subject.assessment.displacement;
  const auto verdict = subject.assessment.verdict;
  const bool is_agreement = requirement.kind == Requirement::Kind::agrees;
  if (!subject.refusal.empty() || !subject.complete || verdict == Verdict::disagrees ||
      verdict == Verdict::undecided || (is_agreement && verdict != Verdict::agrees))
    return instead(verdict_word(subject));
  switch (requirement.kind) {
    case Requirement::Kind::agrees:
      break;
    case Requirement::Kind::behaviour:
      if (fit.behaviour != requirement.behaviour) return instead(to_string(fit.behaviour));
      break;
    case Requirement::Kind::order:
      if (fit.behaviour == Behaviour::exact) break;
      if (!fit.has_line) return instead(to_string(fit.behaviour));
      if (!(fit.order >= requirement.value * (1.0 - tolerance_of(fit))))
        return instead("order", fit.order);
      break;
    case Requirement::Kind::error: {
      const auto finest = worst_of_finest(subject);
      if (finest.failed > 0 || !(finest.worst.u_error <= requirement.value))
        return instead("error", finest.worst.u_error);
      break;
    }
  }
  return {};
}

}  // namespace

Requirement requirement_from(std::string_view text) {
  Requirement found;
  found.text = text;
  const auto colon = text.find(':');
  const auto word = text.substr(0, colon);
  const bool has_number = colon != std::string_view::npos;
  const auto digits = has_number ? text.substr(colon + 1) : std::string_view();
  if (word == "order" || word == "error") {
    found.kind = word == "order" ? Requirement::Kind::order : Requirement::Kind::error;
    found.value =
        number_of(text, digits, word == "order" ? 20.0 : std::numeric_limits<double>::max());
    return found;
  }
  if (word != "agrees") {
    found.kind = Requirement::Kind::behaviour;
    found.behaviour = behaviour_required(word);
  }
  if (has_number)
    refuse("clackers", "--require", text, fmt::format("{} without a number", word),
           "An order is required by order:2.", "bad-syntax");
  return found;
}

std::vector<Unmet> unmet(const Record& record, const Requirement& requirement) {
  std::vector<Unmet> all;
  for (const auto& problem : record.cases)
    for (const auto& subject : problem.subjects)
      if (auto found = shortfall(subject, requirement)) {
        found->case_name = problem.problem.name;
        all.push_back(std::move(*found));
      }
  return all;
}

int exit_code(const Record& record, const std::vector<Requirement>& requirements) {
  const int code = exit_code(record);
  const bool is_met = std::ranges::all_of(requirements, [&](const Requirement& requirement) {
    return unmet(record, requirement).empty();
  });
  return is_met || code == 130 || code == 4 ? code : 1;
}

}  // namespace clackers::record
