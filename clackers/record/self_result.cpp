#include "clackers/record/self_result.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"

namespace clackers::study {

SelfResult self_result(std::vector<assess::ResponseLevel> runs, std::span<const double> exact,
                       const assess::SelfContext& context) {
  SelfResult result;
  result.order = require_positive("self-convergence", "claimed order", context.claimed_order);
  const auto whole = runs.empty() ? 0 : runs.back().size();
  std::erase_if(runs, [&](const auto& level) { return level.size() < whole; });
  result.self = assess::self_convergence(runs, context);
  result.errors = assess::true_convergence(runs, exact, context);
  result.against_reference = assess::compare(result.self, result.errors);
  std::vector<assess::Response> first;
  for (const auto& level : runs)
    if (!level.empty()) first.push_back(level.front());
  auto& found = result.extrapolation = assess::extrapolate(first, context);
  if (!found.bounded) return result;
  result.extrapolation_error = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    result.extrapolation_error =
        std::max(result.extrapolation_error, std::abs(found.value[i] - exact[i]));
  return result;
}

}  // namespace clackers::study
