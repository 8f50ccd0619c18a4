#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/assess/errors/mechanics.hpp"
#include "clackers/assess/errors/vectors.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/ladder/ladder_families.hpp"

namespace clackers::diagnose {
namespace {

// Impulses of a contact between rows of which one at least is closed, beyond free motion [N s].
struct Impulses {
  double push = 0.0, pull = 0.0;
  double largest_pull = 0.0;  ///< between two rows
  int rows = 0;
};

Impulses impulses_of(const Observation& seen, const model::ImpactProblem<>& problem) {
  constexpr int most_rows = 2000;
  const auto& contact = problem.contacts.front();
  const bool opening_has_impact = !seen.opening.t.empty() && seen.sample.impacts &&
                                  !seen.sample.impacts->empty() &&
                                  seen.opening.t.back() > seen.sample.impacts->front().t + 0.5;
  const auto& rows = opening_has_impact ? seen.opening : seen.sample;
  const assess::FreeMotion motion(problem.system);
  const double mass = 1.0 / contact.direction.dot(motion.response(contact.direction));
  const auto n = std::size_t(rows.dof);
  const auto state = [&](std::size_t i) {
    return assess::FreeState{
        rows.t[i], Eigen::Map<const Eigen::VectorXd>(rows.u.data() + i * n, Eigen::Index(n)),
        Eigen::Map<const Eigen::VectorXd>(rows.v.data() + i * n, Eigen::Index(n))};
  };
  Impulses sum;
  for (std::size_t i = 0; i + 1 < rows.t.size() && sum.rows < most_rows; ++i) {
    const double s = rows.t[i + 1] - rows.t[i];
    if (!(s > 0.0)) continue;
    const auto from = state(i), to = state(i + 1);
    if (contact.gap_at(from.u) > 0.0 && contact.gap_at(to.u) > 0.0) continue;
    const double change = contact.gap_rate(to.v - motion.moved(from, s).v);
    (change > 0.0 ? sum.push : sum.pull) += mass * std::abs(change);
    sum.largest_pull = std::max(sum.largest_pull, -mass * change);
    ++sum.rows;
  }
  return sum;
}

}  // namespace

std::vector<Diagnosis> tension_causes(const Question& question) {
  if (question.problem.contacts.size() != 1) return {};
  constexpr double least_share = 0.03;
  constexpr int least_rows = 12;
  double share = 0.0;
  int files = 0, pulling = 0;
  for (const auto& seen : question.histories) {
    if (seen.sample.v.empty() || !seen.sample.impacts || seen.sample.impacts->empty()) continue;
    const auto sum = impulses_of(seen, question.problem);
    const double rows_each = double(sum.rows) / double(seen.sample.impacts->size());
    if (sum.rows < least_rows || rows_each < 4.0 || !(sum.push > 0.0)) continue;
    ++files;
    if (sum.pull < least_share * sum.push) continue;
    // A jump as large as those of impacts is one, on masses that have passed through each other.
    if (sum.largest_pull > 0.3 * sum.push / double(seen.sample.impacts->size())) continue;
    ++pulling;
    share = sum.pull / sum.push;
  }
  if (files == 0 || 2 * pulling <= files) return {};
  auto found = diagnosis_of(Code("contact-in-tension"), share, "1");
  found.confidence = pulling >= 2 ? 0.9 : 0.7;
  found.evidence = {{"share", share}, {"files", double(pulling)}};
  return {found};
}

}  // namespace clackers::diagnose
