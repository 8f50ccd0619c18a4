#pragma once

#include <memory>
#include <vector>

#include "clackers/judge/convergence/step_ladder.hpp"
#include "clackers/measure/impacts/shared_impacts.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::study {

/// A method of a study before its runs.
struct PlannedMethod {
  std::shared_ptr<const methods::Method> method;
  record::Subject subject;  ///< name, claim, contact time and refusal
  bool reports_impacts = true;
  double order = 0.0;        ///< of smooth motion
  double spring_time = 0.0;  ///< contact time of a linear contact spring [s]; 0: it has none
};

/// What is made of runs beside their errors.
struct Extras {
  bool record = true;   ///< what only a record shows: error histories, motions, self-convergence
  bool metrics = true;  ///< of one run of each method
  bool times = true;    ///< each run made again for its processor time
};

/// One case of a request, ready to run.
struct CasePlan {
  cases::Case problem;
  record::CaseSummary summary;
  std::optional<measure::SharedInstant> shared;  ///< the first of the reference
  std::vector<PlannedMethod> methods;
  record::RefinementPlan steps;
  std::vector<double> tolerances;  ///< the levels of adaptive methods
  Extras extras{};
};

/// The plan of a case whose subjects are histories.
inline constexpr record::RefinementPlan no_refinement{0.0, 0, 0};

record::CaseSummary summary_of(const cases::Case& problem);

/// The name of a method in every output: as one would type it, without "+event-driven".
std::string short_name(const std::string& name);

/// The steps of a plan on a case.
std::vector<judge::StepLevel> levels_of(const CasePlan& plan, const record::RefinementPlan& steps);

/// The levels of a method: those steps, or the tolerances of the plan, one run each, with the number
/// of steps to expect.
std::vector<judge::StepLevel> levels_of(const CasePlan& plan, const PlannedMethod& method,
                                        const record::RefinementPlan& steps);

/// Whether some method of a request is adaptive. Throws InputError for a specification.
bool has_adaptive_method(const VerifyRequest& request);

/// The cases of a request. Throws InputError for one that is named twice, and as cases::make() does.
std::vector<cases::Case> cases_of(const VerifyRequest& request);

/// The plan of a case without methods. Throws InputError for steps that verify() refuses.
CasePlan plan_without_methods(const RefinementRequest& steps, std::vector<double> tolerances,
                              cases::Case problem);
/// A method on the case of a plan; one that objects has its refusal. Throws InputError for the
/// specification.
PlannedMethod planned_method(const std::string& specification, const CasePlan& plan);

/// Throws InputError for what verify() refuses.
std::vector<CasePlan> plans_of(const VerifyRequest& request);

}  // namespace clackers::study
