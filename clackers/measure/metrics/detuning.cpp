#include "clackers/measure/metrics/causes.hpp"

#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/numerics/modes/modal_flight.hpp"

namespace clackers::measure {
namespace {

// Free motion of one mass: u = A e^(-sigma t) cos(omega t + phase).
struct Spiral {
  double sigma, omega;

  double angle(double u, double v) const { return std::atan2(-(v + sigma * u) / omega, u); }
};

Spiral spiral(const Comparison& comparison, std::size_t mass) {
  const auto& system = comparison.problem().system;
  const auto i = static_cast<Eigen::Index>(mass);
  const double m = system.mass(i, i), sigma = 0.5 * system.damping(i, i) / m;
  return {sigma, std::sqrt(system.stiffness(i, i) / m - sigma * sigma)};
}

// The difference of two angles, within half a turn.
double turn(double difference) {
  if (std::abs(difference) <= std::numbers::pi) return difference;  // nearly always
  return std::remainder(difference, 2.0 * std::numbers::pi);
}

std::string objection_to_detuning(const Comparison& comparison) {
  const auto& system = comparison.problem().system;
  if (!comparison.has_velocities()) return Comparison::no_velocities;
  if (system.add_load || system.nonlinear) return "The system has a load or a nonlinear force.";
  if (!numerics::is_diagonal(system.mass) || !numerics::is_diagonal(system.damping) ||
      !numerics::is_diagonal(system.stiffness))
    return "The masses are coupled in flight.";
  for (std::size_t mass = 0; mass < comparison.dof(); ++mass) {
    const double omega = spiral(comparison, mass).omega;
    if (!(omega > 0.0)) return "A mass is not underdamped.";
    if (omega * comparison.step() > 0.5 * std::numbers::pi)
      return "Rows are farther apart than a quarter of a period.";
  }
  return {};
}

}  // namespace

FlightFrequencies flight_frequencies(const Comparison& comparison) {
  FlightFrequencies result{.errors = {}, .reason = objection_to_detuning(comparison)};
  if (!result.reason.empty()) return result;
  const auto n = comparison.dof();
  const auto& history = comparison.history();
  const auto& impacts = comparison.impacts();
  std::vector<Spiral> masses;
  for (std::size_t mass = 0; mass < n; ++mass) masses.push_back(spiral(comparison, mass));
  std::vector<double> turned(n, 0.0), last(n);
  double time = 0.0;
  std::size_t next = 0;  // impact after the row before
  for (std::size_t row = 0; row < comparison.rows(); ++row) {
    const double t = history.t[row];
    // A row at the instant of an impact that stands alone may be of either side.
    bool same_flight = row > 0 && !comparison.is_right_limit(row);
    for (; next < impacts.size() &&
           (impacts[next].t < t || (impacts[next].t == t && !comparison.is_left_limit(row)));
         ++next)
      same_flight = false;
    // Nor does a row within an impact that takes several steps belong to a flight.
    if (next > 0 && row > 0 && history.t[row - 1] < comparison.impact_ends()[next - 1])
      same_flight = false;
    if (same_flight) time += t - history.t[row - 1];
    for (std::size_t mass = 0; mass < n; ++mass) {
      const auto at = row * n + mass;
      const double angle = masses[mass].angle(history.u[at], history.v[at]);
      if (same_flight) turned[mass] += turn(angle - last[mass]);
      last[mass] = angle;
    }
  }
  if (!(time > 0.0)) {
    result.reason = "No two rows lie in one flight.";
    return result;
  }
  for (std::size_t mass = 0; mass < n; ++mass)
    result.errors.push_back(turned[mass] / (masses[mass].omega * time) - 1.0);
  return result;
}

double detuning(const Comparison& comparison, const FlightFrequencies& found) {
  if (found.errors.size() != 2)
    refuse("detuning", "frequencies", static_cast<double>(found.errors.size()), "two", {},
           "wrong-size");
  const bool second_is_fast = spiral(comparison, 1).omega >= spiral(comparison, 0).omega;
  const double fast = found.errors[second_is_fast ? 1 : 0];
  const double slow = found.errors[second_is_fast ? 0 : 1];
  return (1.0 + fast) / (1.0 + slow) - 1.0;
}

}  // namespace clackers::measure
