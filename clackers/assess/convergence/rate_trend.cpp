#include "clackers/assess/convergence/rate_trend.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace clackers::assess {

bool may_still_reach(double claimed, const Window& found) {
  if (!(claimed > 0.0)) return false;
  const auto& rates = found.rates;
  const auto& errors = found.rate_errors;
  const auto n = rates.size();
  const double way = claimed > found.line.slope ? 1.0 : -1.0;
  const auto short_of = [&](double rate) { return way * (claimed - rate) > 0.1 * claimed; };
  // A slope that its own uncertainty carries into the tolerance contradicts nothing.
  if (!short_of(found.line.slope + way * found.line.slope_spread) || !short_of(rates[n - 1]))
    return true;
  const double move = way * (rates[n - 1] - rates[n - 2]);
  const double before = way * (rates[n - 2] - rates[n - 3]);
  if (move > least_move && before > least_move) return true;
  const bool significant = move > significant_move * (errors[n - 1] + errors[n - 2]) &&
                           before > significant_move * (errors[n - 2] + errors[n - 3]);
  if (!significant) return false;
  // Moves that do not shrink go on past any bound; those that do add up like a geometric series.
  return move >= before || !short_of(rates[n - 1] + way * move * move / (before - move));
}

bool rates_rise(double claimed, const Window& found) {
  const auto& rates = found.rates;
  const auto n = rates.size();
  return n >= 3 && rates[n - 3] > std::max(claimed, 0.0) &&
         rates[n - 2] - rates[n - 3] > straight_rates &&
         rates[n - 1] - rates[n - 2] > straight_rates;
}

double drift(const Window& found) {
  const auto& rates = found.rates;
  const bool one_way =
      std::ranges::is_sorted(rates) || std::ranges::is_sorted(rates, std::greater{});
  return one_way && !rates.empty() ? std::abs(rates.back() - found.line.slope) : 0.0;
}

}  // namespace clackers::assess
