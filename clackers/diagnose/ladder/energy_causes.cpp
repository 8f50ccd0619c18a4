#include <cmath>

#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::diagnose {

std::vector<Diagnosis> energy_causes(const DiagnosisInput& question) {
  // Histories say it better: system/ fits them.
  if (!question.histories.empty() || question.by_tolerance) return {};
  constexpr double least_loss = 0.01;
  std::vector<double> x, y;
  const measure::RunScore* finest = nullptr;
  for (const auto& level : question.ladder)
    for (const auto& run : level.runs) {
      const double loss = 1.0 - run.energy_ratio;
      // Beyond half the energy the loss no longer falls in proportion to a power of the step.
      if (!run.finished || !(loss < 0.5)) continue;
      if (!(loss > 0.0)) return {};
      x.push_back(std::log(run.step));
      y.push_back(std::log(loss));
      finest = &run;
    }
  if (x.size() < 3 || x.front() - x.back() < std::log(3.0)) return {};
  const auto line = numerics::fit_line(x, y);
  const double loss = 1.0 - finest->energy_ratio;
  if (loss < least_loss || line.slope < 0.5 || line.slope > 6.0 || line.slope_spread > 0.3)
    return {};
  auto found = diagnosis_of(Code("numerical-damping"), loss, "1");
  found.confidence = 0.8;
  found.evidence = {{"order", line.slope}, {"step", finest->step}};
  return {found};
}

}  // namespace clackers::diagnose
