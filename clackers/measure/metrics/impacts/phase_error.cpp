#include "clackers/measure/metrics/definitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "clackers/base/constants.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::measure {
namespace {

struct Crossing {
  double t, speed;
};

// Sign changes of one mass's displacement. A row that is exactly 0 belongs to the sign before it,
// so it is a crossing once, or none where the mass turns back.
std::vector<Crossing> crossings(const Comparison& comparison, std::size_t mass,
                                std::span<const double> u, std::span<const double> v) {
  const auto n = comparison.dof();
  const auto& t = comparison.history().t;
  std::vector<Crossing> found;
  double sign = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double now = u[i * n + mass];
    if (now == 0.0) continue;
    const double side = now > 0.0 ? 1.0 : -1.0;
    if (sign != 0.0 && side != sign) {
      const double before = u[(i - 1) * n + mass], s = before / (before - now);
      const double speed =
          v.empty() ? nan : std::abs((1.0 - s) * v[(i - 1) * n + mass] + s * v[i * n + mass]);
      found.push_back({t[i - 1] + s * (t[i] - t[i - 1]), speed});
    }
    sign = side;
  }
  return found;
}

PhaseMarks crossing_marks(const Comparison& comparison, std::size_t mass) {
  const auto& history = comparison.history();
  const auto found = crossings(comparison, mass, history.u, history.v);
  const auto reference =
      crossings(comparison, mass, comparison.reference_u(), comparison.reference_v());
  PhaseMarks marks{.index = {},
                   .found = {},
                   .reference = {},
                   .speed_found = {},
                   .speed_true = {},
                   .per_period = 2.0,
                   .reason = {}};
  const auto count = std::min(found.size(), reference.size());
  for (std::size_t k = 0; k < count; ++k) {
    // Nearer to another mark of the reference: one is missing, or there is one too many.
    const double spacing = k > 0                  ? reference[k].t - reference[k - 1].t
                           : reference.size() > 1 ? reference[1].t - reference[0].t
                                                  : INFINITY;
    if (std::abs(found[k].t - reference[k].t) > 0.5 * spacing) {
      marks = {};
      marks.reason = fmt::format(
          "The zero crossings of mass {} do not follow the true ones: number {} is at {:.6g} s "
          "instead of {:.6g} s.",
          mass + 1, k + 1, found[k].t, reference[k].t);
      return marks;
    }
    marks.index.push_back(static_cast<double>(k));
    marks.found.push_back(found[k].t);
    marks.reference.push_back(reference[k].t);
    marks.speed_found.push_back(found[k].speed);
    marks.speed_true.push_back(reference[k].speed);
  }
  if (count < 2) marks.reason = fmt::format("Mass {} crosses zero less than twice.", mass + 1);
  return marks;
}

PhaseMarks impact_marks(const Comparison& comparison, std::size_t mass) {
  PhaseMarks marks;
  for (const auto& match : comparison.matches()) {
    const auto& impact = comparison.impacts()[match.found];
    marks.index.push_back(static_cast<double>(match.reference.index));
    marks.found.push_back(impact.t);
    marks.reference.push_back(match.reference.t);
    marks.speed_found.push_back(impact.v_before.empty() ? nan : std::abs(impact.v_before[mass]));
    marks.speed_true.push_back(std::abs(match.reference.before.v[static_cast<Eigen::Index>(mass)]));
  }
  if (marks.index.size() < 2) marks.reason = "Fewer than two impacts are matched.";
  return marks;
}

// One number a mass from its marks; not measured where it is NaN.
MetricValue over_masses(const Comparison& comparison, const char* missing, auto&& of_marks) {
  std::vector<double> masses;
  for (std::size_t mass = 0; mass < comparison.dof(); ++mass) {
    const auto marks = phase_marks(comparison, mass);
    if (!marks.reason.empty()) return not_measured(marks.reason);
    masses.push_back(of_marks(marks));
    if (std::isnan(masses.back())) return not_measured(missing);
  }
  double largest = 0.0;
  for (const double x : masses) largest = std::max(largest, std::abs(x));
  return {largest, std::move(masses), {}};
}

struct Lag {
  numerics::LineFit line;  // over the number of the mark [s]
  double spacing;          // of true marks [s]
};

Lag lag(const PhaseMarks& marks) {
  std::vector<double> lag(marks.index.size());
  for (std::size_t i = 0; i < lag.size(); ++i) lag[i] = marks.found[i] - marks.reference[i];
  return {numerics::fit_line(marks.index, lag),
          numerics::fit_line(marks.index, marks.reference).slope};
}

// 1 - exp(slope of ln speed a period); NaN where a speed is not known or 0.
double decay(const PhaseMarks& marks, const std::vector<double>& speed) {
  std::vector<double> logarithm;
  for (const double x : speed) {
    if (!(x > 0.0)) return nan;
    logarithm.push_back(std::log(x));
  }
  return -std::expm1(marks.per_period * numerics::fit_line(marks.index, logarithm).slope);
}

}  // namespace

PhaseMarks phase_marks(const Comparison& comparison, std::size_t mass) {
  const auto& t = comparison.history().t;
  const auto& reference = comparison.reference();
  const auto impacts = reference.impact_count(std::min(t.back(), reference.end())) -
                       reference.impact_count(t.front());
  return impacts >= 2 ? impact_marks(comparison, mass) : crossing_marks(comparison, mass);
}

MetricValue measure_period_error(const Comparison& comparison) {
  return over_masses(comparison, "", [](const PhaseMarks& marks) {
    const auto [line, spacing] = lag(marks);
    return line.slope / spacing;
  });
}

MetricValue measure_phase_error(const Comparison& comparison) {
  return over_masses(comparison, "", [](const PhaseMarks& marks) {
    const auto [line, spacing] = lag(marks);
    return line.at(marks.index.back()) / (marks.per_period * spacing);
  });
}

MetricValue measure_decay_error(const Comparison& comparison) {
  return over_masses(comparison, "The speed at marks is not known, or 0.",
                     [](const PhaseMarks& marks) {
                       return decay(marks, marks.speed_found) - decay(marks, marks.speed_true);
                     });
}

}  // namespace clackers::measure
