#include "clackers/assess/metrics/distance/hybrid_arc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "clackers/assess/metrics/collision_period.hpp"
#include "clackers/assess/metrics/value.hpp"

namespace clackers::assess {
namespace {

// An impact that divides two flights; vectors are empty where its limits are not known.
struct Divide {
  double from, to;  // [s]
  std::vector<double> u, before, after;

  bool is_known() const { return !u.empty() && !before.empty() && !after.empty(); }
};

class ArcBuilder {
 public:
  ArcBuilder(const Comparison& comparison, std::vector<Divide> divides)
      : comparison_(comparison),
        divides_(std::move(divides)),
        period_(collision_period(comparison.reference())) {
    open();
  }

  // Rows with these states, row-major.
  HybridArc build(std::span<const double> u, std::span<const double> v) && {
    const auto n = comparison_.dof();
    for (std::size_t row = 0; row < comparison_.rows(); ++row) {
      const double t = comparison_.history().t[row];
      const auto row_v = v.subspan(row * n, n);
      while (next_ < divides_.size() &&
             (divides_[next_].from < t || (divides_[next_].from == t && !is_before(row, row_v))))
        divide();
      if (next_ > 0 && is_inside(divides_[next_ - 1], row)) continue;
      put(t, u.subspan(row * n, n), row_v);
    }
    while (next_ < divides_.size()) divide();
    return std::move(arc_);
  }

 private:
  void open() { arc_.push_back({.dimension = 1 + 2 * comparison_.dof(), .points = {}}); }

  // Whether a row stands between the two ends of an impact that takes several steps.
  bool is_inside(const Divide& divide, std::size_t row) const {
    const double t = comparison_.history().t[row];
    return t < divide.to ||
           (t == divide.to && divide.from < divide.to && comparison_.is_left_limit(row));
  }

  // Whether a row at the instant of the next impact is on its earlier side.
  bool is_before(std::size_t row, std::span<const double> v) const {
    if (comparison_.is_left_limit(row)) return true;
    const auto& divide = divides_[next_];
    if (comparison_.is_right_limit(row) || !divide.is_known()) return false;
    double to_before = 0.0, to_after = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double scale = comparison_.v_envelope()[i];
      to_before = std::max(to_before, std::abs(v[i] - divide.before[i]) / scale);
      to_after = std::max(to_after, std::abs(v[i] - divide.after[i]) / scale);
    }
    return to_before <= to_after;
  }

  void divide() {
    const auto& at = divides_[next_++];
    if (at.is_known()) put(at.from, at.u, at.before);
    open();
    if (at.is_known()) put(at.to, at.u, at.after);
  }

  void put(double t, std::span<const double> u, std::span<const double> v) {
    auto& points = arc_.back().points;
    points.push_back(t / period_);
    for (std::size_t i = 0; i < u.size(); ++i) {
      points.push_back(u[i] / comparison_.u_envelope()[i]);
      points.push_back(v[i] / comparison_.v_envelope()[i]);
    }
  }

  const Comparison& comparison_;
  std::vector<Divide> divides_;
  double period_;
  std::size_t next_ = 0;
  HybridArc arc_;
};

std::vector<double> list(const Eigen::VectorXd& x) { return {x.data(), x.data() + x.size()}; }

std::string objection(const Comparison& comparison) {
  if (!comparison.has_velocities()) return "The history has no velocities.";
  for (std::size_t i = 0; i < comparison.dof(); ++i)
    if (!(comparison.u_envelope()[i] > 0.0 && comparison.v_envelope()[i] > 0.0))
      return fmt::format("The true motion of mass {} has no extent at t = 0 to divide by.", i + 1);
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
  return {};
}

}  // namespace

HybridArc history_arc(const Comparison& comparison) {
  std::vector<Divide> divides;
  const auto ends = comparison.impact_ends();
  for (std::size_t k = 0; k < comparison.impacts().size(); ++k) {
    const auto& impact = comparison.impacts()[k];
    divides.push_back({impact.t, ends[k], impact.u, impact.v_before, impact.v_after});
  }
  const auto& history = comparison.history();
  return ArcBuilder(comparison, std::move(divides)).build(history.u, history.v);
}

HybridArc true_arc(const Comparison& comparison) {
  const auto& reference = comparison.reference();
  const auto& t = comparison.history().t;
  std::vector<Divide> divides;
  const auto last = reference.impact_count(std::min(t.back(), reference.end()));
  for (auto k = reference.impact_count(t.front()) + 1; k <= last; ++k) {
    const auto impact = reference.impact(k);
    divides.push_back(
        {impact.t, impact.t, list(impact.before.u), list(impact.before.v), list(impact.after.v)});
  }
  return ArcBuilder(comparison, std::move(divides)).build(comparison.true_u(), comparison.true_v());
}

MetricValue measure_hybrid_closeness(const Comparison& comparison) {
  if (auto reason = objection(comparison); !reason.empty()) return not_measured(std::move(reason));
  const auto history = history_arc(comparison), reference = true_arc(comparison);
  const auto flights = std::min(history.size(), reference.size());
  double epsilon = 0.0;
  for (std::size_t j = 0; j < flights; ++j) {
    for (const auto* arc : {&history, &reference})
      if ((*arc)[j].points.empty())
        return not_measured(fmt::format("No row lies between impacts {} and {}.", j, j + 1));
    epsilon = one_sided_distance(history[j], reference[j], epsilon).value;
    epsilon = one_sided_distance(reference[j], history[j], epsilon).value;
  }
  return measured(epsilon);
}

}  // namespace clackers::assess
