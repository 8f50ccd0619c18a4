#include "clackers/study/record/baseline_match.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

// "--case NAME --set a=1,b=2", which makes a case again.
std::string case_options(const CaseSummary& problem) {
  std::string values;
  for (const auto& p : problem.parameters)
    values += fmt::format("{}{}={}", values.empty() ? "" : ",", p.name, p.value);
  return fmt::format("--case {}{}{}", problem.name, values.empty() ? "" : " --set ", values);
}

std::string ladder_options(const LadderPlan& plan) {
  return fmt::format("--coarsest {} --levels {} --neighbours {}", plan.coarsest, plan.levels,
                     plan.neighbours);
}

[[noreturn]] void refuse_other(std::string_view what, const std::string& theirs,
                               const std::string& ours) {
  throw InputError(fmt::format("baseline: is of {}: {}; this run: {}. Only the same case and the "
                               "same steps can be compared; repeat one of the two with the "
                               "options of the other.",
                               what, theirs, ours),
                   "other-study");
}

bool same(const Quantity& a, const Quantity& b) { return a.name == b.name && a.value == b.value; }

}  // namespace

void match_baseline(const CaseSummary& problem, const LadderPlan& plan, const Record& baseline) {
  const auto& other = baseline.problem;
  const auto refuse_case = [&](std::string_view what) {
    refuse_other(what, case_options(other), case_options(problem));
  };
  if (other.name != problem.name) refuse_case("another case");
  if (!std::ranges::equal(other.parameters, problem.parameters, same))
    refuse_case("other parameters");
  // A case with the same name and parameters that ends elsewhere is of another version.
  if (other.end != problem.end || other.impact_count != problem.impact_count)
    refuse_other("another motion",
                 fmt::format("{} s, {} collisions", other.end, other.impact_count),
                 fmt::format("{} s, {} collisions", problem.end, problem.impact_count));
  const auto& steps = baseline.plan;
  if (steps.coarsest != plan.coarsest || steps.levels != plan.levels ||
      steps.neighbours != plan.neighbours)
    refuse_other("another ladder", ladder_options(steps), ladder_options(plan));
}

}  // namespace clackers::study
