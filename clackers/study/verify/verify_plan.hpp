#pragma once

#include <memory>
#include <vector>

#include "clackers/assess/convergence/step_ladder.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::study {

/// A method of a study before its runs.
struct PlannedMethod {
  std::shared_ptr<const methods::Method> method;
  MethodResult result;  ///< name, claim, contact time and refusal are known already
  bool reports_impacts = true;
  std::vector<assess::ResponseLevel> ends;  ///< displacements at the end, once they were run
};

/// A request made ready to run.
struct VerifyPlan {
  cases::Case problem;
  CaseSummary summary;
  std::vector<PlannedMethod> methods;
  std::vector<assess::StepLevel> ladder;
};

/// What a record tells of a case.
CaseSummary summary_of(const cases::Case& which);

/// Throws InputError for whatever cannot be run: unknown names, values outside their range, a
/// ladder of too many steps, a method named twice, or no method left that takes the case.
VerifyPlan plan_of(const VerifyRequest& request);

}  // namespace clackers::study
