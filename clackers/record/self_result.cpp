#include "clackers/record/self_result.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"

namespace clackers::record {

SelfResult self_result(std::vector<judge::ResponseLevel> runs, std::span<const double> exact,
                       const judge::SelfContext& context) {
  SelfResult result;
  result.order = require_positive("self-convergence", "claimed order", context.claimed_order);
  const auto whole = runs.empty() ? 0 : runs.back().size();
  std::erase_if(runs, [&](const auto& level) { return level.size() < whole; });
  result.self = judge::self_convergence(runs, context);
  result.errors = judge::true_convergence(runs, exact, context);
  result.against_reference = judge::compare(result.self, result.errors);
  std::vector<judge::Response> first;
  for (const auto& level : runs)
    if (!level.empty()) first.push_back(level.front());
  auto& found = result.extrapolation = judge::extrapolate(first, context);
  if (!found.bounded) return result;
  result.extrapolation_error = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    result.extrapolation_error =
        std::max(result.extrapolation_error, std::abs(found.value[i] - exact[i]));
  return result;
}

}  // namespace clackers::record
