#include "clackers/measure/metrics/metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/measure/metrics/causes.hpp"
#include "clackers/measure/metrics/definitions.hpp"

namespace clackers::measure {
namespace {

struct NormRow {
  Norm norm;
  std::string_view name, definition;  // {0} is the quantity
  bool across_jumps_of_v;
};

struct QuantityRow {
  Component quantity;
  std::string_view name, unit;
};

constexpr QuantityRow quantities[] = {
    {Component::u, "u", "m"}, {Component::v, "v", "m/s"}, {Component::a, "a", "m/s^2"}};
constexpr NormRow norms[] = {{Norm::max, "max", "max |{0} - {0}*| over rows", false},
                             {Norm::l1, "l1", "mean of |{0} - {0}*| over time", true},
                             {Norm::l2, "l2", "root mean square of {0} - {0}* over time", true},
                             {Norm::end, "end", "|{0} - {0}*| at the last row", false}};
constexpr std::string_view norms_in_reports[] = {"u-max-relative", "u-l2-relative",
                                                 "v-l1-relative"};

void add_norms(std::vector<Metric>& table) {
  for (const auto& [quantity, symbol, unit] : quantities)
    for (const bool relative : {false, true})
      for (const auto& [norm, name, definition, across_jumps_of_v] : norms) {
        const auto absolute = fmt::format("{}-{}", symbol, name);
        Metric row{.name = absolute,
                   .unit = unit,
                   .definition = fmt::format(fmt::runtime(definition), symbol),
                   .across_jumps = quantity == Component::u || across_jumps_of_v,
                   .source = "common",
                   .in_reports = false,
                   .measure = {}};
        if (relative) {
          row.name += "-relative";
          row.unit = "1";
          row.definition =
              fmt::format("{} / largest envelope of {}* over the run", absolute, symbol);
        }
        row.in_reports = std::ranges::count(norms_in_reports, row.name) > 0;
        row.measure = [quantity = quantity, norm = norm, relative](const Comparison& comparison) {
          return relative ? relative_norm_error(comparison, quantity, norm)
                          : norm_error(comparison, quantity, norm);
        };
        table.push_back(std::move(row));
      }
}

auto energy(Energy part) {
  return [part](const Comparison& comparison) { return energy_error(comparison, part); };
}

template <MetricValue Synchrony::*part>
MetricValue synchrony(const Comparison& comparison) {
  return comparison.shared(explain_synchrony).*part;
}

template <MetricValue PenaltySplit::*part>
MetricValue penalty(const Comparison& comparison) {
  return comparison.shared(split_known_penalty).*part;
}

// clang-format off
std::vector<Metric> all_metrics() {
  constexpr bool across = true, not_across = false, shown = true, on_request = false;
  std::vector<Metric> table;
  add_norms(table);
  table.insert(table.end(), {
    // Of the whole structure.
    {"energy-max-relative", "1", "max |E - E*| / max E*, E = v'Mv/2 + u'Ku/2",
     not_across, "common", shown, energy(Energy::total)},
    {"kinetic-energy-max-relative", "1", "the same of only v'Mv/2, over the same max E*",
     not_across, "common", on_request, energy(Energy::kinetic)},
    {"potential-energy-max-relative", "1", "the same of only u'Ku/2, over the same max E*",
     across, "common", on_request, energy(Energy::potential)},
    {"momentum-max-relative", "1", "max |p - p*| / sum of m V, p = sum of (M v)_i",
     not_across, "common", on_request, momentum_error},
    {"penetration-max", "m", "max(-g, 0) over rows, g = b.u - gap",
     across, "common", shown, penetration},
    {"rest-gap-max", "m", "max |g| over rows of the later half of each time in which the contact stays closed",
     across, "common", on_request, [](const Comparison& of) { return rest_error(of, Rest::gap); }},
    {"rest-speed-max", "m/s", "the same of b.v: a contact that should be at rest goes on bouncing",
     across, "common", on_request, [](const Comparison& of) { return rest_error(of, Rest::speed); }},
    // Impact against impact, at the time that each motion gives it.
    {"impact-time-max", "s", "max |t_k - t_k*| over matched impacts",
     across, "event-aligned, common", shown, impact_time_error},
    {"impact-v-before-max", "m/s", "max |v(t_k-) - v*(t_k*-)| over matched impacts",
     across, "event-aligned, common", on_request, velocity_before_error},
    {"impact-v-after-max", "m/s", "max |v(t_k+) - v*(t_k*+)| over matched impacts",
     across, "event-aligned, common", shown, velocity_after_error},
    {"impact-impulse-max", "N s", "max |P_k - P_k*| over matched impacts",
     across, "event-aligned, common", on_request, impulse_error},
    {"impact-missed-count", "1", "true impacts without a match",
     across, "event-aligned, common", on_request, missed_impacts},
    {"impact-extra-count", "1", "impacts that belong to no true one",
     across, "event-aligned, common", on_request, extra_impacts},
    {"impact-late-count", "1", "matched impacts over a step behind the true one",
     not_across, "event-aligned, common", on_request, late_impacts},
    {"impact-spacing-max-relative", "1",
     "max error of the time between impacts / T; above 0.1 synchrony is lost",
     across, "common", shown, measure_spacing_error},
    // Flight against flight, shifted by the delay d of the impact that each starts with.
    {"u-flight-max", "m", "max |u(t) - u*(t - d)|, d the delay of the flight's start",
     across, "time-aligned, common", on_request, flight_u_error},
    {"v-flight-max", "m/s", "max |v(t) - v*(t - d)|, d the delay of the flight's start",
     across, "time-aligned, common", on_request, flight_v_error},
    // Distances that allow for jumps at other instants.
    {"v-unfolded-max", "m/s", "max |(-1)^k v - (-1)^k* v*|, k the impacts so far",
     across, "Zhuravlev; Ivanov", on_request, unfolded_velocity_error},
    {"state-jump-invariant", "1",
     "max of min(|x - y|, |J(x) - y|, |x - J(y)|), x = (u/U, v/V), J the impact map",
     across, "Biemond, van de Wouw, Heemels, Nijmeijer (2013)", on_request,
     jump_invariant_distance},
    {"v-filled-graph", "1", "Hausdorff distance of the filled graphs (t/T, v/V)",
     across, "Moreau, RAIRO Anal. numer. 12 (1978)", shown, measure_filled_graph},
    {"v-filled-graph-excess", "1", "the same, only from the history to the reference",
     across, "Moreau, RAIRO Anal. numer. 12 (1978)", on_request, measure_filled_graph_of_history},
    {"v-filled-graph-deficit", "1", "the same, only from the reference to the history",
     across, "Moreau, RAIRO Anal. numer. 12 (1978)", on_request,
     measure_filled_graph_of_reference},
    {"state-hybrid-arc", "1",
     "smallest epsilon of (tau, epsilon)-closeness of the flights (t/T, u/U, v/V)",
     across, "Goebel, Sanfelice, Teel (2012)", on_request, measure_hybrid_closeness},
    // Phase, by impact times, or by zero crossings where there are none.
    {"period-fit-relative", "1", "(T - T*) / T*, by a line through impact times",
     across, "Bathe, Wilson (1973), on a history", shown, measure_period_error},
    {"phase-end-relative", "1", "lag of the last impact on that line, over T*",
     across, "common", shown, measure_phase_error},
    {"decay-fit-relative", "1", "error of the share that speed loses in a period",
     across, "Bathe, Wilson (1973), on a history", on_request, measure_decay_error},
    // Causes of a run's error.
    {"synchrony-loss-index", "1",
     "the first impact, by number, whose time since the one before is wrong by more than 0.1 T",
     across, "ours", on_request, synchrony<&Synchrony::lost>},
    {"momentum-growth-fit", "1",
     "growth per impact of ln|p|, p = sum m v / sum |m v| after impacts, up to the loss",
     across, "ours", on_request, synchrony<&Synchrony::growth>},
    {"detuning-fit", "1",
     "eps: the method's own damped frequencies in flight are in the ratio X (1 + eps)",
     across, "ours", on_request, synchrony<&Synchrony::detuning>},
    {"detuning-loss-index", "1",
     "ln(0.1/|eps|)/growth: where only eps would lose synchrony if the first disturbance is as large",
     across, "saltation matrices of the pair", on_request, synchrony<&Synchrony::predicted>},
    {"detuning-share", "1",
     "growth predicted from eps only, over momentum-growth-fit: 1 where it explains all of the loss",
     across, "saltation matrices of the pair", on_request, synchrony<&Synchrony::share>},
    {"restitution-median", "1", "median over impacts of b.v+ / -b.v-, the coefficient of restitution",
     across, "Newton", on_request, restitution_median},
    {"restitution-smallest", "1", "the smallest of them",
     across, "Newton", on_request, restitution_smallest},
    {"force-share-first", "1",
     "s in u1 = u0 + h v0 + s h^2 a0 of the first step: explicit Euler 0, symplectic 1, exact 1/2",
     across, "ours", on_request, first_force_share},
    {"u-penalty-model-max-relative", "1",
     "max |u of the exact motion with the run's contact spring - u*| / U: no step makes it smaller",
     across, "common; the exact penalized motion is ours", on_request, penalty<&PenaltySplit::model_u>},
    {"u-penalty-integration-max-relative", "1",
     "max |u - u of the exact motion with the run's contact spring| / U: the part caused by the step",
     across, "common; the exact penalized motion is ours", on_request, penalty<&PenaltySplit::integration_u>},
    {"v-penalty-model-l1-relative", "1",
     "the same for v, integral over time / length / V",
     across, "common", on_request, penalty<&PenaltySplit::model_v>},
    {"v-penalty-integration-l1-relative", "1",
     "the same for v, integral over time / length / V",
     across, "common", on_request, penalty<&PenaltySplit::integration_v>}});
  return table;
}
// clang-format on

const std::vector<Metric>& table() {
  static const auto table = all_metrics();
  return table;
}

}  // namespace

std::span<const Metric> metrics() { return table(); }

const Metric& metric(std::string_view name) {
  const auto row = std::ranges::find(table(), name, &Metric::name);
  if (row != table().end()) return *row;
  std::vector<std::string> names;
  for (const auto& known : table()) names.push_back(known.name);
  refuse_name("metric", name, names, "clackers list metrics");
}

MetricValue measured(double value) {
  if (std::isnan(value)) return not_measured("Numbers of the history are too large to measure.");
  return {value, {}, {}};
}

MetricValue measured(std::vector<double> masses) {
  for (const double value : masses)
    if (std::isnan(value)) return measured(value);
  const double largest = *std::ranges::max_element(masses);
  return {largest, std::move(masses), {}};
}

MetricValue not_measured(std::string reason) {
  MetricValue nothing;
  nothing.reason = std::move(reason);
  return nothing;
}

MetricValue relative_to(const MetricValue& value, std::span<const double> envelope) {
  if (!value.reason.empty()) return value;
  auto masses = value.masses;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (!(envelope[i] > 0.0))
      return not_measured(fmt::format(
          "The reference motion of mass {} has no extent, so nothing is relative to it.", i + 1));
    masses[i] /= envelope[i];
  }
  return measured(std::move(masses));
}

}  // namespace clackers::measure
