#include "clackers/diagnose/ladder/error_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clackers::diagnose {
namespace {

constexpr long long most_reference_impacts = 2000;

}  // namespace

ErrorCurve::ErrorCurve(const Observation& seen, const model::Motion& motion,
                       const Eigen::VectorXd& scale) {
  const auto& rows = seen.sample;
  const auto dof = std::size_t(motion.dof());
  for (const double t : rows.t)
    if (t >= 0.0 && t <= motion.end()) t_.push_back(t);
  const auto skipped = std::size_t(std::ranges::lower_bound(rows.t, 0.0) - rows.t.begin());
  std::vector<double> u(t_.size() * dof), v(u.size());
  motion.sample(t_, model::Side::right, {u, v, {}});
  const bool has_v = !rows.v.empty();
  e_.resize(Eigen::Index(dof), Eigen::Index(t_.size()));
  if (has_v) rate_.resize(e_.rows(), e_.cols());
  for (std::size_t row = 0; row < t_.size(); ++row)
    for (std::size_t mass = 0; mass < dof; ++mass) {
      const auto i = Eigen::Index(mass), j = Eigen::Index(row);
      const auto here = row * dof + mass, there = (row + skipped) * dof + mass;
      e_(i, j) = (rows.u[there] - u[here]) / scale[i];
      if (has_v) rate_(i, j) = (rows.v[there] - v[here]) / scale[i];
    }
  if (rows.impacts)
    for (const auto& impact : *rows.impacts) impacts_.push_back(impact.t);
  const auto known = std::min(most_reference_impacts, motion.impact_count(motion.end()));
  for (long long k = 1; k <= known; ++k) impacts_.push_back(motion.impact(k).t);
  std::ranges::sort(impacts_);
}

bool ErrorCurve::has_impact(double from, double to) const {
  const auto next = std::ranges::lower_bound(impacts_, from);
  return next != impacts_.end() && *next <= to;
}

std::optional<Eigen::VectorXd> ErrorCurve::at(double t) const {
  const auto next = std::ranges::upper_bound(t_, t);
  if (next == t_.begin()) return {};
  auto i = Eigen::Index(next - t_.begin()) - 1;
  if (next == t_.end()) {
    if (t_.back() < t) return {};
    --i;
  }
  if (i < 0) return {};
  const auto row = std::size_t(i);
  const double s = t_[row + 1] - t_[row];
  if (!(s > 0.0) || has_impact(t_[row], t_[row + 1])) return {};
  const double x = (t - t_[row]) / s;
  if (rate_.size() > 0) {
    const double a = (1.0 + 2.0 * x) * (1.0 - x) * (1.0 - x), b = x * (1.0 - x) * (1.0 - x);
    const double c = x * x * (3.0 - 2.0 * x), d = x * x * (x - 1.0);
    return a * e_.col(i) + s * b * rate_.col(i) + c * e_.col(i + 1) + s * d * rate_.col(i + 1);
  }
  if (i < 1 || i + 2 >= e_.cols() || has_impact(t_[row - 1], t_[row + 2])) return {};
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(e_.rows());
  for (std::size_t j = row - 1; j <= row + 2; ++j) {
    double weight = 1.0;
    for (std::size_t k = row - 1; k <= row + 2; ++k)
      if (k != j) weight *= (t - t_[k]) / (t_[j] - t_[k]);
    sum += weight * e_.col(Eigen::Index(j));
  }
  return sum;
}

double ErrorCurve::largest() const {
  double largest = 0.0;
  for (const double error : e_.reshaped())
    if (std::isfinite(error)) largest = std::max(largest, std::abs(error));
  return largest;
}

}  // namespace clackers::diagnose
