#include "clackers/study/check/history/history_score.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/constants.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/errors/velocity_error.hpp"

namespace clackers::study {
namespace {

void measure_u(const measure::Comparison& comparison, const std::vector<bool>& has_u,
               measure::RunScore& score) {
  const auto& u = comparison.history().u;
  const auto reference = comparison.reference_u();
  for (std::size_t mass = 0; mass < comparison.dof(); ++mass) {
    if (!has_u[mass]) continue;
    double largest = 0.0;
    for (auto i = mass; i < u.size(); i += comparison.dof())
      largest = std::max(largest, std::abs(u[i] - reference[i]));
    score.u_error_absolute = std::max(score.u_error_absolute, largest);
    score.u_error = std::max(score.u_error, largest / comparison.u_envelope()[mass]);
  }
}

// A row and the one of the reference.
struct Rows {
  std::span<const double> found, reference;
};

void measure_v(const measure::Comparison& comparison, measure::RunScore& score) {
  const auto& history = comparison.history();
  const auto dof = comparison.dof();
  const auto row = [&](std::size_t i) {
    return Rows{std::span(history.v).subspan(i * dof, dof),
                comparison.reference_v().subspan(i * dof, dof)};
  };
  measure::VelocityError error(comparison.reference());
  const bool reported = comparison.impact_source() == measure::ImpactSource::reported;
  auto impact = comparison.impacts().begin();
  const auto last_impact = reported ? comparison.impacts().end() : impact;
  const auto take_impacts = [&](double before) {
    for (; impact != last_impact && impact->t < before; ++impact)
      if (impact->v_before.size() == dof && impact->v_after.size() == dof &&
          impact->t >= history.t.front())
        error.take(model::ReportedImpact{impact->t, impact->contact, impact->u, impact->v_before,
                                         impact->v_after, impact->impulse});
  };
  for (std::size_t i = 0; i < history.t.size(); ++i) {
    const double t = history.t[i];
    const auto now = row(i);
    if (!comparison.is_left_limit(i)) {
      take_impacts(std::nextafter(t, INFINITY));  // an impact comes after the own times before it
      error.take(t, now.found, now.reference);
      continue;
    }
    // The rows are the limits of this jump, and own times only at the ends of the history.
    take_impacts(t);
    while (impact != last_impact && impact->t == t) ++impact;
    const auto after = row(i + 1);
    if (i == 0) error.take(t, now.found, now.reference);
    error.take(model::ReportedImpact{t, 0, {}, now.found, after.found, unknown});
    ++i;
    if (i + 1 == history.t.size()) error.take(t, after.found, after.reference);
  }
  const double length = history.t.back() - history.t.front();
  for (std::size_t mass = 0; mass < dof; ++mass)
    score.v_error = std::max(score.v_error,
                             error.integral(int(mass)) / (length * comparison.v_envelope()[mass]));
}

void measure_energy(const measure::Comparison& comparison, measure::RunScore& score) {
  const auto& history = comparison.history();
  const auto dof = comparison.dof();
  const measure::MechanicalEnergy energy(comparison.problem().system);
  const auto start = comparison.reference().at(0.0, model::Side::right);
  const double scale = energy.total(start.u.data(), start.v.data());
  for (std::size_t i = 0; i < comparison.rows(); ++i) {
    // Where the impact of the reference is a little later, a right limit would count as an error up
    // to the next row.
    const bool limit = comparison.is_left_limit(i) || comparison.is_right_limit(i);
    const bool end = i < 2 || i + 2 >= comparison.rows();
    if (limit && !end) continue;
    const double found = energy.total(&history.u[i * dof], &history.v[i * dof]);
    const double expected =
        energy.total(&comparison.reference_u()[i * dof], &comparison.reference_v()[i * dof]);
    score.energy_error = std::max(score.energy_error, std::abs(found - expected) / scale);
    score.energy_ratio = expected > 0.0 ? found / expected : unknown;
  }
}

}  // namespace

measure::RunScore history_score(const measure::Comparison& comparison,
                                const std::vector<bool>& has_u, double step) {
  measure::RunScore score;
  score.step = step;
  score.finished = true;
  score.rounding_floor = comparison.rounding_floor();
  score.v_error = score.energy_error = score.energy_ratio = unknown;
  measure_u(comparison, has_u, score);
  if (!comparison.has_velocities()) return score;
  score.v_error = 0.0;
  measure_v(comparison, score);
  if (std::ranges::find(has_u, false) != has_u.end()) return score;
  score.energy_error = 0.0;
  measure_energy(comparison, score);
  return score;
}

}  // namespace clackers::study
