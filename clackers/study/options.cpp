#include "clackers/study/options.hpp"

#include <array>

namespace clackers::study {
namespace {

using Kind = VerifyOption::Kind;

constexpr auto all_options = std::to_array<VerifyOption>({
    {"levels", "", Kind::whole, 64, "n",
     "Number of levels, each with half the step of the one before. Default: 8 (5 to 8 where the "
     "finest would need more than 2^20 steps), with programs and callables 6.",
     [](VerifyRequest& request, double value) { request.plan.levels = int(value); }},
    {"coarsest", "", Kind::number, 0, "h",
     "Largest step, in seconds. Default: a fourteenth of the fast period of the case, rounded to "
     "two digits (0.05 for the default case).",
     [](VerifyRequest& request, double value) { request.plan.coarsest = value; }},
    {"samples-per-level", "neighbours", Kind::whole, 64, "n",
     "Steps a level, in the ratio 2^(1/n); they show scatter. Default: 8, with programs and "
     "callables 4.",
     [](VerifyRequest& request, double value) { request.plan.samples_per_level = int(value); }},
    {"budget", "", Kind::duration, 0, "TIME",
     "Time for further levels and steps of methods that these leave undecided, in seconds or as "
     "30s, 2min; 0: none. Default: 20s, and 0 with --levels.",
     [](VerifyRequest& request, double value) { request.budget = value; }},
    {"jobs", "", Kind::whole, 1024, "n", "Threads. Default: one per processor.",
     [](VerifyRequest& request, double value) { request.jobs = int(value); }},
});

}  // namespace

std::span<const VerifyOption> verify_options() { return all_options; }

void set_options(VerifyRequest& request, const std::map<std::string, double>& given) {
  request.budget = given.contains("levels") ? 0.0 : default_budget;
  for (const auto& option : all_options)
    if (const auto found = given.find(std::string(option.name)); found != given.end())
      option.set(request, found->second);
}

}  // namespace clackers::study
