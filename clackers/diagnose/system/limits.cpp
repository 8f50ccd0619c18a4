#include "clackers/diagnose/system/limits.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/diagnose/system/hypotheses.hpp"

namespace clackers::diagnose {

namespace {

/// The limit is this part of the finest value at least: the next power of the step makes a few
/// per cent of it.
constexpr double least_limit_share = 0.15;
constexpr double residuals_above = 10.0;
/// Gain of the fit of all frequencies and dampings over the reference.
constexpr double least_smooth_gain = 10.0;
/// Errors of period are mentioned where they cost as much as this.
constexpr double noticeable = 1e-3;

Hypothesis hypothesis_of(const Parameter& parameter) {
  return {
      parameter.change == Change::frequency ? Code("frequency-differs") : Code("damping-differs"),
      parameter};
}

}  // namespace

std::optional<PowerLimit> power_limit(std::span<const double> steps,
                                      std::span<const double> values) {
  const auto n = double(steps.size());
  if (steps.size() < 3) return std::nullopt;
  std::optional<PowerLimit> best;
  for (double order = 1.0; order <= 4.0; order += 0.5) {
    double sx = 0.0, sxx = 0.0, sy = 0.0, sxy = 0.0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double x = std::pow(steps[i] / steps.front(), order);
      sx += x;
      sxx += x * x;
      sy += values[i];
      sxy += x * values[i];
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    PowerLimit law{(sy - slope * sx) / n, order, 0.0};
    for (std::size_t i = 0; i < steps.size(); ++i)
      law.residual = std::max(
          law.residual,
          std::abs(values[i] - law.limit - slope * std::pow(steps[i] / steps.front(), order)));
    if (!best || law.residual < best->residual) best = law;
  }
  return best;
}

std::vector<Diagnosis> smooth_limits(const FitQuestion& question) {
  std::vector<double> steps;
  for (const auto& file : question.files) {
    if (file.smooth.values.empty() || file.rows.distance < least_smooth_gain * file.smooth.distance)
      break;
    steps.push_back(file.step);
  }
  if (steps.size() < 2) return {};
  std::vector<Diagnosis> found;
  const auto& finest = question.files.front();
  const double gain = finest.rows.distance / std::max(finest.smooth.distance, 1e-300);
  Diagnosis period;
  double largest = 0.0;
  for (std::size_t k = 0; k < question.smooth.size(); ++k) {
    std::vector<double> values;
    for (std::size_t i = 0; i < steps.size(); ++i)
      values.push_back(question.files[i].smooth.values[k]);
    const auto hypothesis = hypothesis_of(question.smooth[k]);
    const double uncertainty = finest.smooth.uncertainty[k];
    if (const auto law = power_limit(steps, values);
        law && std::abs(law->limit) > least_limit_share * std::abs(values[0]) &&
        std::abs(law->limit) > residuals_above * law->residual &&
        std::abs(law->limit) > residuals_above * uncertainty) {
      auto cause = hypothesis.diagnosis(question.problem, law->limit,
                                        std::max(2.0 * law->residual, uncertainty));
      // Only what moves the history visibly beside the rest.
      if (std::abs(law->limit) * 20.0 < finest.rows.distance) continue;
      cause.confidence = 0.7;
      cause.evidence.insert(cause.evidence.begin(), {"gain", gain});
      cause.evidence.push_back({"files", double(steps.size())});
      cause.evidence.push_back({"order", law->order});
      found.push_back(std::move(cause));
      continue;
    }
    const double order = std::log(std::abs(values[1] / values[0])) / std::log(steps[1] / steps[0]);
    if (question.smooth[k].change == Change::frequency && values[0] * values[1] > 0.0 &&
        order > 1.3 && order < 4.7 && std::abs(values[0]) > largest) {
      largest = std::abs(values[0]);
      period = hypothesis.diagnosis(question.problem, values[0], uncertainty);
      period.code = Code("period-error").name();
      period.confidence = 0.6;
      period.evidence.push_back({"order", order});
    }
  }
  std::ranges::sort(found, std::ranges::greater{},
                    [](const Diagnosis& one) { return std::abs(one.value); });
  if (found.size() > 1) found.resize(1);
  if (found.empty() && largest > 0.0 && finest.rows.distance > noticeable && !question.by_tolerance)
    found.push_back(std::move(period));
  return found;
}

}  // namespace clackers::diagnose
