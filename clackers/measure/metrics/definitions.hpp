#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/distance/polyline_distance.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {

/// Displacement [m], velocity [m/s] or acceleration [m/s^2].
enum class Component { u, v, a };

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
MetricValue norm_error(const Comparison& comparison, Component quantity, Norm norm);
/// The same relative to the largest envelope of the reference over the run.
MetricValue relative_norm_error(const Comparison& comparison, Component quantity, Norm norm);

// Errors of the whole structure over the history's output times.

/// v' M v / 2, u' K u / 2 or their sum.
enum class Energy { kinetic, potential, total };

/// max |E - E*| / H, H the largest total energy of the reference over the run; dimensionless; the
/// total is RunScore::energy_error. Not measured without velocities (the potential part is), with a
/// nonlinear force, whose potential is not known, or where H is not positive.
///
/// Valid across jumps: the potential part. The others jump where restitution is below 1, or where
/// an impact shifts kinetic energy between times at which the motions have and have not collided.
/// Source: common.
MetricValue energy_error(const Comparison& comparison, Energy energy);

/// max |p - p*| / P; p = sum over i of (M v)_i is the momentum, P = sum over i, j of |M_ij| V_j the
/// largest that the envelopes V of the true velocities allow (m_1 V_1 + m_2 V_2 for two masses).
/// Dimensionless. Not measured without velocities or where P is not positive.
///
/// Valid across jumps only between masses of the structure, whose impulses cancel; a stop outside
/// makes the momentum jump. Source: common.
MetricValue momentum_error(const Comparison& comparison);

/// max(0, -g) [m] over all contacts, g = b . u - gap, which the reference keeps at 0 or above. Not
/// measured without a contact.
///
/// Valid across jumps: yes, displacements do not jump. Source: common.
MetricValue penetration(const Comparison& comparison);

enum class Rest { gap, speed };
/// max |g| [m] or |b . v| [m/s] over the rows of the later half of each time in which the reference has the
/// contact closed: what goes on bouncing. Not measured where none stays closed.
///
/// Valid across jumps: yes, no impact is left in that half. Source: common.
MetricValue rest_error(const Comparison& comparison, Rest rest);

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

/// One impact of the history against the true one it belongs to.
struct ImpactError {
  long long index = 0;      ///< of the true impact, 1 for the first
  std::size_t found = 0;    ///< index into Comparison::impacts()
  double t = 0.0;           ///< of the history's impact [s]
  double time_error = 0.0;  ///< found minus true [s]
  /// |v - v*| just before and just after, mass by mass [m/s]; empty where not known.
  std::vector<double> before, after;
  /// |P - P*| along the contact's direction [N s]; NaN where not known.
  double impulse = std::numeric_limits<double>::quiet_NaN();
  bool late = false;  ///< found more than one step of the history after the true instant
};

/// Impact k against k.
struct EventReport {
  ImpactSource source = ImpactSource::reported;
  long long expected = 0, found = 0, matched = 0, missed = 0, extra = 0;
  long long late = 0;                ///< of the matched
  std::vector<ImpactError> impacts;  ///< the matched ones in order of time
};

/// Times, velocities on both sides and impulses are compared at the impacts themselves, each
/// motion at its own instant, so all of it is valid across jumps: an impact found at t* + d has
/// the right velocities up to O(d). Pairs and counts follow ImpactMatcher's rule; a step is
/// Comparison::step(). Source: common.
EventReport event_report(const Comparison& comparison);

/// The worst of all matched impacts. Not measured where none is matched, or where what is asked
/// for is known of none.
MetricValue impact_time_error(const Comparison& comparison);      ///< max |t - t*| [s]
MetricValue velocity_before_error(const Comparison& comparison);  ///< [m/s], mass by mass
MetricValue velocity_after_error(const Comparison& comparison);   ///< [m/s], mass by mass
MetricValue impulse_error(const Comparison& comparison);          ///< [N s]

/// Counts; `late` does not tend to zero for a method that always fires two steps late, though the
/// method converges.
MetricValue missed_impacts(const Comparison& comparison);
MetricValue extra_impacts(const Comparison& comparison);
MetricValue late_impacts(const Comparison& comparison);

/// The coefficients of restitution of the history's impacts, by the change of the gap rate b.v, where
/// both limits are known and the gap closes. Source: Newton's impact law.
MetricValue restitution_median(const Comparison& comparison);
MetricValue restitution_smallest(const Comparison& comparison);

/// How far a force moves a mass in the first step h, in h^2 a0: the least-squares s, weighted by mass, of
/// u1 = u0 + h v0 + s h^2 a0 with the accelerations a0 of the problem at the history's first row. Not
/// measured without velocities, where no force acts there, and where a contact is closed at one of the rows.
MetricValue first_force_share(const Comparison& comparison);

/// The filled graph of a velocity: the set of (t/T, v/V) with vertical segments from the left limit
/// to the right one at jumps. T is Comparison::impact_period(), V the mass's true envelope at t
/// = 0. The Hausdorff distance of two filled graphs, with points as far apart as the farther of
/// their two coordinates, tends to zero when jumps come slightly early or late, take two steps or
/// are smeared over a contact time; a distance of d says that neither graph leaves the other by
/// more than d T in time and d V in velocity at once. Where a history ends so near to an impact
/// that it has it and the reference has not, or the other way round, the graph that has it ends
/// with its left limit: a last impact within the last two steps that has no match does not count.
/// Source: J. J. Moreau, Approximation en graphe d'une evolution discontinue, RAIRO Anal. numer.
/// 12, 75-84 (1978).
///
/// Both graphs have their points at the same instants, the history's rows, each also at its own
/// jumps, and straight lines between them. What the lines cut off of the curves is nearly the same
/// on both sides, so the distance is that of the method and not of how densely its rows were
/// written.
struct FilledGraphs {
  Polyline history, reference;
};

/// The graphs of one mass; needs has_velocities() and a positive envelope. Reported impacts of the
/// history with both limits are jumps of its graph.
FilledGraphs filled_graphs(const Comparison& comparison, std::size_t mass);

/// Rows of the table of metrics: two-sided; from the history to the reference (what the history has
/// and the reference has not, such as spikes); from the reference to the history (what the history
/// misses). Not measured without velocities, where an envelope is not positive, where rows are far
/// fewer than true impacts, and where the graphs are too far apart for the search.
MetricValue measure_filled_graph(const Comparison& comparison);
MetricValue measure_filled_graph_of_history(const Comparison& comparison);
MetricValue measure_filled_graph_of_reference(const Comparison& comparison);

/// A motion as a hybrid arc: one line for each flight j = 0, 1, ..., points (t/T, u/U, v/V) of all
/// masses, T as in Comparison::impact_period(), U and V the largest true envelopes. Flights do
/// not share their ends: the first ends with the left limits of an impact, the next starts with the
/// right ones.
class HybridArc {
 public:
  /// Of the history, points at its rows and impacts. Its flights end and start at its own
  /// impacts; a row inside an impact that takes several steps belongs to no flight. Where the
  /// displacement or a limit of an impact is not known, its flights end with the last row before
  /// it and start with the first row after it. The comparison must outlive the arc.
  static HybridArc of_history(const Comparison& comparison);
  /// Of the reference, points at the history's rows and at its own impacts.
  static HybridArc of_reference(const Comparison& comparison);

  std::size_t flights() const { return impacts_.size() + 1; }
  /// The next flight, from the first one on; not more than there are. Nothing where no row and no
  /// limit stands in it.
  std::optional<Polyline> next();

 private:
  // Vectors are empty where its limits are not known.
  struct Jump {
    double from, to;  // [s]
    std::vector<double> u, before, after;

    bool is_known() const { return !u.empty() && !before.empty() && !after.empty(); }
  };

  HybridArc(const Comparison& comparison, std::span<const double> u, std::span<const double> v)
      : comparison_(comparison), u_(u), v_(v) {}
  bool is_inside(const Jump& impact, std::size_t row) const;
  bool is_before(const Jump& impact, std::size_t row) const;

  const Comparison& comparison_;
  std::span<const double> u_, v_;  // at the history's rows
  std::vector<Jump> impacts_;
  std::size_t passed_ = 0, row_ = 0;  // impacts and rows in the flights so far
};

/// The smallest epsilon for which history and reference are (tau, epsilon)-close, tau the end of
/// the history: for every point (t, j) of the one there is an (s, j) of the other, j the same
/// number of impacts so far, with |t - s| <= epsilon T and each state within epsilon of its scale,
/// and the other way round. Both end with the history. Lines are joined as in filled_graphs(), and
/// the value is as close to the smallest one as one_sided_distance() is.
///
/// Stricter than the filled graph: impacts must come one for one, each a jump. Impacts at slightly
/// other instants do no harm; those that take two steps, and penalty contacts, which have no jump,
/// never become close. Not measured where the numbers of impacts differ, since then no epsilon is
/// large enough; an impact that only one of both has within the last two steps does not count.
/// Source: R. Goebel, R. G. Sanfelice, A. R. Teel, Hybrid Dynamical Systems, Princeton University
/// Press (2012), section 5.3.
MetricValue measure_hybrid_closeness(const Comparison& comparison);

// Distances after the jumps of both motions are undone.

/// max |(-1)^k v - (-1)^k* v*| [m/s] over the history's output times, mass by mass; k and k* count
/// the impacts of each motion so far. An impact that reverses every velocity disappears: the
/// unfolded true velocity is continuous, and a jump at a slightly wrong time costs no more than
/// that time.
///
/// Defined where each impact reverses the velocity of every mass: one contact, restitution 1, and
/// v(+) = -v(-) at the true impacts, as where total momentum is zero at each (the synchronized
/// pairs) or one mass meets a rigid stop. Elsewhere, and without velocities, it is not measured.
///
/// Of two rows with one time the first stands before the impact, the second after it; a row alone
/// at the very time of an impact stands after it. A missed or extra impact turns the sign for
/// good, so that the error is of the size of the velocity.
///
/// Valid across jumps: yes. Not for contacts that last several rows (compliant contacts, impacts
/// spread over steps), where the velocity passes through zero.
/// Source: V. F. Zhuravlev's and A. P. Ivanov's non-smooth coordinate change.
MetricValue unfolded_velocity_error(const Comparison& comparison);

/// max over the history's output times of min(|x - y|, |J(x) - y|, |x - J(y)|), x the state (u, v)
/// of the history and y that of the reference. J is the impact map of a contact by Newton's law,
///
///     u -> u,   v -> v - (1 + eta) M^-1 b (b . v) / (b . M^-1 b),
///
/// tried for every contact; |.| is the largest difference of any mass in u / U and v / V, with U
/// and V the largest envelopes of the reference over the run. Dimensionless, of the whole structure.
///
/// J is tried at every time and not at impacts alone, so that it is never more than the plain
/// distance and forgives two states that differ by a whole impact wherever they are. Not measured
/// without velocities, without a contact or where an envelope is not positive.
///
/// Valid across jumps: yes; while one motion has jumped and the other has not, J takes one onto the
/// other. Not for contacts that last several rows.
/// Source: J. J. B. Biemond, N. van de Wouw, W. P. M. H. Heemels, H. Nijmeijer (2013).
MetricValue jump_invariant_distance(const Comparison& comparison);

}  // namespace clackers::measure
