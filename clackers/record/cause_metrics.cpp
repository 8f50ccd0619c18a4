#include "clackers/record/cause_metrics.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "clackers/base/error.hpp"
#include "clackers/exact/penalized/penalized_motion.hpp"
#include "clackers/measure/metrics/detuning.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/measure/metrics/penalty_split.hpp"
#include "clackers/measure/metrics/synchrony.hpp"

namespace clackers::record {
namespace {

using measure::measured;
using measure::MetricValue;
using measure::not_measured;

constexpr auto table = std::to_array<CauseMetric>({
    {"synchrony-loss-index", "1",
     "the first collision, by number, whose time since the one before is wrong by more than 0.1 T",
     "ours"},
    {"momentum-growth-fit", "1",
     "growth per collision of ln|p|, p = sum m v / sum |m v| after impacts, up to the loss",
     "ours"},
    {"detuning-fit", "1",
     "eps: the method's own damped frequencies in flight are in the ratio X (1 + eps)", "ours"},
    {"detuning-loss-index", "1",
     "ln(0.1/|eps|)/growth: where eps alone loses synchrony if the first disturbance is as large",
     "saltation matrices of the pair"},
    {"detuning-share", "1",
     "growth that eps alone predicts over momentum-growth-fit: 1 where it explains all of the loss",
     "saltation matrices of the pair"},
    {"u-penalty-model-max-relative", "1",
     "max |u of the exact motion with the run's contact spring - u*| / U: no step makes it smaller",
     "common; the exact penalized motion is ours"},
    {"u-penalty-integration-max-relative", "1",
     "max |u - u of the exact motion with the run's contact spring| / U: what the step is to blame "
     "for",
     "common; the exact penalized motion is ours"},
    {"v-penalty-model-l1-relative", "1", "the same for v, integral over time / length / V",
     "common"},
    {"v-penalty-integration-l1-relative", "1", "the same for v, integral over time / length / V",
     "common"},
});

struct Synchrony {
  MetricValue lost, growth, detuning, predicted, share;
};

void explain(const measure::SynchronyLoss& loss, double eps, double rate, Synchrony& out) {
  if (!(rate > 0.0)) {
    out.predicted = out.share = not_measured("On this case no detuning grows.");
    return;
  }
  if (!(std::abs(eps) > 0.0 && std::abs(eps) < 1.0)) {
    out.predicted = out.share = not_measured("The method's frequencies are true.");
    return;
  }
  const auto part = measure::explained_by_detuning(loss, {.rate = rate, .eta = 1.0, .eps = eps});
  out.predicted = measured(part.collision);
  out.share = std::isnan(out.growth.value) ? not_measured(out.growth.reason) : measured(part.share);
}

Synchrony synchrony(const measure::Comparison& comparison, double rate) {
  const auto loss = measure::synchrony_loss(comparison);
  Synchrony out;
  if (loss.collisions == 0)
    out.lost = not_measured("The history or the reference has no collisions.");
  else if (!loss.lost)
    out.lost =
        not_measured(fmt::format("Synchrony is kept over all {} collisions.", loss.collisions));
  else
    out.lost = measured(double(*loss.lost));
  if (!loss.lost)
    out.growth = not_measured(out.lost.reason);
  else if (std::isnan(loss.growth))
    out.growth =
        not_measured("Momenta after the collisions before the loss are too few or unknown.");
  else
    out.growth = measured(loss.growth);
  const auto found = measure::flight_frequencies(comparison);
  if (found.errors.size() != 2) {
    out.detuning = out.predicted = out.share =
        not_measured(found.reason.empty() ? "There is no pair of masses." : found.reason);
    return out;
  }
  const double eps = measure::detuning(comparison, found);
  out.detuning = measured(eps);
  explain(loss, eps, rate, out);
  return out;
}

// Of a contact spring that throws two free masses apart in this time.
double stiffness_of(const model::ImpactProblem<>& problem, double contact_time) {
  const auto& b = problem.contacts.front().direction;
  const double mobility = b.dot(problem.system.mass.ldlt().solve(b));
  return std::pow(std::numbers::pi / contact_time, 2) / mobility;
}

measure::PenaltySplit split(const measure::Comparison& comparison, double contact_time) {
  const auto none = [](const std::string& reason) {
    return measure::PenaltySplit{not_measured(reason), not_measured(reason), not_measured(reason),
                                 not_measured(reason)};
  };
  const auto& problem = comparison.problem();
  if (!(contact_time > 0.0) || problem.contacts.size() != 1)
    return none("No contact spring of the run is known.");
  try {
    const exact::PenalizedMotion penalized(problem, stiffness_of(problem, contact_time));
    return measure::penalty_split(comparison, penalized);
  } catch (const InputError& error) {
    return none(error.what());
  }
}

}  // namespace

std::span<const CauseMetric> cause_metrics() { return table; }

RunFacts facts_of(const CaseSummary& problem, double contact_time) {
  const auto rate = std::ranges::find(problem.constants, "detuning_rate", &Quantity::name);
  return {rate == problem.constants.end() ? 0.0 : rate->value, contact_time};
}

std::vector<MetricResult> cause_results(const measure::Comparison& comparison,
                                        const RunFacts& facts) {
  const auto lost = synchrony(comparison, facts.detuning_rate);
  const auto parts = split(comparison, facts.contact_time);
  const std::array values{lost.lost,           lost.growth,   lost.detuning,
                          lost.predicted,      lost.share,    parts.model_u,
                          parts.integration_u, parts.model_v, parts.integration_v};
  static_assert(values.size() == table.size());
  std::vector<MetricResult> all;
  for (std::size_t i = 0; i < table.size(); ++i)
    all.push_back({std::string(table[i].name), std::string(table[i].unit), values[i].value,
                   values[i].masses, values[i].reason, true});
  return all;
}

std::optional<std::vector<MetricResult>> all_metrics(const measure::Comparison& comparison,
                                                     const RunFacts& facts, const MetricsDone& done,
                                                     const std::atomic<bool>* interrupt) {
  std::vector<MetricResult> all;
  const auto table_of_metrics = measure::metrics();
  for (const auto& metric : table_of_metrics) {
    if (interrupt != nullptr && *interrupt) return {};
    auto found = metric.measure(comparison);
    all.push_back({std::string(metric.name), std::string(metric.unit), found.value,
                   std::move(found.masses), std::move(found.reason), metric.across_jumps});
    if (done) done(double(all.size()) / double(table_of_metrics.size() + 1));
  }
  if (interrupt != nullptr && *interrupt) return {};
  for (auto& cause : cause_results(comparison, facts)) all.push_back(std::move(cause));
  return all;
}

}  // namespace clackers::record
