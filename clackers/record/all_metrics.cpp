#include "clackers/record/all_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::record {
namespace {

// Of a contact spring that throws two free masses apart in this time.
double stiffness_of(const model::ImpactProblem<>& problem, double contact_time) {
  const auto& b = problem.contacts.front().direction;
  const double inverse_effective_mass = b.dot(numerics::solved(problem.system.mass, b).col(0));
  return std::pow(std::numbers::pi / contact_time, 2) / inverse_effective_mass;
}

}  // namespace

measure::RunFacts facts_of(const CaseSummary& summary, const model::ImpactProblem<>& problem,
                           double contact_time) {
  measure::RunFacts facts;
  const auto rate = std::ranges::find(summary.constants, "detuning_rate", &Quantity::name);
  if (rate != summary.constants.end()) facts.detuning_rate = rate->value;
  if (!(contact_time > 0.0) || problem.contacts.size() != 1) return facts;
  try {
    facts.penalized = std::make_shared<const exact::PiecewiseMotion>(
        exact::with_springs(problem, stiffness_of(problem, contact_time)), "penalized motion");
  } catch (const InputError& error) {
    facts.no_penalized = error.what();
  }
  return facts;
}

std::optional<std::vector<MetricResult>> all_metrics(const measure::Comparison& comparison,
                                                     const MetricsDone& done,
                                                     const std::atomic<bool>* interrupt) {
  std::vector<MetricResult> all;
  const auto table = measure::metrics();
  for (const auto& metric : table) {
    if (interrupt != nullptr && *interrupt) return {};
    auto found = metric.measure(comparison);
    all.push_back({std::string(metric.name), std::string(metric.unit), found.value,
                   std::move(found.masses), std::move(found.reason), metric.across_jumps});
    if (done) done(double(all.size()) / double(table.size()));
  }
  return all;
}

}  // namespace clackers::record
