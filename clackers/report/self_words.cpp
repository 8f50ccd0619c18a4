#include "clackers/report/self_words.hpp"

namespace clackers::report {

std::optional<Remark> lie(const study::MethodResult& method) {
  if (!method.self_convergence) return {};
  const auto& both = method.self_convergence->against_reference;
  if (!both.would_have_lied) return {};
  // The sentence tells both findings first; where it does not end as expected it is told whole.
  const auto at = both.sentence.find("Self-convergence would have lied");
  return Remark{at == std::string::npos ? both.sentence : both.sentence.substr(at), both.reason};
}

}  // namespace clackers::report
