#include "clackers/diagnose/system/fit_files.hpp"

#include <cmath>

#include "clackers/diagnose/system/hypotheses.hpp"
#include "clackers/numerics/modal_flight.hpp"

namespace clackers::diagnose {

namespace {

constexpr double least_ratio = 1.8;
constexpr double floors_above = 30.0;

bool is_served(const model::ImpactProblem<>& problem) {
  const auto& s = problem.system;
  return !s.add_load && !s.nonlinear && numerics::is_diagonal(s.mass) &&
         numerics::is_diagonal(s.damping) && numerics::is_diagonal(s.stiffness) &&
         s.stiffness.diagonal().minCoeff() > 0.0;
}

}  // namespace

FitQuestion fit_question(const DiagnosisInput& question) {
  FitQuestion made{question.problem, question.motion, question.by_tolerance, {}, {}};
  if (!is_served(question.problem)) return made;
  made.smooth = smooth_parameters(question.problem);
  for (auto at = question.histories.rbegin(); at != question.histories.rend(); ++at) {
    const double step = at->facts.step;
    if (!made.files.empty() && !(step >= least_ratio * made.files.back().step)) continue;
    FitFile file{step, fit_rows(*at, question.problem, question.motion), {}};
    if (!std::isfinite(file.rows.distance) ||
        !(file.rows.distance > floors_above * file.rows.floor)) {
      if (made.files.empty()) return made;
      continue;
    }
    made.files.push_back(std::move(file));
    if (made.files.size() == most_fit_files) break;
  }
  return made;
}

}  // namespace clackers::diagnose
