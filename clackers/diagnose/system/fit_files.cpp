#include "clackers/diagnose/system/fit_files.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/diagnose/system/hypotheses.hpp"
#include "clackers/numerics/modes/modal_flight.hpp"

namespace clackers::diagnose {

namespace {

constexpr double least_ratio = 1.8;

bool is_served(const model::ImpactProblem<>& problem) {
  const auto& s = problem.system;
  return !s.add_load && !s.nonlinear && numerics::is_diagonal(s.mass) &&
         numerics::is_diagonal(s.damping) && numerics::is_diagonal(s.stiffness) &&
         s.stiffness.diagonal().minCoeff() > 0.0;
}

void find_least_gap(FitFile& file, const Observation& seen, const model::Contact<>& contact) {
  const auto& rows = seen.rows_with_impacts();
  const auto n = std::size_t(rows.dof);
  file.least_gap = INFINITY;
  for (std::size_t i = 0; i < rows.t.size(); ++i) {
    const Eigen::Map<const Eigen::VectorXd> u(&rows.u[i * n], rows.dof);
    file.least_gap = std::min(file.least_gap, contact.gap_at(u));
    if (i > 0) file.gap_spacing = std::max(file.gap_spacing, rows.t[i] - rows.t[i - 1]);
  }
}

}  // namespace

FitQuestion fit_question(const DiagnosisInput& question) {
  FitQuestion made{question.problem, question.motion, question.by_tolerance, {}, {}};
  if (!is_served(question.problem)) return made;
  made.smooth = smooth_parameters(question.problem);
  for (auto at = question.histories.rbegin(); at != question.histories.rend(); ++at) {
    const double step = at->facts.step;
    if (!made.files.empty() && !(step >= least_ratio * made.files.back().step)) continue;
    FitFile file{.step = step,
                 .late_start = late_start(*at, question.motion),
                 .rows = fit_rows(*at, question.problem, question.motion)};
    if (!file.rows.is_far()) {
      if (made.files.empty()) return made;
      continue;
    }
    if (!question.problem.contacts.empty())
      find_least_gap(file, *at, question.problem.contacts.front());
    made.files.push_back(std::move(file));
    if (made.files.size() == most_fit_files) break;
  }
  return made;
}

}  // namespace clackers::diagnose
