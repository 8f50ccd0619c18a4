#pragma once

#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {

/// The history against the reference in one flight, shifted so that both start together.
struct FlightError {
  long long after = 0;       ///< the true impact it starts with; 0: the start of the motion
  double shift = 0.0;        ///< what was taken from the history's times [s]
  std::size_t rows = 0;      ///< compared
  std::vector<double> u, v;  ///< largest errors, mass by mass [m], [m/s]; v empty if not known
};

/// All flights of which at least one row can be compared, in order of time.
///
/// A flight of the history lasts from the end of one of its impacts to the start of the next. If
/// the impact belongs to the true impact at t*, then d = end of the impact - t*, and the
/// history at t is compared with the reference at t - d, as long as t - d lies in the true flight
/// that starts at t*: in (t*, next impact]. The flight before the first impact is not shifted.
/// Flights after an extra impact are not compared: they have no true flight. Of two rows with
/// one time the first closes a flight and the second opens the next; a row alone at the very time
/// of an impact belongs to neither side, and a row with a closed contact (g < 0 beyond rounding)
/// to no flight unless it is a limit of a jump.
///
/// Valid across jumps: yes, since both motions are smooth within a flight; contacts over several
/// rows are left out. Source: common.
std::vector<FlightError> flight_errors(const Comparison& comparison);

MetricValue flight_u_error(const Comparison& comparison);  ///< largest of all flights [m]
MetricValue flight_v_error(const Comparison& comparison);  ///< [m/s]

}  // namespace clackers::measure
