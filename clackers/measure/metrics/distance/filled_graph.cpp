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

// Rows (t, v) joined with jumps, both in order of time, every v scaled. A jump at the time of a row
// comes before it or after it, whichever of its limits is that row's.
class GraphBuilder {
 public:
  // With a `cut` the line ends with the left limit of the last jump.
  GraphBuilder(double period, std::span<const Jump> jumps, bool cut)
      : period_(period), jumps_(jumps), cut_(cut && !jumps.empty()) {}

  void row(double t, double v) {
    if (cut_ && t >= jumps_.back().t) return;
    while (next_ < jumps_.size() && jumps_[next_].t < t) jump();
    if (next_ < jumps_.size() && jumps_[next_].t == t &&
        std::abs(v - jumps_[next_].after) < std::abs(v - jumps_[next_].before))
      jump();
    put(t, v);
  }
  Polyline finish() && {
    while (next_ < jumps_.size()) jump();
    return std::move(line_);
  }
  void reserve(std::size_t rows) { line_.points.reserve(2 * (rows + 2 * jumps_.size())); }

 private:
  void jump() {
    const auto& [t, before, after] = jumps_[next_++];
    put(t, before);
    if (!(cut_ && next_ == jumps_.size())) put(t, after);
  }
  void put(double t, double v) {
    line_.points.push_back(t / period_);
    line_.points.push_back(v);
  }

  double period_;
  std::span<const Jump> jumps_;
  bool cut_;
  std::size_t next_ = 0;
  Polyline line_;
};

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

Polyline history_graph(const Comparison& comparison, std::size_t mass) {
  const auto& history = comparison.history();
  const double scale = comparison.v_envelope()[mass];
  const auto jumps = reported_jumps(comparison, mass, scale);
  GraphBuilder graph(comparison.impact_period(), jumps, last_found_is_alone(comparison));
  graph.reserve(history.t.size());
  for (std::size_t i = 0; i < history.t.size(); ++i)
    graph.row(history.t[i], history.v[i * comparison.dof() + mass] / scale);
  return std::move(graph).finish();
}

Polyline reference_graph(const Comparison& comparison, std::size_t mass) {
  const auto& t = comparison.history().t;
  const double scale = comparison.v_envelope()[mass];
  const auto jumps = true_jumps(comparison, mass, scale);
  GraphBuilder graph(comparison.impact_period(), jumps, last_true_is_alone(comparison, jumps));
  graph.reserve(t.size());
  for (std::size_t i = 0; i < t.size(); ++i)
    graph.row(t[i], comparison.reference_v()[i * comparison.dof() + mass] / scale);
  return std::move(graph).finish();
}

std::string graph_objection(const Comparison& comparison) {
  if (!comparison.has_velocities()) return "The history has no velocities.";
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
  return {history_graph(comparison, mass), reference_graph(comparison, mass)};
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
