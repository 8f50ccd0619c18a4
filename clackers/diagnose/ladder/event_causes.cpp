#include <algorithm>
#include <cmath>
#include <vector>

#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::diagnose {
namespace {

// How far rows lie from free motion of the row before: medians of those at impacts, which both sides
// are printed of, and of all others. Relative to the velocity of the envelope.
struct FlightErrors {
  double spacing = 0.0, at_impacts = 0.0, elsewhere = 0.0;
};

FlightErrors flight_errors(const Observation& seen, const measure::FreeMotion& motion,
                           double speed) {
  const auto& rows = seen.opening;
  const double frequency = measure::highest_frequency(motion.system());
  std::vector<double> spacings, at_impacts, elsewhere;
  for (std::size_t i = 0; i + 2 < rows.t.size(); ++i) {
    const double s = rows.t[i + 1] - rows.t[i];
    // Steps of fourth order must be better than the solver's.
    if (!(s > 0.0) || s * frequency > 1.0) continue;
    const auto state = motion.moved(measure::row_state(rows, i), s, 8);
    const auto to = measure::row_state(rows, i + 1);
    const double error = (frequency * (to.u - state.u).norm() + (to.v - state.v).norm()) / speed;
    const bool is_impact = rows.t[i + 2] == rows.t[i + 1];
    (is_impact ? at_impacts : elsewhere).push_back(error);
    spacings.push_back(s);
  }
  if (at_impacts.empty() || elsewhere.empty()) return {};
  return {measure::median(std::move(spacings)), measure::median(std::move(at_impacts)),
          measure::median(std::move(elsewhere))};
}

}  // namespace

std::vector<Diagnosis> event_causes(const DiagnosisInput& question) {
  constexpr double times_flights = 20.0, least_order = 1.3, most_order = 3.2;
  constexpr std::size_t least_files = 3;
  if (!question.by_tolerance) return {};
  const measure::FreeMotion motion(question.problem.system);
  const double speed = question.motion.peak().v.maxCoeff();
  std::vector<double> spacing, error;
  std::size_t files = 0;
  for (const auto& seen : question.histories) {
    const auto one = flight_errors(seen, motion, speed);
    if (!(one.at_impacts > 0.0)) continue;
    ++files;
    if (one.at_impacts < times_flights * one.elsewhere) continue;
    spacing.push_back(std::log(one.spacing));
    error.push_back(std::log(one.at_impacts));
  }
  if (spacing.size() < least_files || 2 * spacing.size() < files ||
      spacing.front() - spacing.back() < std::log(2.0))
    return {};
  const double order = numerics::fit_line(spacing, error).slope;
  if (order < least_order || order > most_order) return {};
  auto found = diagnosis_of(Code("event-interpolated"), order, "1");
  found.confidence = 0.9;
  found.evidence = {{"files", double(spacing.size())}};
  return {found};
}

}  // namespace clackers::diagnose
