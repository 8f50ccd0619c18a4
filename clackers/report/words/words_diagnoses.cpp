#include <algorithm>

#include "clackers/base/codes.hpp"
#include "clackers/diagnose/diagnosis.hpp"
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

std::vector<Finding> diagnosis_texts(const record::Subject& subject) {
  std::vector<Finding> texts;
  for (const auto& cause : subject.diagnoses) {
    if (texts.size() == most_shown_diagnoses) break;
    texts.push_back(diagnosis_text(cause));
  }
  return texts;
}

}  // namespace clackers::report
