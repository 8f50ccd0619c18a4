#pragma once

#include <string>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {

/// Instants that come once or twice a period, in the history and in the reference, with the speed
/// of a mass there.
struct PhaseMarks {
  std::vector<double> index;                    ///< number of the mark, ascending
  std::vector<double> found, reference;         ///< [s]
  std::vector<double> speed_found, speed_true;  ///< [m/s]; NaN where not known
  double per_period = 1.0;                      ///< marks in a period
  std::string reason;                           ///< why there are none, a sentence
};

/// The marks of one mass. Where the reference collides at least twice: matched impacts, a period
/// is the time T between impacts, the speed is that before impact. Otherwise zero crossings of
/// the displacement, two a period, interpolated linearly between rows in the history and, at the
/// same rows, in the reference, so that the interpolation hardly differs; speeds likewise.
PhaseMarks phase_marks(const Comparison& comparison, std::size_t mass);

/// Rows of the table of metrics. The numbers of single masses are signed, the value is their
/// largest size. Lag is found minus true time, T the true period, both fitted by a least-squares
/// line over the number of the mark, which spreads the error of a single mark.
///
/// - period: (T found - T)/T, the slope of the lag over T. Positive: slow.
/// - phase: the lag that the line has at the last mark, in periods. Positive: late.
/// - decay: by what part the speed at marks falls in one period, 1 - exp(slope of ln speed), found
///   minus true. Positive: damped too much.
///
/// Valid across jumps: marks are compared with marks, never with the other side of a jump.
/// Source: common; period elongation and amplitude decay of K.-J. Bathe, E. L. Wilson, Earthq. Eng.
/// Struct. Dyn. 1, 283-291 (1973), measured on a history.
MetricValue measure_period_error(const Comparison& comparison);
MetricValue measure_phase_error(const Comparison& comparison);
MetricValue measure_decay_error(const Comparison& comparison);

}  // namespace clackers::measure
