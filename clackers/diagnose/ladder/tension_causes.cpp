#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

// Impulses of a contact between rows, beyond free motion [N s].
struct Impulses {
  // Between rows of which one at least is closed.
  double push = 0.0, pull = 0.0;
  double largest_pull = 0.0;  ///< between two rows
  int rows = 0;
  double open_pull = 0.0;  ///< between open rows, where nothing touches
  int impacts = 0;         ///< that the rows reach
};

Impulses impulses_of(const Observation& seen, const model::ImpactProblem<>& problem) {
  constexpr int most_rows = 2000;
  // Pulls between open rows count above this many times what flights before the first impact show.
  constexpr double above_flights = 10.0;
  constexpr int least_flights = 10;
  const auto& contact = problem.contacts.front();
  const auto& rows = seen.rows_with_impacts();
  const measure::FreeMotion motion(problem.system);
  const double mass = 1.0 / contact.direction.dot(motion.response(contact.direction));
  const double first = seen.sample.impacts->front().t;
  double flight_force = 0.0, speed = 0.0;
  int flights = 0;
  Impulses sum;
  auto to = measure::row_state(rows, 0);
  for (std::size_t i = 0; i + 1 < rows.t.size() && sum.rows < most_rows; ++i) {
    const auto from = std::exchange(to, measure::row_state(rows, i + 1));
    const double s = to.t - from.t;
    if (!(s > 0.0)) continue;
    speed = std::max(speed, std::abs(contact.gap_rate(from.v)));
    const double impulse = mass * contact.gap_rate(to.v - motion.moved(from, s).v);
    if (contact.gap_at(from.u) > 0.0 && contact.gap_at(to.u) > 0.0) {
      if (to.t < first - s) {
        ++flights;
        flight_force = std::max(flight_force, std::abs(impulse) / s);
      } else if (flights >= least_flights && -impulse > above_flights * flight_force * s) {
        sum.open_pull -= impulse;
      }
      continue;
    }
    (impulse > 0.0 ? sum.push : sum.pull) += std::abs(impulse);
    sum.largest_pull = std::max(sum.largest_pull, -impulse);
    ++sum.rows;
  }
  sum.impacts = int(std::ranges::count_if(*seen.sample.impacts,
                                          [&](const auto& one) { return one.t <= rows.t.back(); }));
  // Masses that pass through each other touch without an impulse.
  constexpr double least_momentum = 0.1;
  if (!(sum.push > least_momentum * mass * speed)) sum.rows = 0;
  return sum;
}

// Masses that are held while the contact is open: an error of the method, such as an acceleration of
// before the impact that is used after it, falls with the step.
bool holds(const std::vector<double>& steps, const std::vector<double>& shares) {
  constexpr double least_share = 2e-3, least_share_alone = 0.1;
  if (shares.empty() || !(shares.back() > least_share)) return false;
  if (shares.back() > least_share_alone) return true;
  int compared = 0;
  for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
    const double factor = steps[i] / steps.back();
    if (factor < 1.9) continue;
    ++compared;
    if (shares.back() * std::sqrt(factor) < shares[i]) return false;
  }
  return compared > 0;
}

// A motion that has grown says how the method fails, not what its contact does.
bool is_larger_than_motion(const measure::Ladder& ladder, double step) {
  return std::ranges::any_of(ladder, [&](const auto& level) {
    return std::ranges::any_of(
        level.runs, [&](const auto& run) { return run.step == step && run.u_error > 1.0; });
  });
}

}  // namespace

std::vector<Diagnosis> tension_causes(const DiagnosisInput& question) {
  if (question.problem.contacts.size() != 1) return {};
  constexpr double least_share = 0.03;
  constexpr int least_rows = 12, least_rows_each = 4;
  double share = 0.0;
  int files = 0, pulling = 0;
  // A contact of several rows has more of them in finer histories.
  bool is_resolved = false;
  std::vector<double> steps, held;
  for (const auto& seen : question.histories) {
    if (seen.sample.v.empty() || !seen.sample.impacts || seen.sample.impacts->empty() ||
        is_larger_than_motion(question.ladder, seen.facts.step))
      continue;
    const auto sum = impulses_of(seen, question.problem);
    is_resolved = sum.rows >= least_rows_each * sum.impacts && sum.push > 0.0;
    if (!is_resolved) continue;
    steps.push_back(seen.facts.step);
    held.push_back(sum.open_pull / sum.push);
    if (sum.rows < least_rows) continue;
    ++files;
    if (sum.pull < least_share * sum.push) continue;
    // A jump as large as those of impacts is one, on masses that have passed through each other.
    if (sum.largest_pull > 0.3 * sum.push / double(std::max(1, sum.impacts))) continue;
    ++pulling;
    share = sum.pull / sum.push;
  }
  if (!is_resolved) return {};
  const bool is_held = holds(steps, held);
  if (is_held) {
    share = held.back();
    pulling = int(std::ranges::count_if(held, [&](double one) { return one > 0.5 * share; }));
  } else if (files == 0 || 2 * pulling <= files) {
    return {};
  }
  auto found = diagnosis_of(Code("contact-in-tension"), share, "1");
  found.confidence = pulling >= 2 ? 0.9 : 0.7;
  found.evidence = {{"share", share}, {"files", double(pulling)}};
  return {found};
}

}  // namespace clackers::diagnose
