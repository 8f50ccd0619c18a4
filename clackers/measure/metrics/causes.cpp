#include "clackers/measure/metrics/causes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::measure {
namespace {

void explain(const SynchronyLoss& loss, double eps, double rate, Synchrony& out) {
  if (!(rate > 0.0)) {
    out.predicted = out.share = not_measured("On this case no detuning grows.");
    return;
  }
  if (!(std::abs(eps) > 0.0 && std::abs(eps) < 1.0)) {
    out.predicted = out.share = not_measured("The method's frequencies are true.");
    return;
  }
  const auto part = explained_by_detuning(loss, {.rate = rate, .eta = 1.0, .eps = eps});
  out.predicted = measured(part.impact);
  out.share = std::isnan(out.growth.value) ? not_measured(out.growth.reason) : measured(part.share);
}

}  // namespace

Synchrony explain_synchrony(const Comparison& comparison) {
  const auto loss = synchrony_loss(comparison);
  Synchrony out;
  if (loss.impacts == 0)
    out.lost = not_measured("The history or the reference has no impacts.");
  else if (!loss.lost)
    out.lost = not_measured(fmt::format("Synchrony is kept over all {} impacts.", loss.impacts));
  else
    out.lost = measured(double(*loss.lost));
  if (!loss.lost)
    out.growth = not_measured(out.lost.reason);
  else if (std::isnan(loss.growth))
    out.growth = not_measured("Momenta after the impacts before the loss are too few or unknown.");
  else
    out.growth = measured(loss.growth);
  const auto found = flight_frequencies(comparison);
  if (found.errors.size() != 2) {
    out.detuning = out.predicted = out.share =
        not_measured(found.reason.empty() ? "There is no pair of masses." : found.reason);
    return out;
  }
  const double eps = detuning(comparison, found);
  out.detuning = measured(eps);
  explain(loss, eps, comparison.facts().detuning_rate, out);
  return out;
}

PenaltySplit split_known_penalty(const Comparison& comparison) {
  const auto& facts = comparison.facts();
  std::string reason = facts.no_penalized;
  try {
    if (facts.penalized) return penalty_split(comparison, *facts.penalized);
  } catch (const InputError& error) {
    reason = error.what();
  }
  const auto none = not_measured(reason);
  return {none, none, none, none};
}

}  // namespace clackers::measure
