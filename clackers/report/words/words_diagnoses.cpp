#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {

using diagnose::Diagnosis;

Finding diagnosis_text(const Diagnosis& cause) {
  const auto sentence = diagnose::sentence_of(cause);
  return sentence.empty() ? Finding{cause.code, {}} : Finding{sentence, cause.code};
}

bool is_shown_cause(const record::Subject& subject, std::string_view code) {
  const auto shown = std::min(subject.diagnoses.size(), most_shown_diagnoses);
  return std::any_of(subject.diagnoses.begin(), subject.diagnoses.begin() + std::ptrdiff_t(shown),
                     [&](const Diagnosis& cause) {
                       const bool is_digits = code == Code("printed-digits").name() &&
                                              cause.code == Code("single-precision").name();
                       return is_digits || cause.code == code;
                     });
}

const Diagnosis* deciding_cause(const record::Subject& subject) {
  if (subject.assessment.reason == Code("run-failed").name()) return nullptr;
  // What right methods have as well contradicts no claim but one of more than first order, or of no floor.
  const auto may_contradict = [&](const Diagnosis& cause) {
    return cause.code == Code("impact-tolerance").name() ||
           (subject.claim.order > 1.5 && (cause.code == Code("impact-at-step-end").name() ||
                                          cause.code == Code("force-step").name()));
  };
  for (const auto& cause : subject.diagnoses)
    if (!subject.claim.is_made() || !diagnose::is_of_right_methods(cause) || may_contradict(cause))
      return &cause;
  return nullptr;
}

std::string departure_text(const record::CaseRecord& problem) {
  std::vector<const record::Subject*> left;
  std::string others;
  for (const auto& subject : problem.subjects) {
    const auto score = record::worst_of_finest(subject).worst;
    if (subject.kind == record::SubjectKind::method || std::isnan(score.u_error)) continue;
    if (subject.departure)
      left.push_back(&subject);
    else if (score.u_error <= score.rounding_floor)
      others += fmt::format("; {} stays on it to rounding", subject.name);
    else
      others += fmt::format("; {} stays within {} of the largest envelope to its end", subject.name,
                            scientific(score.u_error));
  }
  if (left.empty() || (left.size() == 1 && others.empty())) return {};
  std::ranges::stable_sort(left, {}, [](const auto* one) { return one->departure->time; });
  std::string text = "First to leave the exact motion";
  for (const auto* one : left) {
    const auto& [impact, time] = *one->departure;
    text += fmt::format("{} {} at t = {} s ({})", one == left.front() ? ":" : "; then", one->name,
                        short_number(time, 3),
                        impact > 0 ? fmt::format("impact {}", impact) : "before any impact");
  }
  return text + others + ".";
}

std::vector<Finding> diagnosis_texts(const record::Subject& subject) {
  std::vector<Finding> texts;
  for (const auto& cause : subject.diagnoses) {
    if (texts.size() == most_shown_diagnoses) break;
    texts.push_back(diagnosis_text(cause));
  }
  return texts;
}

}  // namespace clackers::report
