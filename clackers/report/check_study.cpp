#include "clackers/report/check_study.hpp"

#include <cmath>

namespace clackers::report {

study::Record as_study(const study::CheckRecord& record) {
  study::Record out;
  out.provenance = record.provenance;
  out.problem = record.problem;
  out.response = record.response;
  study::MethodResult method;
  method.name = record.files.size() == 1 ? "the history" : "the histories";
  for (const auto& file : record.files) {
    assess::Level level{file.score.step, {}};
    if (!std::isnan(file.score.u_error)) level.runs.push_back(file.score);
    method.ladder.push_back(std::move(level));
  }
  method.assessment = record.assessment;
  method.assessment.verdict = record.verdict;
  method.assessment.sentence = record.sentence;
  method.error_history = record.files.back().error_history;
  method.history_step = record.files.back().score.step;
  out.methods.push_back(std::move(method));
  return out;
}

}  // namespace clackers::report
