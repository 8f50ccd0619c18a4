#include "clackers/diagnose/ladder/locator.hpp"

#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::diagnose {

using measure::FreeState;

std::optional<FreeState> Locator::closed(FreeState state, const model::Contact<>& contact,
                                         double reach) const {
  double passed = 0.0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const double rate = contact.gap_rate(state.v), gap = contact.gap_at(state.u);
    if (!(std::abs(rate) > 0.0) || !std::isfinite(gap)) return {};
    const double s = -gap / rate;
    passed += s;
    if (std::abs(passed) > std::abs(reach)) return {};
    state = moved(state, s);
    if (std::abs(s) < 1e-14 * (std::abs(state.t) + std::abs(reach))) break;
  }
  return state;
}

std::optional<LocatedImpact> Locator::located(const FreeState& before, const FreeState& after,
                                              const model::Contact<>& contact,
                                              const std::vector<model::Contact<>>& contacts,
                                              const std::vector<int>& together) const {
  const double reach = 2.0 * (after.t - before.t);
  const auto closing = closed(before, contact, reach), opening = closed(after, contact, -reach);
  if (!closing || !opening) return {};
  LocatedImpact found;
  found.t = closing->t;
  found.closing = -contact.gap_rate(closing->v);
  found.opening = contact.gap_rate(opening->v);
  if (!(found.closing > 0.0 && found.opening > 0.0)) return {};
  found.restitution = found.opening / found.closing;
  found.duration = opening->t - closing->t;
  found.delay = found.duration * found.opening / (found.closing + found.opening);
  // Exact where both flights have one acceleration.
  const auto apart = [&](auto measure) {
    return measure(moved(*closing, found.delay)) -
           measure(moved(*opening, found.delay - found.duration));
  };
  const double rate = apart([&](const auto& state) { return contact.gap_rate(state.v); });
  if (rate < 0.0)
    found.delay -= apart([&](const auto& state) { return contact.gap_at(state.u); }) / rate;
  const auto now = moved(after, closing->t - after.t);
  const Eigen::VectorXd expected = struck(closing->v, contacts, together);
  found.defect = difference(now.u - closing->u, now.v - expected) / found.closing;
  const Eigen::VectorXd stale =
      (after.t - found.t) * motion_.response(motion_.system().damping * (expected - closing->v));
  constexpr double in_time = 0.05;
  if (stale.squaredNorm() > 0.0 && std::abs(found.delay) < in_time * (after.t - found.t))
    found.stale_share = (now.v - expected).dot(stale) / stale.squaredNorm();
  // Both sides at the instant of the impulse have other speeds than where the gap closes and opens.
  const auto struck_state = moved(*closing, found.delay);
  const auto left_state = moved(*opening, found.delay - found.duration);
  found.gap = contact.gap_at(struck_state.u);
  found.restitution_error = (std::abs(contact.gap_rate(struck_state.v) + found.closing) +
                             std::abs(contact.gap_rate(left_state.v) - found.opening)) /
                            found.closing;
  const Eigen::VectorXd jump = left_state.v - struck_state.v;
  found.momentum_defect = beside_impulses(jump, contacts) / kinetic(jump);
  return found;
}

Eigen::VectorXd Locator::struck(const Eigen::VectorXd& v,
                                const std::vector<model::Contact<>>& contacts,
                                const std::vector<int>& numbers) const {
  const auto count = std::ssize(numbers);
  Eigen::MatrixXd along(v.size(), count), inertia(count, count);
  Eigen::VectorXd asked(count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const auto& contact = contacts[std::size_t(numbers[std::size_t(c)])];
    along.col(c) = motion_.response(contact.direction);
    asked[c] = -(1.0 + contact.restitution) * contact.gap_rate(v);
  }
  for (Eigen::Index c = 0; c < count; ++c)
    inertia.row(c) = contacts[std::size_t(numbers[std::size_t(c)])].direction.transpose() * along;
  return v + along * numerics::shortest_solution(inertia, asked);
}

double Locator::beside_impulses(const Eigen::VectorXd& jump,
                                const std::vector<model::Contact<>>& contacts) const {
  Eigen::MatrixXd along(jump.size(), std::ssize(contacts));
  for (std::size_t c = 0; c < contacts.size(); ++c)
    along.col(Eigen::Index(c)) = motion_.response(contacts[c].direction);
  const Eigen::MatrixXd weighted = along.transpose() * mass_;
  const Eigen::VectorXd impulses = numerics::shortest_solution(weighted * along, weighted * jump);
  return kinetic(jump - along * impulses);
}

}  // namespace clackers::diagnose
