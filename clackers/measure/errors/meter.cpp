#include "clackers/measure/errors/meter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/base/constants.hpp"

namespace clackers::measure {
double relative_bound(const model::Motion& reference, const model::Kinematics& scale, double t) {
  const auto bound = reference.error_bound(std::clamp(t, 0.0, reference.end()));
  double largest = 0.0;
  for (const auto part : {&model::Kinematics::u, &model::Kinematics::v})
    for (Eigen::Index i = 0; i < (scale.*part).size(); ++i)
      if ((scale.*part)[i] > 0.0) largest = std::max(largest, (bound.*part)[i] / (scale.*part)[i]);
  return largest;
}

double rounding_floor(const model::Motion& reference, const model::Kinematics& scale,
                      long long states, double first, double last) {
  // Each step rounds the state by about one unit; at worst they all add up.
  double floor = std::numeric_limits<double>::epsilon() * double(states);
  constexpr int parts = 16;
  for (int i = 0; i < parts; ++i)
    floor = std::max(floor, relative_bound(reference, scale, first + (last - first) * i / parts));
  return std::max(floor, relative_bound(reference, scale, last));
}

Scales scales_of(const model::Motion& reference, const model::ImpactProblem<>& problem) {
  const MechanicalEnergy energy(problem.system);
  const auto at = [&](double t) {
    const auto now = reference.at(t, model::Side::right);
    return energy.total(now.u.data(), now.v.data());
  };
  Scales scales{reference.peak(), at(problem.start.t)};
  constexpr int parts = 1024;
  if (problem.system.add_load || !problem.frictions.empty() || !(scales.energy > 0.0))
    for (int i = 1; i <= parts; ++i)
      scales.energy = std::max(scales.energy, at(reference.end() * i / parts));
  return scales;
}

Meter::Meter(const model::Motion& reference, const model::ImpactProblem<>& problem, Scales scales)
    : reference_(reference),
      dof_(std::size_t(reference.dof())),
      scales_(std::move(scales)),
      errors_(dof_, problem.system),
      first_(problem.start.t),
      last_(first_),
      velocity_(reference) {}

void Meter::take(std::span<const double> t, const StateRows& found, const StateRows& reference) {
  if (t.empty()) return;
  if (states_ == 0) first_ = t.front();
  last_ = t.back();
  states_ += std::ssize(t);
  has_velocities_ = !found.v.empty();
  for (std::size_t from = 0; from < t.size(); from += StateErrors::most) {
    const auto count = std::min(StateErrors::most, t.size() - from), row = from * dof_;
    errors_.take(count, &found.u[row], has_velocities_ ? &found.v[row] : nullptr, &reference.u[row],
                 has_velocities_ ? &reference.v[row] : nullptr);
    if (has_velocities_) velocity_.take(t.subspan(from, count), errors_);
  }
}

RunScore Meter::score() const {
  RunScore score;
  score.energy_error =
      has_velocities_ && scales_.energy > 0.0 ? errors_.energy() / scales_.energy : unknown;
  score.energy_ratio = errors_.energy_ratio();
  score.v_error = has_velocities_ ? 0.0 : unknown;
  score.rounding_floor = rounding_floor(reference_, scales_.peak, states_, first_, last_);
  const double length = last_ - first_;
  for (std::size_t j = 0; j < dof_; ++j) {
    const auto mass = Eigen::Index(j);
    const double error = errors_.u()[j];
    score.u_error_absolute = std::max(score.u_error_absolute, error);
    score.u_error = std::max(score.u_error, error / scales_.peak.u[mass]);
    if (has_velocities_ && length > 0.0)
      score.v_error =
          std::max(score.v_error, velocity_.integral(int(j)) / (length * scales_.peak.v[mass]));
  }
  if (!errors_.is_finite())
    score.u_error = score.u_error_absolute = score.v_error = score.energy_error = infinity;
  return score;
}

}  // namespace clackers::measure
