#include "clackers/assess/metrics/distance/filled_graph.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "clackers/assess/metrics/collision_period.hpp"
#include "clackers/assess/metrics/value.hpp"

namespace clackers::assess {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

std::vector<double> true_velocities(const Comparison& comparison, std::size_t mass,
                                    std::span<const double> times) {
  const auto dof = comparison.dof();
  std::vector<double> u(times.size() * dof), v(times.size() * dof), wanted(times.size());
  comparison.reference().sample(times, model::Side::right, {u, v, {}});
  for (std::size_t i = 0; i < times.size(); ++i) wanted[i] = v[i * dof + mass];
  return wanted;
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

Polyline true_graph(const Comparison& comparison, std::size_t mass, double chord) {
  const auto& t = comparison.history().t;
  const auto dof = comparison.dof();
  const double scale = comparison.v_envelope()[mass];
  // Points so close that h^2/8 |v''| <= chord V.
  const double step =
      chord > 0.0 ? std::sqrt(8.0 * chord * scale / jerk_bound(comparison, mass)) : 0.0;
  const auto jumps = true_jumps(comparison, mass, scale);
  GraphBuilder graph(collision_period(comparison.reference()), jumps,
                     last_true_is_alone(comparison, jumps));
  graph.reserve(t.size());
  std::vector<double> times;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i > 0 && step > 0.0 && t[i] - t[i - 1] > step) {
      const double length = t[i] - t[i - 1], parts = std::ceil(length / step);
      times.clear();
      for (double k = 1.0; k < parts; k += 1.0) times.push_back(t[i - 1] + k * (length / parts));
      const auto v = true_velocities(comparison, mass, times);
      for (std::size_t k = 0; k < times.size(); ++k) graph.row(times[k], v[k] / scale);
    }
    graph.row(t[i], comparison.true_v()[i * dof + mass] / scale);
  }
  return std::move(graph).finish();
}

template <class OfMass>
MetricValue over_masses(const Comparison& comparison, OfMass&& of_mass) {
  if (const auto objection = objection_to_filled_graph(comparison); !objection.empty())
    return not_measured(objection);
  std::vector<double> masses;
  for (std::size_t mass = 0; mass < comparison.dof(); ++mass) masses.push_back(of_mass(mass));
  return measured(std::move(masses));
}

}  // namespace

std::string objection_to_filled_graph(const Comparison& comparison) {
  if (!comparison.has_velocities()) return "The history has no velocities.";
  for (const double scale : comparison.v_envelope())
    if (!(scale > 0.0)) return "A mass has no velocity envelope at t = 0 to divide by.";
  const auto rows = comparison.history().t.size();
  const auto& t = comparison.history().t;
  const auto& reference = comparison.reference();
  const auto jumps = reference.impact_count(std::min(t.back(), reference.end())) -
                     reference.impact_count(t.front());
  // Each costs several rows; a history that is so far from resolving them shows nothing of them.
  if (double(jumps) > 10.0 * double(rows) + 1000.0)
    return fmt::format("The history has {} rows for {} true impacts.", rows, jumps);
  return {};
}

FilledGraphs filled_graphs(const Comparison& comparison, std::size_t mass, double chord) {
  const auto& history = comparison.history();
  const double scale = comparison.v_envelope()[mass];
  const auto jumps = reported_jumps(comparison, mass, scale);
  GraphBuilder graph(collision_period(comparison.reference()), jumps,
                     last_found_is_alone(comparison));
  graph.reserve(history.t.size());
  for (std::size_t i = 0; i < history.t.size(); ++i)
    graph.row(history.t[i], history.v[i * comparison.dof() + mass] / scale);
  return {std::move(graph).finish(), true_graph(comparison, mass, chord)};
}

double jerk_bound(const Comparison& comparison, std::size_t mass) {
  const auto& system = comparison.problem().system;
  if (system.add_load || system.nonlinear) return nan;
  const auto envelope = comparison.reference().envelope(0.0);
  const Eigen::MatrixXd inverse = system.mass.inverse();
  const Eigen::VectorXd bound = (inverse * system.damping).cwiseAbs() * envelope.a +
                                (inverse * system.stiffness).cwiseAbs() * envelope.v;
  return bound[static_cast<Eigen::Index>(mass)];
}

double chord_of_rows(const Comparison& comparison, std::size_t mass) {
  const auto& t = comparison.history().t;
  double longest = 0.0;
  for (std::size_t i = 1; i < t.size(); ++i) longest = std::max(longest, t[i] - t[i - 1]);
  return longest * longest / 8.0 * jerk_bound(comparison, mass) / comparison.v_envelope()[mass];
}

CurveDistance distance_to_curve(const Comparison& comparison, std::size_t mass,
                                double most_points) {
  const auto& t = comparison.history().t;
  const double length = t.back() - t.front(), scale = comparison.v_envelope()[mass];
  const double relative_jerk = jerk_bound(comparison, mass) / scale;
  if (std::isnan(relative_jerk)) return {.value = nan, .chord = nan, .resolved = false};
  const double least = relative_jerk / 8.0 * std::pow(length / most_points, 2);
  CurveDistance result{.value = 0.0, .chord = std::max(1e-3, least), .resolved = false};
  for (;;) {
    const auto [history, reference] = filled_graphs(comparison, mass, result.chord);
    result.value = hausdorff_distance(history, reference).value;
    result.resolved = result.chord <= 0.01 * result.value;
    if (result.resolved || result.chord <= least) return result;
    // The distance found is at most the chord away from its limit, so half of what is needed for it
    // is enough next time, unless it has still to shrink.
    result.chord = std::max({0.005 * result.value, least, 1e-3 * result.chord});
  }
}

MetricValue measure_filled_graph(const Comparison& comparison) {
  return over_masses(comparison, [&](std::size_t mass) {
    const auto [history, reference] = filled_graphs(comparison, mass);
    return hausdorff_distance(history, reference).value;
  });
}

MetricValue measure_filled_graph_of_history(const Comparison& comparison) {
  return over_masses(comparison, [&](std::size_t mass) {
    const auto [history, reference] = filled_graphs(comparison, mass);
    return one_sided_distance(history, reference).value;
  });
}

MetricValue measure_filled_graph_of_reference(const Comparison& comparison) {
  return over_masses(comparison, [&](std::size_t mass) {
    const auto [history, reference] = filled_graphs(comparison, mass);
    return one_sided_distance(reference, history).value;
  });
}

}  // namespace clackers::assess
