#include "clackers/measure/metrics/definitions.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {
namespace {

struct Jump {
  double t, before, after;
};

// Velocities at the history's rows, row-major (row, mass), joined with jumps in order of time, every
// v of `mass` scaled. A jump at the time of a row comes before it or after it, whichever of its limits
// is that row's. With a `cut` the line ends with the left limit of the last jump.
Polyline graph(const Comparison& comparison, std::size_t mass, std::span<const double> velocities,
               std::span<const Jump> jumps, bool cut) {
  const auto& t = comparison.history().t;
  const double period = comparison.impact_period(), scale = comparison.v_envelope()[mass];
  const auto v = velocities.subspan(mass);
  cut = cut && !jumps.empty();
  const auto first_from = [&t](std::size_t row, double time) {
    return std::size_t(std::lower_bound(t.begin() + std::ptrdiff_t(row), t.end(), time) -
                       t.begin());
  };
  const auto last = cut ? first_from(0, jumps.back().t) : t.size();
  std::vector<std::size_t> places;
  std::vector<double> limits;
  std::size_t row = 0;
  for (const auto& jump : jumps) {
    row = std::min(last, first_from(row, jump.t));
    const auto is_after = [&](double now) {
      return std::abs(now - jump.after) < std::abs(now - jump.before);
    };
    const auto is_here = [&] { return row < last && t[row] == jump.t; };
    while (is_here() && !is_after(v[row * comparison.dof()] / scale)) ++row;
    const bool is_cut = cut && &jump == &jumps.back();
    places.insert(places.end(), is_cut ? 1 : 2, row);
    limits.insert(limits.end(), {jump.t / period, jump.before});
    if (!is_cut) limits.insert(limits.end(), {jump.t / period, jump.after});
    if (is_here()) ++row;  // of one time each row has one jump before it
  }
  return LineOfRows{{{t.data(), 1, period}, {v.data(), comparison.dof(), scale}},
                    0,
                    last,
                    std::move(places),
                    std::move(limits)}
      .line();
}

std::vector<Jump> reported_jumps(const Comparison& comparison, std::size_t mass, double scale) {
  std::vector<Jump> jumps;
  const auto& reported = comparison.history().impacts;
  if (!reported) return jumps;
  for (const auto& impact : *reported)
    if (!impact.v_before.empty() && !impact.v_after.empty())
      jumps.push_back({impact.t, impact.v_before[mass] / scale, impact.v_after[mass] / scale});
  return jumps;
}

// True impacts after the first row and up to the last one.
std::vector<Jump> true_jumps(const Comparison& comparison, std::size_t mass, double scale) {
  const auto& reference = comparison.reference();
  const auto& t = comparison.history().t;
  const auto i = static_cast<Eigen::Index>(mass);
  std::vector<Jump> jumps;
  const auto last = reference.impact_count(std::min(t.back(), reference.end()));
  for (auto k = reference.impact_count(t.front()) + 1; k <= last; ++k) {
    const auto impact = reference.impact(k);
    jumps.push_back({impact.t, impact.before.v[i] / scale, impact.after.v[i] / scale});
  }
  return jumps;
}

// A last jump within the last two steps that the other motion has not yet.
bool is_within_last_steps(const Comparison& comparison, double t) {
  return t >= comparison.history().t.back() - 2.0 * comparison.step();
}

bool last_found_is_alone(const Comparison& comparison) {
  const auto& impacts = comparison.impacts();
  if (impacts.empty() || !is_within_last_steps(comparison, impacts.back().t)) return false;
  const auto& matches = comparison.matches();
  // The true one may come after the end of the history.
  return matches.empty() || matches.back().found + 1 != impacts.size() ||
         matches.back().reference.t > comparison.history().t.back();
}

bool last_true_is_alone(const Comparison& comparison, std::span<const Jump> jumps) {
  if (jumps.empty() || !is_within_last_steps(comparison, jumps.back().t)) return false;
  const auto& matches = comparison.matches();
  return matches.empty() || matches.back().reference.t < jumps.back().t;
}

std::string graph_objection(const Comparison& comparison) {
  if (!comparison.has_velocities()) return Comparison::no_velocities;
  for (const double scale : comparison.v_envelope())
    if (!(scale > 0.0)) return "A mass has no velocity envelope to divide by.";
  return comparison.objection_to_sparse_rows();
}

// Both one-sided distances, mass by mass.
struct GraphDistances {
  std::vector<double> of_history, of_reference;
  std::string reason;
};

GraphDistances graph_distances(const Comparison& comparison) {
  GraphDistances found;
  found.reason = graph_objection(comparison);
  if (!found.reason.empty()) return found;
  for (std::size_t mass = 0; mass < comparison.dof(); ++mass) {
    const auto [history, reference] = filled_graphs(comparison, mass);
    const auto ahead = one_sided_distance(history, reference);
    const auto back = ahead.complete ? one_sided_distance(reference, history) : ahead;
    if (!back.complete) {
      found.reason = too_far_apart;
      return found;
    }
    found.of_history.push_back(ahead.value);
    found.of_reference.push_back(back.value);
  }
  return found;
}

MetricValue measured_or_not(const GraphDistances& found, std::vector<double> masses) {
  return found.reason.empty() ? measured(std::move(masses)) : not_measured(found.reason);
}

}  // namespace

FilledGraphs filled_graphs(const Comparison& comparison, std::size_t mass) {
  const double scale = comparison.v_envelope()[mass];
  const auto reported = reported_jumps(comparison, mass, scale);
  const auto exact = true_jumps(comparison, mass, scale);
  return {
      graph(comparison, mass, comparison.history().v, reported, last_found_is_alone(comparison)),
      graph(comparison, mass, comparison.reference_v(), exact,
            last_true_is_alone(comparison, exact))};
}

MetricValue measure_filled_graph(const Comparison& comparison) {
  const auto& found = comparison.shared(graph_distances);
  auto masses = found.of_history;
  for (std::size_t i = 0; i < masses.size(); ++i)
    masses[i] = std::max(masses[i], found.of_reference[i]);
  return measured_or_not(found, std::move(masses));
}

MetricValue measure_filled_graph_of_history(const Comparison& comparison) {
  const auto& found = comparison.shared(graph_distances);
  return measured_or_not(found, found.of_history);
}

MetricValue measure_filled_graph_of_reference(const Comparison& comparison) {
  const auto& found = comparison.shared(graph_distances);
  return measured_or_not(found, found.of_reference);
}

}  // namespace clackers::measure
