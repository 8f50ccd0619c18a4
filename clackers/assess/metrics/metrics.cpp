#include <algorithm>
#include <array>

#include "clackers/assess/metrics/distance/filled_graph.hpp"
#include "clackers/assess/metrics/distance/hybrid_arc.hpp"
#include "clackers/assess/metrics/distance/jump_invariant_distance.hpp"
#include "clackers/assess/metrics/distance/unfolded_velocity.hpp"
#include "clackers/assess/metrics/energy_error.hpp"
#include "clackers/assess/metrics/event_report.hpp"
#include "clackers/assess/metrics/flight_error.hpp"
#include "clackers/assess/metrics/metric.hpp"
#include "clackers/assess/metrics/momentum_error.hpp"
#include "clackers/assess/metrics/norm_error.hpp"
#include "clackers/assess/metrics/penetration.hpp"
#include "clackers/assess/metrics/phase_error.hpp"
#include "clackers/assess/metrics/synchrony.hpp"
#include "clackers/base/suggest.hpp"

namespace clackers::assess {
namespace {

template <Quantity quantity, Norm norm>
MetricValue absolute(const Comparison& comparison) {
  return norm_error(comparison, quantity, norm);
}

template <Quantity quantity, Norm norm>
MetricValue relative(const Comparison& comparison) {
  return relative_norm_error(comparison, quantity, norm);
}

template <Energy part>
MetricValue energy(const Comparison& comparison) {
  return energy_error(comparison, part);
}

constexpr bool across = true, not_across = false;
using enum Quantity;

constexpr auto table = std::to_array<Metric>({
    // Norms, mass by mass.
    {"u-max", "m", "max |u - u*| over the history's times", across, "common",
     absolute<u, Norm::max>},
    {"u-l1", "m", "mean of |u - u*| over time", across, "common", absolute<u, Norm::l1>},
    {"u-l2", "m", "root of the mean of (u - u*)^2 over time", across, "common",
     absolute<u, Norm::l2>},
    {"u-end", "m", "|u - u*| at the last time", across, "common", absolute<u, Norm::end>},
    {"u-max-relative", "1", "u-max / envelope of u* at t = 0", across, "common",
     relative<u, Norm::max>},
    {"u-l1-relative", "1", "u-l1 / envelope of u* at t = 0", across, "common",
     relative<u, Norm::l1>},
    {"u-l2-relative", "1", "u-l2 / envelope of u* at t = 0", across, "common",
     relative<u, Norm::l2>},
    {"u-end-relative", "1", "u-end / envelope of u* at t = 0", across, "common",
     relative<u, Norm::end>},
    {"v-max", "m/s", "max |v - v*| over the history's times", not_across, "common",
     absolute<v, Norm::max>},
    {"v-l1", "m/s", "mean of |v - v*| over time", across, "common", absolute<v, Norm::l1>},
    {"v-l2", "m/s", "root of the mean of (v - v*)^2 over time", across, "common",
     absolute<v, Norm::l2>},
    {"v-end", "m/s", "|v - v*| at the last time", not_across, "common", absolute<v, Norm::end>},
    {"v-max-relative", "1", "v-max / envelope of v* at t = 0", not_across, "common",
     relative<v, Norm::max>},
    {"v-l1-relative", "1", "v-l1 / envelope of v* at t = 0", across, "common",
     relative<v, Norm::l1>},
    {"v-l2-relative", "1", "v-l2 / envelope of v* at t = 0", across, "common",
     relative<v, Norm::l2>},
    {"v-end-relative", "1", "v-end / envelope of v* at t = 0", not_across, "common",
     relative<v, Norm::end>},
    {"a-max", "m/s^2", "max |a - a*| over the history's times", not_across, "common",
     absolute<a, Norm::max>},
    {"a-l1", "m/s^2", "mean of |a - a*| over time", across, "common", absolute<a, Norm::l1>},
    {"a-l2", "m/s^2", "root of the mean of (a - a*)^2 over time", across, "common",
     absolute<a, Norm::l2>},
    {"a-end", "m/s^2", "|a - a*| at the last time", not_across, "common", absolute<a, Norm::end>},
    {"a-max-relative", "1", "a-max / envelope of a* at t = 0", not_across, "common",
     relative<a, Norm::max>},
    {"a-l1-relative", "1", "a-l1 / envelope of a* at t = 0", across, "common",
     relative<a, Norm::l1>},
    {"a-l2-relative", "1", "a-l2 / envelope of a* at t = 0", across, "common",
     relative<a, Norm::l2>},
    {"a-end-relative", "1", "a-end / envelope of a* at t = 0", not_across, "common",
     relative<a, Norm::end>},
    // Of the whole structure.
    {"energy", "1", "max |E - E*| / E* at t = 0, E = v'Mv/2 + u'Ku/2", not_across, "common",
     energy<Energy::total>},
    {"energy-kinetic", "1", "the same of v'Mv/2 alone, divided by the whole E* at t = 0",
     not_across, "common", energy<Energy::kinetic>},
    {"energy-potential", "1", "the same of u'Ku/2 alone, divided by the whole E* at t = 0", across,
     "common", energy<Energy::potential>},
    {"momentum", "1",
     "max |p - p*| / sum of m V, p = sum of (M v)_i, V the envelope of v* at t = 0", not_across,
     "common", momentum_error},
    {"penetration", "m", "max (-g, 0) over the history's times, g = b.u - gap", across, "common",
     penetration},
    // Collision against collision, at the time that each motion gives it.
    {"impact-time", "s", "max |t_k - t_k*| over matched collisions", across,
     "event-aligned, common", impact_time_error},
    {"impact-v-before", "m/s", "max |v(t_k-) - v*(t_k*-)| over matched collisions", across,
     "event-aligned, common", velocity_before_error},
    {"impact-v-after", "m/s", "max |v(t_k+) - v*(t_k*+)| over matched collisions", across,
     "event-aligned, common", velocity_after_error},
    {"impact-impulse", "N s", "max |P_k - P_k*| over matched collisions", across,
     "event-aligned, common", impulse_error},
    {"impacts-missed", "1", "number of true collisions without a match", across,
     "event-aligned, common", missed_impacts},
    {"impacts-extra", "1", "number of collisions that belong to no true one", across,
     "event-aligned, common", extra_impacts},
    {"impacts-late", "1", "number of matched collisions more than one step behind the true one",
     not_across, "event-aligned, common", late_impacts},
    // Flight against flight, shifted to start together.
    {"flight-u", "m",
     "max |u(t) - u*(t - d)|, d = delay of the collision that the flight starts with", across,
     "time-aligned, common", flight_u_error},
    {"flight-v", "m/s",
     "max |v(t) - v*(t - d)|, d = delay of the collision that the flight starts with", across,
     "time-aligned, common", flight_v_error},
    // Jumps undone.
    {"v-unfolded", "m/s",
     "max |(-1)^k v - (-1)^k* v*|, k the number of impacts so far; elastic impacts that reverse "
     "every velocity",
     across, "Zhuravlev; Ivanov", unfolded_velocity_error},
    {"jump-invariant", "1",
     "max of min(|x - y|, |J(x) - y|, |x - J(y)|), x = (u/U, v/V), J the impact map", across,
     "Biemond, van de Wouw, Heemels, Nijmeijer (2013)", jump_invariant_distance},
    // Graphs and hybrid arcs.
    {"v-filled-graph", "1",
     "Hausdorff distance of the filled graphs of v and v*, points (t/T, v/V), jumps filled", across,
     "Moreau, RAIRO Anal. numer. 12 (1978)", measure_filled_graph},
    {"v-filled-graph-history", "1",
     "the same from the history to the reference: what the history has and the reference has not",
     across, "Moreau, RAIRO Anal. numer. 12 (1978)", measure_filled_graph_of_history},
    {"v-filled-graph-reference", "1",
     "the same from the reference to the history: what the history misses", across,
     "Moreau, RAIRO Anal. numer. 12 (1978)", measure_filled_graph_of_reference},
    {"hybrid-arc", "1",
     "smallest epsilon of (tau, epsilon)-closeness, flight by flight, points (t/T, u/U, v/V)",
     across, "Goebel, Sanfelice, Teel (2012)", measure_hybrid_closeness},
    // Phase.
    {"period-error", "1", "(T - T*)/T* by a line through collision times, or zero crossings",
     across, "Bathe, Wilson (1973), on a history", measure_period_error},
    {"phase-error", "1", "lag of the last collision or zero crossing on that line, over T*", across,
     "common", measure_phase_error},
    {"decay-error", "1",
     "part by which the speed at these instants falls in a period, less the true one", across,
     "Bathe, Wilson (1973), on a history", measure_decay_error},
    {"collision-spacing", "1",
     "max |(t_k - t_(k-1)) - (t_k* - t_(k-1)*)| / T over collisions by number; above 0.1 synchrony "
     "is lost",
     across, "common", measure_spacing_error},
});

}  // namespace

std::span<const Metric> metrics() { return table; }

const Metric& metric(std::string_view name) {
  const auto row = std::ranges::find(table, name, &Metric::name);
  if (row != table.end()) return *row;
  std::vector<std::string> names;
  for (const auto& known : table) names.emplace_back(known.name);
  refuse_name("metric", name, names, "clackers list metrics");
}

}  // namespace clackers::assess
