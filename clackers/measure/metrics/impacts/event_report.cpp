#include "clackers/measure/metrics/definitions.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {
namespace {

std::vector<double> distance(const std::vector<double>& found, const Eigen::VectorXd& reference) {
  std::vector<double> errors(found.size());
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i] = std::abs(found[i] - reference[Eigen::Index(i)]);
  return errors;
}

MetricValue none_matched(const EventReport& report) {
  if (report.expected == 0) return not_measured("The reference has no impact by then.");
  return not_measured("No impact of the history belongs to a true one.");
}

// The largest entry of a list that each impact carries, mass by mass.
MetricValue worst(const Comparison& comparison, std::vector<double> ImpactError::*list,
                  const char* unknown) {
  const auto& report = comparison.shared(event_report);
  if (report.impacts.empty()) return none_matched(report);
  std::vector<double> masses;
  for (const auto& impact : report.impacts) {
    const auto& errors = impact.*list;
    if (!errors.empty()) masses.resize(errors.size());
    for (std::size_t i = 0; i < errors.size(); ++i) masses[i] = std::max(masses[i], errors[i]);
  }
  return masses.empty() ? not_measured(unknown) : measured(std::move(masses));
}

}  // namespace

EventReport event_report(const Comparison& comparison) {
  const auto& score = comparison.impact_score();
  EventReport report;
  report.source = comparison.impact_source();
  report.expected = score.expected;
  report.found = score.found;
  report.matched = score.matched;
  report.missed = score.missed;
  report.extra = score.extra;
  for (const auto& [number, reference] : comparison.matches()) {
    const auto& impact = comparison.impacts()[number];
    ImpactError error;
    error.index = reference.index;
    error.found = number;
    error.t = impact.t;
    error.time_error = impact.t - reference.t;
    error.before = distance(impact.v_before, reference.before.v);
    error.after = distance(impact.v_after, reference.after.v);
    error.impulse = std::abs(impact.impulse - reference.impulse);
    error.late = error.time_error > comparison.step();
    report.late += error.late;
    report.impacts.push_back(std::move(error));
  }
  return report;
}

MetricValue impact_time_error(const Comparison& comparison) {
  const auto& report = comparison.shared(event_report);
  if (report.impacts.empty()) return none_matched(report);
  double worst = 0.0;
  for (const auto& impact : report.impacts) worst = std::max(worst, std::abs(impact.time_error));
  return measured(worst);
}

MetricValue velocity_before_error(const Comparison& comparison) {
  return worst(comparison, &ImpactError::before,
               "No velocity before an impact is known of the history.");
}

MetricValue velocity_after_error(const Comparison& comparison) {
  return worst(comparison, &ImpactError::after,
               "No velocity after an impact is known of the history.");
}

MetricValue impulse_error(const Comparison& comparison) {
  const auto& report = comparison.shared(event_report);
  if (report.impacts.empty()) return none_matched(report);
  double worst = -1.0;
  for (const auto& impact : report.impacts)
    if (!std::isnan(impact.impulse)) worst = std::max(worst, impact.impulse);
  if (worst < 0.0) return not_measured("No impulse of an impact is known of the history.");
  return measured(worst);
}

namespace {

MetricValue counted(const Comparison& comparison, long long number) {
  return comparison.problem().has_unstated_impacts()
             ? not_measured("No row of the problem states where the impacts are.")
             : measured(double(number));
}

}  // namespace

MetricValue missed_impacts(const Comparison& comparison) {
  return counted(comparison, comparison.impact_score().missed);
}

MetricValue extra_impacts(const Comparison& comparison) {
  return counted(comparison, comparison.impact_score().extra);
}

MetricValue late_impacts(const Comparison& comparison) {
  return counted(comparison, comparison.shared(event_report).late);
}

}  // namespace clackers::measure
