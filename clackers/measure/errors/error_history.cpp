#include "clackers/measure/errors/error_history.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::measure {

ErrorHistory::ErrorHistory(int bins, int dof, double start, double end)
    : bins_(bins), dof_(dof), start_(start), width_(bins > 0 ? (end - start) / bins : 0.0) {
  if (bins < 0) refuse("error history", "bins", bins, "0 or more");
  largest_.resize(std::size_t(bins) * std::size_t(dof), 0.0);
  seen_.resize(std::size_t(bins), false);
}

void ErrorHistory::put(double t, std::span<const double> errors) {
  const auto bin = std::size_t(std::clamp(int((t - start_) / width_), 0, bins_ - 1));
  seen_[bin] = true;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    double& most = largest_[bin * std::size_t(dof_) + i];
    // Written so that an error which is no number stays visible.
    if (!(errors[i] <= most) && !std::isnan(most)) most = errors[i];
  }
}

std::vector<double> ErrorHistory::times() const {
  std::vector<double> middles;
  for (int i = 0; i < bins_; ++i)
    if (seen_[std::size_t(i)]) middles.push_back(start_ + (i + 0.5) * width_);
  return middles;
}

std::vector<double> ErrorHistory::largest(int mass) const {
  std::vector<double> errors;
  for (int i = 0; i < bins_; ++i)
    if (seen_[std::size_t(i)]) errors.push_back(largest_[std::size_t(i * dof_ + mass)]);
  return errors;
}

}  // namespace clackers::measure
