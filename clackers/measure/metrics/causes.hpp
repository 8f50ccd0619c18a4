#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/model/motion.hpp"

// Metrics that give a cause of a run's error, from Comparison::facts().
namespace clackers::measure {

/// The error of a run with compliant contacts in two parts: what its model is wrong by, and what
/// its integration is. `penalized` is the exact motion with the run's own contact springs.
///
/// - u: max over the history's times of the distance / largest envelope of the true u
/// - v: integral over time of the distance, by the trapezoidal rule over the history's rows, over
///   the length of the history and the largest envelope of the true v
///
/// mass by mass. Total error <= model + integration, by the triangle inequality. Valid across
/// jumps: u and the integral of v are; the history and the penalized motion do not jump at all.
struct PenaltySplit {
  MetricValue model_u;        ///< |penalized - rigid|
  MetricValue integration_u;  ///< |history - penalized|
  MetricValue model_v, integration_v;
};

/// Throws InputError unless `penalized` has the comparison's number of masses and lasts as long as
/// the history (give or take a rounding).
PenaltySplit penalty_split(const Comparison& comparison, const model::Motion& penalized);

/// Where synchrony is lost, and what part of it the method's own frequencies explain.
struct Synchrony {
  MetricValue lost, growth, detuning, predicted, share;
};
Synchrony explain_synchrony(const Comparison& comparison);

/// penalty_split() with the run's penalized motion, where it is known.
PenaltySplit split_known_penalty(const Comparison& comparison);

/// A method's own frequencies in flight, as a history shows them.
struct FlightFrequencies {
  std::vector<double> errors;  ///< (omega_D found - omega_D)/omega_D, one a mass
  std::string reason;          ///< why they were not measured, a sentence
};

/// Adds up, over all intervals between rows of one flight, how far each mass turns in the plane (u,
/// (v + sigma u)/omega_D), in which free motion is a spiral of steady rate omega_D, and compares
/// with omega_D times the time. A method whose velocity has another scale turns unsteadily but
/// keeps its mean over half turns; flights that are reported with their limits start and end on
/// half turns of all masses. Not measured for coupled masses, loads, nonlinear forces, masses that
/// are not underdamped, and rows farther apart than a quarter of a fast period.
FlightFrequencies flight_frequencies(const Comparison& comparison);

/// eps of a pair with damped frequencies in the ratio X (1 + eps): what the faster mass turns too
/// fast beyond the slower one, (1 + error of the faster)/(1 + error of the slower) - 1. Throws
/// InputError unless there are two masses and their errors.
double detuning(const Comparison& comparison, const FlightFrequencies& found);

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
