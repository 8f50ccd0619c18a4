#include "clackers/diagnose/system/fit_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clackers::diagnose {

namespace {

// At most `most` of the first `size` rows that are later than those taken already.
void take(const model::Trajectory& rows, std::size_t size, std::size_t most, double last,
          FitRows& to) {
  const auto n = std::size_t(rows.dof);
  const std::size_t stride = std::max<std::size_t>(1, (size + most - 1) / most);
  for (std::size_t i = 0; i < size; i += stride) {
    const double t = rows.t[i];
    if (t > last || (!to.t.empty() && !(t > to.t.back()))) continue;
    to.t.push_back(t);
    for (std::size_t j = 0; j < n; ++j) to.u.push_back(rows.u[i * n + j] * to.inverse_scale[j]);
  }
}

}  // namespace

double rms(std::span<const double> values) {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const double one : values) sum += one * one;
  return std::sqrt(sum / double(values.size()));
}

std::vector<double> FitRows::residual(const Variation& variation, std::size_t rows) const {
  auto found = simulated(variation, std::span(t).first(rows));
  if (!found) return {};
  for (std::size_t i = 0; i < found->size(); ++i) {
    double& one = (*found)[i];
    const double left = u[i] - one * inverse_scale[i % dof()];
    one = std::isnan(left) ? 0.0 : left;
  }
  return std::move(*found);
}

FitRows fit_rows(const Observation& observation, const model::Motion& motion) {
  FitRows rows;
  const auto scale = motion.peak();
  for (Eigen::Index j = 0; j < scale.u.size(); ++j)
    rows.inverse_scale.push_back(scale.u[j] > 0.0 ? 1.0 / scale.u[j] : 0.0);
  const auto& sample = observation.sample;
  if (sample.t.size() < 8) {
    rows.floor = std::numeric_limits<double>::infinity();
    return rows;
  }
  const auto& opening = observation.opening;
  take(opening, opening.t.size() / 10, most_fit_opening_rows / 2, motion.end(), rows);
  take(opening, opening.t.size(), most_fit_opening_rows, motion.end(), rows);
  take(sample, sample.t.size(), most_fit_rows, motion.end(), rows);
  const auto n = rows.dof();
  rows.reference.resize(rows.u.size());
  std::vector<double> v(rows.u.size());
  motion.sample(rows.t, model::Side::right, {rows.reference, v, {}});
  auto apart = rows.u;
  for (std::size_t i = 0; i < apart.size(); ++i)
    apart[i] -= rows.reference[i] *= rows.inverse_scale[i % n];
  rows.distance = rms(apart);
  rows.floor = std::max(observation.facts.floor, 1e-13);
  return rows;
}

double late_start(const Observation& observation, const model::Motion& motion) {
  constexpr double rounding = 1e-6;
  const auto& rows = observation.opening;
  if (rows.t.empty() || !(rows.t[0] > 0.0)) return 0.0;
  const auto start = motion.at(0.0, model::Side::right), scale = motion.peak();
  const double same = rounding + 2.0 * observation.facts.floor;
  for (Eigen::Index i = 0; i < start.u.size(); ++i) {
    const auto at = std::size_t(i);
    if (!(std::abs(rows.u[at] - start.u[i]) <= same * scale.u[i])) return 0.0;
    if (!rows.v.empty() && !(std::abs(rows.v[at] - start.v[i]) <= same * scale.v[i])) return 0.0;
  }
  return rows.t[0];
}

FitRows fit_rows(const Observation& observation, const model::ImpactProblem<>& problem,
                 const model::Motion& motion) {
  auto rows = fit_rows(observation, motion);
  if (rows.t.empty()) return rows;
  // How far the simulation is from the reference, as the problem stands and with frequencies changed
  // in their last digits: both must be small against the distance.
  Variation same{problem};
  FitRows exact = rows;
  exact.u = rows.reference;
  for (const double change : {0.0, 1e-14}) {
    Variation changed = same;
    changed.apply({Change::frequency, -1}, change);
    rows.floor = std::max(rows.floor, rms(exact.residual(changed, rows.t.size())));
  }
  return rows;
}

}  // namespace clackers::diagnose
