#include "clackers/measure/metrics/causes.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {
namespace {

class Distances {
 public:
  explicit Distances(const Comparison& comparison) : comparison_(comparison) {}

  MetricValue largest(std::span<const double> values, std::span<const double> other) const {
    const auto n = comparison_.dof();
    std::vector<double> masses(n, 0.0);
    for (std::size_t at = 0; at < values.size(); ++at)
      masses[at % n] = std::max(masses[at % n], std::abs(values[at] - other[at]));
    return relative_to(measured(std::move(masses)), comparison_.u_envelope());
  }

  MetricValue mean(std::span<const double> values, std::span<const double> other) const {
    const auto n = comparison_.dof();
    const auto& t = comparison_.history().t;
    const double length = t.back() - t.front();
    std::vector<double> masses(n, 0.0);
    for (std::size_t at = n; at < values.size(); ++at) {
      const auto row = at / n;
      masses[at % n] +=
          0.5 * (t[row] - t[row - 1]) / length *
          (std::abs(values[at] - other[at]) + std::abs(values[at - n] - other[at - n]));
    }
    return relative_to(measured(std::move(masses)), comparison_.v_envelope());
  }

 private:
  const Comparison& comparison_;
};

}  // namespace

PenaltySplit penalty_split(const Comparison& comparison, const model::Motion& penalized) {
  const auto n = comparison.dof();
  if (penalized.dof() != static_cast<int>(n))
    refuse("penalty split", "masses of the penalized motion", penalized.dof(),
           "as many as the history has", {}, "wrong-size");
  const auto& history = comparison.history();
  auto times = history.t;
  // A count of steps times h may pass the end by a rounding; more is refused by sample().
  const double slack = 0x1p-50 * penalized.end();
  for (double& t : times)
    if (t > penalized.end() && t <= penalized.end() + slack) t = penalized.end();
  std::vector<double> u(times.size() * n), v(times.size() * n);
  penalized.sample(times, model::Side::right, {u, v, {}});

  const Distances distances(comparison);
  PenaltySplit split;
  split.model_u = distances.largest(u, comparison.reference_u());
  split.integration_u = distances.largest(history.u, u);
  split.model_v = distances.mean(v, comparison.reference_v());
  split.integration_v = comparison.has_velocities() ? distances.mean(history.v, v)
                                                    : not_measured(Comparison::no_velocities);
  return split;
}

}  // namespace clackers::measure
