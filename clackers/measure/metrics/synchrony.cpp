#include "clackers/measure/metrics/causes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "clackers/base/check.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::measure {
namespace {

constexpr double visible = 0.025;  // relative momentum from which on growth is fitted
constexpr std::size_t fewest = 3;  // points of a fit

}  // namespace

SynchronyWatch::SynchronyWatch(double period, double start)
    : period_(require_positive("synchrony", "period", period)), found_(start), reference_(start) {}

void SynchronyWatch::take(double found, double reference, double momentum) {
  if (lost_) return;
  ++count_;
  const double error = std::abs((found - found_) - (reference - reference_)) / period_;
  found_ = found;
  reference_ = reference;
  worst_ = std::max(worst_, error);
  if (error > lost_synchrony) {
    lost_ = count_;
    return;
  }
  const double size = std::abs(momentum);
  if (size > visible)
    momenta_.push_back(std::log(size));
  else
    momenta_.clear();
}

SynchronyLoss SynchronyWatch::loss() const {
  std::vector<double> numbers(momenta_.size());
  std::iota(numbers.begin(), numbers.end(), 0.0);
  return {.impacts = count_,
          .lost = lost_,
          .worst = worst_,
          .growth = numbers.size() >= fewest ? numerics::fit_line(numbers, momenta_).slope : nan};
}

double relative_momentum(const model::SmoothSystem<>& system, std::span<const double> v) {
  if (v.size() < 2) return nan;
  const Eigen::Map<const Eigen::VectorXd> velocity(v.data(), static_cast<Eigen::Index>(v.size()));
  const Eigen::VectorXd momenta = system.mass * velocity;
  return momenta.sum() / momenta.cwiseAbs().sum();
}

SynchronyLoss synchrony_loss(const Comparison& comparison) {
  const auto& reference = comparison.reference();
  const auto& t = comparison.history().t;
  const auto first = reference.impact_count(t.front());
  const auto known = reference.impact_count(reference.end());
  SynchronyWatch watch(comparison.impact_period(), t.front());
  for (std::size_t k = 0; k < comparison.impacts().size(); ++k) {
    const auto index = first + static_cast<long long>(k) + 1;
    if (index > known) break;
    const auto& impact = comparison.impacts()[k];
    watch.take(impact.t, reference.impact(index).t,
               impact.v_after.empty()
                   ? nan
                   : relative_momentum(comparison.problem().system, impact.v_after));
  }
  return watch.loss();
}

DetuningPart explained_by_detuning(const SynchronyLoss& loss, const DetuningFacts& facts) {
  require_within("detuning", "rate", facts.rate, 0.0, std::numeric_limits<double>::max());
  const double size = std::abs(facts.eps);
  if (!(size > 0.0 && size < 1.0)) refuse("detuning", "eps", facts.eps, "0 < |eps| < 1");
  if (!(facts.eta > 0.0 && facts.eta <= 1.0)) refuse("detuning", "eta", facts.eta, "0 < eta <= 1");
  DetuningPart part;
  part.growth = facts.rate * size - std::log(facts.eta);
  part.impact =
      size >= lost_synchrony ? 0.0 : std::ceil(std::log(lost_synchrony / size) / part.growth);
  part.share = part.growth / loss.growth;
  return part;
}

MetricValue measure_spacing_error(const Comparison& comparison) {
  const auto loss = synchrony_loss(comparison);
  if (loss.impacts == 0) return not_measured("The history or the reference has no impacts.");
  return measured(loss.worst);
}

}  // namespace clackers::measure
