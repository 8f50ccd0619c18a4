#include "clackers/measure/metrics/definitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {
namespace {

std::string objection_to_arcs(const Comparison& comparison) {
  if (!comparison.has_velocities()) return Comparison::no_velocities;
  for (std::size_t i = 0; i < comparison.dof(); ++i)
    if (!(comparison.u_envelope()[i] > 0.0 && comparison.v_envelope()[i] > 0.0))
      return fmt::format("The reference motion of mass {} has no extent to divide by.", i + 1);
  const auto& t = comparison.history().t;
  const auto& reference = comparison.reference();
  const auto found = static_cast<long long>(comparison.impacts().size());
  const auto first = reference.impact_count(t.front());
  const auto expected = reference.impact_count(std::min(t.back(), reference.end())) - first;
  const auto shared = std::min(found, expected);
  if (found != expected) {
    const double odd_one = found > expected
                               ? comparison.impacts()[static_cast<std::size_t>(shared)].t
                               : reference.impact(first + shared + 1).t;
    if (odd_one < t.back() - 2.0 * comparison.step())
      return fmt::format(
          "The history has {} impacts and the reference {}, so no epsilon makes their "
          "flights close one by one.",
          found, expected);
  }
  return comparison.objection_to_sparse_rows();
}

}  // namespace

HybridArc HybridArc::of_history(const Comparison& comparison) {
  const auto& history = comparison.history();
  HybridArc arc(comparison, history.u, history.v);
  const auto ends = comparison.impact_ends();
  for (std::size_t k = 0; k < comparison.impacts().size(); ++k) {
    const auto& impact = comparison.impacts()[k];
    // An impact of several steps may end behind the beginning of another contact's.
    const double passed = k > 0 ? arc.impacts_.back().to : impact.t;
    arc.impacts_.push_back({std::max(impact.t, passed), std::max(ends[k], passed), impact.u,
                            impact.v_before, impact.v_after});
  }
  return arc;
}

HybridArc HybridArc::of_reference(const Comparison& comparison) {
  const auto& reference = comparison.reference();
  const auto& t = comparison.history().t;
  HybridArc arc(comparison, comparison.reference_u(), comparison.reference_v());
  const auto last = reference.impact_count(std::min(t.back(), reference.end()));
  for (auto k = reference.impact_count(t.front()) + 1; k <= last; ++k) {
    const auto impact = reference.impact(k);
    arc.impacts_.push_back({impact.t, impact.t, entries(impact.before.u), entries(impact.before.v),
                            entries(impact.after.v)});
  }
  return arc;
}

std::optional<Polyline> HybridArc::next() {
  const auto n = comparison_.dof();
  const auto& t = comparison_.history().t;
  LineOfRows flight{{{t.data(), 1, comparison_.impact_period()}}, row_, row_};
  for (std::size_t i = 0; i < n; ++i) {
    flight.columns.push_back({u_.data() + i, n, comparison_.u_envelope()[i]});
    flight.columns.push_back({v_.data() + i, n, comparison_.v_envelope()[i]});
  }
  const auto add = [&](std::size_t row, double time, const auto& u, const auto& v) {
    flight.places.push_back(row);
    flight.more.push_back(time / comparison_.impact_period());
    for (std::size_t i = 0; i < n; ++i) {
      flight.more.push_back(u[i] / comparison_.u_envelope()[i]);
      flight.more.push_back(v[i] / comparison_.v_envelope()[i]);
    }
  };
  const auto* last = passed_ > 0 ? &impacts_[passed_ - 1] : nullptr;
  const auto* end = passed_ < impacts_.size() ? &impacts_[passed_] : nullptr;
  for (; row_ < t.size() && (end == nullptr || is_before(*end, row_)); ++row_)
    if (last != nullptr && is_inside(*last, row_)) flight.first = row_ + 1;
  flight.last = row_;
  if (last != nullptr && last->is_known()) add(flight.first, last->to, last->u, last->after);
  if (end != nullptr && end->is_known()) add(row_, end->from, end->u, end->before);
  ++passed_;
  if (flight.first == row_ && flight.places.empty()) return {};
  return std::move(flight).line();
}

// Whether a row stands between the two ends of an impact that takes several steps.
bool HybridArc::is_inside(const Jump& impact, std::size_t row) const {
  const double t = comparison_.history().t[row];
  return t < impact.to ||
         (t == impact.to && impact.from < impact.to && comparison_.is_left_limit(row));
}

// Whether a row is on the earlier side of an impact.
bool HybridArc::is_before(const Jump& impact, std::size_t row) const {
  const double t = comparison_.history().t[row];
  if (t != impact.from) return t < impact.from;
  if (comparison_.is_left_limit(row)) return true;
  if (comparison_.is_right_limit(row) || !impact.is_known()) return false;
  const auto n = comparison_.dof();
  double to_before = 0.0, to_after = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double v = v_[row * n + i], scale = comparison_.v_envelope()[i];
    to_before = std::max(to_before, std::abs(v - impact.before[i]) / scale);
    to_after = std::max(to_after, std::abs(v - impact.after[i]) / scale);
  }
  return to_before <= to_after;
}

MetricValue measure_hybrid_closeness(const Comparison& comparison) {
  if (auto reason = objection_to_arcs(comparison); !reason.empty())
    return not_measured(std::move(reason));
  auto history = HybridArc::of_history(comparison), reference = HybridArc::of_reference(comparison);
  const auto flights = std::min(history.flights(), reference.flights());
  double epsilon = 0.0;
  for (std::size_t j = 0; j < flights; ++j) {
    const auto found = history.next(), expected = reference.next();
    if (!found || !expected)
      return not_measured(fmt::format("No row lies between impacts {} and {}.", j, j + 1));
    for (const auto& [from, to] : {std::pair(&*found, &*expected), {&*expected, &*found}}) {
      const auto distance = one_sided_distance(*from, *to, epsilon);
      if (!distance.complete) return not_measured(too_far_apart);
      epsilon = distance.value;
    }
  }
  return measured(epsilon);
}

}  // namespace clackers::measure
