#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {

/// Synchrony counts as lost when the time between two impacts is wrong by this part of T.
inline constexpr double lost_synchrony = 0.1;

/// How a run of impacts lost synchrony, or how far it kept it.
struct SynchronyLoss {
  long long impacts = 0;          ///< looked at
  std::optional<long long> lost;  ///< the first one, from 1, whose spacing is wrong
  double worst = 0.0;             ///< largest error of a spacing, over T, up to the loss
  /// Growth per impact of what ends in the loss, the momentum after impacts: the slope of ln|p|,
  /// p = sum of m v over sum of |m v|, 0 in synchrony, over the impacts since |p| last rose
  /// above 0.025 and before the loss. Below that the growth is not yet exponential, since the
  /// method feeds it all the time. The spacing itself hardly changes until masses touch where they
  /// should not. NaN for fewer than 3 impacts, and where momenta are not known.
  double growth = 0.0;
};

/// Looks at impacts as they come. The spacing of an impact is the
/// time since the one before it, of the first one since the start.
class SynchronyWatch {
 public:
  /// `period` T > 0 [s]; throws InputError otherwise. `start` is the time of the run's start [s].
  explicit SynchronyWatch(double period, double start = 0.0);

  /// The next impact of the history and the true one with the same number [s], with p after it;
  /// NaN: not known. Those after the loss are ignored.
  void take(double found, double reference, double momentum);
  SynchronyLoss loss() const;

 private:
  double period_, found_, reference_, worst_ = 0.0;
  long long count_ = 0;
  std::optional<long long> lost_;
  std::vector<double> momenta_;  ///< ln|p| since it last rose
};

/// p after an impact: sum of (M v)_i over sum of |(M v)_i|; NaN for one mass, and at rest.
double relative_momentum(const model::SmoothSystem<>& system, std::span<const double> v);

/// The loss of the history's impacts against the true ones, number by number, T as in
/// Comparison::impact_period(). Stops at the shorter list.
SynchronyLoss synchrony_loss(const Comparison& comparison);

/// What is known of a pair, and of a method on it, for the part that detuning explains.
struct DetuningFacts {
  double rate = 0.0;  ///< growth per impact and unit of |eps|: exact::detuning_rate of the pair
  double eta = 1.0;   ///< restitution, in (0, 1]
  double eps = 0.0;   ///< the method's: damped frequencies in the ratio X (1 + eps); see detuning()
};

/// The part of a loss of synchrony that a method's own frequencies explain.
struct DetuningPart {
  double growth = 0.0;  ///< predicted, per impact: rate |eps| + ln(1/eta)
  /// Predicted loss: ln(0.1/|eps|)/growth rounded up, as exact::impacts_until_detuning;
  /// infinite where nothing grows, 0 for |eps| >= 0.1.
  double impact = 0.0;
  /// Predicted growth over the measured one: 1 where detuning explains all of it, less where other
  /// errors help, more where they hinder it. NaN where no growth was measured.
  double share = 0.0;
};

/// Throws InputError unless rate >= 0, 0 < eta <= 1 and 0 < |eps| < 1. Source: to first order in
/// eps, from the saltation matrices of the pair; exact/quantities/conditioning.hpp.
DetuningPart explained_by_detuning(const SynchronyLoss& loss, const DetuningFacts& facts);

/// Row of the table of metrics: the largest error of a spacing over T, to the loss if there is one.
MetricValue measure_spacing_error(const Comparison& comparison);

}  // namespace clackers::measure
