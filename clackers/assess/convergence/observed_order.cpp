#include "clackers/assess/convergence/observed_order.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "clackers/assess/convergence/ladder_fit.hpp"
#include "clackers/base/check.hpp"

namespace clackers::assess {

ObservedOrder observed_order(const std::function<double(double)>& error, double h, int levels) {
  require_step("observed order", h);
  require_within("observed order", "levels", levels, 4, 50);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  std::vector<ErrorLevel> ladder;
  for (int i = 0; i < levels; ++i, h /= 2.0)
    ladder.push_back({{h, std::abs(error(h)), epsilon / h}});
  const auto fit = fit_ladder(ladder, {.saturation = std::numeric_limits<double>::infinity()});
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!fit.has_line) return {unknown, unknown, fit.behaviour};
  return {fit.order, fit.spread, fit.behaviour};
}

}  // namespace clackers::assess
