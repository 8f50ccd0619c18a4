#include <algorithm>

#include "clackers/study/verify.hpp"

namespace clackers::study {

int exit_code(const Record& record) {
  if (record.interrupted) return 130;
  const auto any = [&](Verdict verdict) {
    return std::ranges::any_of(record.methods, [&](const MethodResult& method) {
      return method.refusal.empty() && method.assessment.verdict == verdict;
    });
  };
  if (any(Verdict::disagrees)) return 1;
  if (any(Verdict::undecided)) return 3;
  return 0;
}

}  // namespace clackers::study
