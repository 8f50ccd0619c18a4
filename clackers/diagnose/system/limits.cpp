#include "clackers/diagnose/system/limits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "clackers/diagnose/system/hypotheses.hpp"

namespace clackers::diagnose {

namespace {

/// The limit is this part of the finest value at least: at coarse steps the next power of the step
/// makes up to a fifth of it.
constexpr double least_limit_share = 0.5;
constexpr double residuals_above = 30.0;
/// Values that differ by less than this part are the same in all files: those of true causes differ
/// by a few thousandths, since the method's error is fitted beside them.
constexpr double constant_share = 0.03;
/// A law of three constants through three files fits always.
constexpr std::size_t least_limit_files = 4;
/// What remains makes this part of the distance of the finest history at least.
constexpr double least_effect_share = 0.3;
/// Gain of the fit of all parameters over the reference: for a period error, and for a limit.
/// Impacts at the ends of steps reach 40 by chance, Newmark's methods have 1000 and more.
constexpr double least_smooth_gain = 10.0, least_limit_gain = 100.0;
/// Errors of period are mentioned where they cost as much as this.
constexpr double noticeable = 1e-3;
/// Where the distance does not fall with the step, it is no matter of the period.
constexpr double least_fall = 1.5;
constexpr double least_period_order = 1.3, most_period_order = 4.7;
constexpr double limit_confidence = 0.7, period_confidence = 0.6;

// A parameter's values in the files, finest first.
struct Sequence {
  Hypothesis hypothesis;
  std::vector<double> values{};
  double uncertainty = 0.0;  // of the finest
  double effect = 0.0;       // rms that a unit of the parameter makes of the finest
};

// values = limit + constant h^order, orders 1 to 4 in halves.
struct PowerLimit {
  double limit = 0.0, order = 0.0;
  double residual = INFINITY;  // largest distance of a value from the law
};

PowerLimit power_limit(std::span<const double> steps, std::span<const double> values) {
  const auto n = double(steps.size());
  PowerLimit best;
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
    if (law.residual < best.residual) best = law;
  }
  return best;
}

std::optional<PowerLimit> significant_limit(const Sequence& sequence,
                                            std::span<const double> steps) {
  const double first = sequence.values[0];
  double spread = 0.0;
  for (const double one : sequence.values) spread = std::max(spread, std::abs(one - first));
  if (spread < constant_share * std::abs(first)) return PowerLimit{first, 0.0, spread};
  if (steps.size() < least_limit_files) return std::nullopt;
  const auto law = power_limit(steps, sequence.values);
  if (!(std::abs(law.limit) > least_limit_share * std::abs(sequence.values[0])) ||
      !(std::abs(law.limit) > residuals_above * law.residual))
    return std::nullopt;
  return law;
}

std::optional<Diagnosis> period_error(const FitQuestion& question,
                                      std::span<const Sequence> sequences,
                                      std::span<const double> steps) {
  std::optional<Diagnosis> found;
  double largest = 0.0;
  for (const auto& one : sequences) {
    const auto& values = one.values;
    if (one.hypothesis.parameter->change != Change::frequency || !(values[0] * values[1] > 0.0) ||
        !(std::abs(values[0]) > largest))
      continue;
    const double order = std::log(values[1] / values[0]) / std::log(steps[1] / steps[0]);
    if (!(order > least_period_order && order < most_period_order)) continue;
    largest = std::abs(values[0]);
    found = one.hypothesis.diagnosis(question.problem, values[0], one.uncertainty);
    found->code = Code("period-error").name();
    found->confidence = period_confidence;
    found->evidence.push_back({"order", order});
  }
  return found;
}

}  // namespace

std::vector<Diagnosis> smooth_limits(const FitQuestion& question) {
  auto parameters = question.smooth;
  if (!question.problem.contacts.empty()) parameters.push_back({Change::restitution, -1});
  std::vector<Sequence> sequences;
  for (const auto& one : parameters) sequences.push_back({hypothesis_of(one), {}});
  std::vector<double> steps;
  double gain = 0.0;
  for (const auto& file : question.files) {
    if (file.smooth.values.empty()) break;
    auto start = file.smooth.values;
    start.resize(parameters.size(), 0.0);
    const auto fit = refine_system(file.rows, Variation{question.problem}, parameters, start);
    if (fit.values.empty() || file.rows.distance < least_smooth_gain * fit.distance) break;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      sequences[k].values.push_back(fit.values[k]);
      if (!steps.empty()) continue;
      sequences[k].uncertainty = fit.uncertainty[k];
      sequences[k].effect = fit.effect[k];
    }
    if (steps.empty()) gain = file.rows.distance / std::max(fit.distance, 1e-300);
    steps.push_back(file.step);
  }
  if (steps.size() < 2) return {};
  // Of several that remain, the one that moves the history most.
  std::optional<Diagnosis> found;
  double most = least_effect_share * question.files.front().rows.distance;
  for (const auto& one : sequences) {
    const auto law = significant_limit(one, steps);
    if (gain < least_limit_gain || !law || !(std::abs(law->limit) * one.effect > most)) continue;
    most = std::abs(law->limit) * one.effect;
    found = one.hypothesis.diagnosis(question.problem, law->limit,
                                     std::max(2.0 * law->residual, one.uncertainty));
    found->confidence = limit_confidence;
    found->evidence.insert(found->evidence.begin(), {"gain", gain});
    found->evidence.push_back({"files", double(steps.size())});
    if (law->order > 0.0) found->evidence.push_back({"order", law->order});
  }
  const double distance = question.files[0].rows.distance;
  if (!found && !question.by_tolerance && distance > noticeable &&
      question.files[1].rows.distance > least_fall * distance)
    found = period_error(question, sequences, steps);
  if (!found) return {};
  return {*found};
}

}  // namespace clackers::diagnose
