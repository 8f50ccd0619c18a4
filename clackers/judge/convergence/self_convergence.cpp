#include "clackers/judge/convergence/self_convergence.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"

namespace clackers::judge {
namespace {

constexpr auto self_convergence_name = "self-convergence";

void validate(std::span<const ResponseLevel> runs, const SelfContext& context) {
  require_positive(self_convergence_name, "size of the motion", context.size);
  std::size_t values = 0;
  double ratio = 0.0;
  for (std::size_t j = 0; j < runs.size(); ++j) {
    if (runs[j].size() != runs.front().size())
      refuse(self_convergence_name, "number of runs in a level", double(runs[j].size()),
             "as many as in the first", {}, "wrong-size");
    for (std::size_t k = 0; k < runs[j].size(); ++k) {
      const auto& run = runs[j][k];
      require_step(self_convergence_name, run.step);
      if (!(run.floor >= 0.0))
        refuse(self_convergence_name, "rounding floor", run.floor, "0 or more");
      if (values == 0) values = run.values.size();
      if (!run.values.empty() && run.values.size() != values)
        refuse(self_convergence_name, "number of values of a run", double(run.values.size()),
               "as many as of the others", "Compare runs at equal times.", "wrong-size");
      if (j == 0) continue;
      const double here = runs[j - 1][k].step / run.step;
      if (!(here > 1.0))
        refuse(self_convergence_name, "a step", run.step, "below that of the level before it",
               "Give the levels coarsest first.");
      if (ratio == 0.0) ratio = here;
      if (!(context.claimed_order > 0.0) && std::abs(here / ratio - 1.0) > 0.01)
        refuse(self_convergence_name, "ratio of successive steps", here, "one ratio within 1 %",
               "Uneven steps need the order that the method claims.");
    }
  }
}

double distance(std::span<const double> first, std::span<const double> other) {
  if (first.empty() || other.empty()) return unknown;
  double largest = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double off = std::abs(first[i] - other[i]);
    if (!std::isfinite(off)) return unknown;
    largest = std::max(largest, off);
  }
  return largest;
}

LadderFit fit(std::span<const ErrorLevel> errors, const SelfContext& context) {
  return fit_ladder(errors,
                    {.claimed_order = context.claimed_order, .contact_time = context.contact_time});
}

}  // namespace

SelfConvergence self_convergence(std::span<const ResponseLevel> runs, const SelfContext& context) {
  validate(runs, context);
  const double q = context.claimed_order;
  std::vector<ErrorLevel> pseudo;
  for (std::size_t j = 0; j + 1 < runs.size(); ++j) {
    pseudo.emplace_back();
    for (std::size_t k = 0; k < runs[j].size(); ++k) {
      const auto &coarse = runs[j][k], &fine = runs[j + 1][k];
      const double share = q > 0.0 ? std::pow(coarse.step / fine.step, q) - 1.0 : 1.0;
      const double scale = 1.0 / (share * context.size);
      pseudo.back().push_back({fine.step, scale * distance(fine.values, coarse.values),
                               scale * (fine.floor + coarse.floor)});
    }
  }
  SelfConvergence self;
  self.differences = fit(pseudo, context);
  const auto& found = self.differences;
  self.proper = q > 0.0 && found.behaviour == Behaviour::proper && found.reason.empty() &&
                std::abs(found.order - q) <= order_tolerance * q;
  self.estimate = found.has_line ? found.errors[std::size_t(found.last_level)] : unknown;
  return self;
}

LadderFit true_convergence(std::span<const ResponseLevel> runs, std::span<const double> exact,
                           const SelfContext& context) {
  validate(runs, context);
  std::vector<ErrorLevel> errors;
  for (const auto& level : runs) {
    errors.emplace_back();
    for (const auto& run : level) {
      if (!run.values.empty() && run.values.size() != exact.size())
        refuse(self_convergence_name, "number of exact values", double(exact.size()),
               "as many as of the runs", {}, "wrong-size");
      errors.back().push_back(
          {run.step, distance(run.values, exact) / context.size, run.floor / context.size});
    }
  }
  return fit(errors, context);
}

SelfAgainstReference compare(const SelfConvergence& self, const LadderFit& reference) {
  SelfAgainstReference both;
  both.error_ratio = unknown;
  const auto& seen = self.differences;
  const auto level = std::size_t(seen.last_level) + 1;
  if (seen.has_line && level < reference.errors.size())
    both.error_ratio = reference.errors[level] / self.estimate;
  const bool wrong_limit =
      converges(seen.behaviour) && reference.behaviour == Behaviour::stagnating;
  const bool grows = converges(seen.behaviour) && reference.behaviour == Behaviour::divergent;
  // Below the step where the errors reach the rounding floor their ratio means nothing.
  const bool at_floor = reference.reason.empty() && reference.floor_step > 0.0 &&
                        level < reference.steps.size() &&
                        reference.steps[level] <= reference.floor_step;
  const bool too_large = self.proper && !at_floor && both.error_ratio > trust_factor;
  const bool same_but_wrong =
      seen.behaviour == Behaviour::exact && reference.behaviour != Behaviour::exact;
  both.false_convergence = wrong_limit || grows || too_large || same_but_wrong;
  if (wrong_limit) both.reason = Code("wrong-limit").name();
  return both;
}

}  // namespace clackers::judge
