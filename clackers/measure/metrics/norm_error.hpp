#pragma once

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {

/// Displacement [m], velocity [m/s] or acceleration [m/s^2].
enum class Quantity { u, v, a };

/// How the error e(t) of one mass becomes a number, over the history's output times from t0 to t1:
///
/// - `max`  max |e|
/// - `l1`   (integral of |e|) / (t1 - t0), the mean
/// - `l2`   sqrt((integral of e^2) / (t1 - t0)), the root of the mean square
/// - `end`  |e| at the last time
///
/// Divided by the length of the history, l1 and l2 have the unit of the quantity and do not grow
/// with the run. Integrals go by the trapezoidal rule; two rows with one time are the limits of a
/// jump. Velocities and accelerations jump, and there VelocityError's rule joins the jump of the
/// history with the true one beside it.
///
/// Valid across jumps: all of u; l1 and l2 of v and a. Between a true jump and that of the history
/// the velocities differ by the jump itself, so that `max` never converges, and `end` does not
/// where the history ends on an impact.
/// Source: common.
enum class Norm { max, l1, l2, end };

/// The error of each mass; not measured where the history lacks the quantity.
MetricValue norm_error(const Comparison& comparison, Quantity quantity, Norm norm);
/// The same relative to the largest envelope of the reference over the run.
MetricValue relative_norm_error(const Comparison& comparison, Quantity quantity, Norm norm);

}  // namespace clackers::measure
