#include "clackers/campaign/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/campaign/tasks.hpp"
#include "clackers/campaign/tasks/prepared_system.hpp"

namespace clackers::campaign {
namespace {

using Clock = std::chrono::steady_clock;

// Systems of a case that stand for all of them.
constexpr long long most_samples = 8;
constexpr auto most_timing = std::chrono::seconds(10);
// Of rows in the database, without metrics: measured on 100,000 runs of pairs and assemblies.
constexpr double bytes_a_run = 170.0, bytes_a_task = 450.0, bytes_a_metric = 9.0;

// What the methods cost on the systems [first, first + count), from a few evenly spaced ones; each
// method is timed on the first system that takes it, until `until`.
struct CaseCost {
  double runs = 0.0, timed_runs = 0.0, seconds = 0.0;
};

CaseCost cost_of(const Specification& specification,
                 const std::vector<std::optional<solvers::SolverSubject>>& solvers, long long first,
                 long long count, Clock::time_point until) {
  const auto samples = std::min(count, most_samples);
  std::vector<double> runs(solvers.size()), seconds_a_run(solvers.size());
  for (long long i = 0; i < samples; ++i) {
    PreparedSystem system(specification, specification.system(first + count / samples * i));
    for (std::size_t m = 0; m < solvers.size(); ++m) {
      const bool timed = seconds_a_run[m] == 0.0 && Clock::now() < until;
      const auto cost = system.estimate(specification.methods()[m], solvers[m], timed);
      runs[m] += double(cost.runs) * double(count) / double(samples);
      if (cost.seconds > 0.0) seconds_a_run[m] = cost.seconds / double(cost.runs);
    }
  }
  CaseCost sum;
  for (std::size_t m = 0; m < solvers.size(); ++m) {
    sum.runs += runs[m];
    if (seconds_a_run[m] > 0.0) sum.timed_runs += runs[m];
    sum.seconds += runs[m] * seconds_a_run[m];
  }
  return sum;
}

}  // namespace

Plan plan_of(const Specification& specification, bool timed) {
  const auto solvers = solvers_of(specification);
  const auto until = Clock::now() + (timed ? most_timing : std::chrono::seconds(0));
  Plan plan;
  plan.systems = specification.systems();
  plan.tasks = specification.tasks();
  double timed_runs = 0.0;
  long long first = 0;
  for (const auto& systems : specification.cases()) {
    const auto cost = cost_of(specification, solvers, first, systems.size(), until);
    first += systems.size();
    plan.runs += cost.runs;
    timed_runs += cost.timed_runs;
    plan.seconds += cost.seconds;
  }
  if (timed_runs > 0.0) plan.seconds *= plan.runs / timed_runs;
  plan.bytes = bytes_a_task * double(plan.tasks) +
               (bytes_a_run + bytes_a_metric * double(specification.metrics().size())) * plan.runs;
  return plan;
}

record::Sheet plan_sheet(const Plan& plan) {
  record::Sheet sheet{
      "clackers/campaign-plan/1",
      "",
      {{"quantity", "", ""}, {"value", "", ""}, {"unit", "", ""}, {"meaning", "", ""}},
      {}};
  const auto add = [&](const char* name, record::Cell value, const char* unit,
                       const char* meaning) {
    sheet.rows.push_back({name, std::move(value), unit[0] == 0 ? record::Cell() : unit, meaning});
  };
  add("systems", plan.systems, "", "cases with the values of their parameters");
  add("tasks", plan.tasks, "", "systems times methods");
  add("runs", static_cast<long long>(plan.runs), "", "of methods with one step each, about");
  add("processor_time", plan.seconds, "s", "estimated; divided by the number of workers");
  add("disk", plan.bytes, "B", "estimated size of the database");
  return sheet;
}

void require_few_runs(const Specification& specification) {
  // A task has a run at least, or is refused; without work for small campaigns.
  const auto few = plan_of(specification, false);
  if (few.runs <= most_runs_unasked) return;
  const auto plan = plan_of(specification, true);
  throw InputError(
      fmt::format(
          "{}: {:.3g} runs, about {:.3g} hours of one processor and {:.3g} GB; allowed without "
          "--yes: up to {:.0e} runs. Use fewer values, points, methods or levels, or give --yes.",
          specification.name(), plan.runs, plan.seconds / 3600.0, plan.bytes / 1e9,
          most_runs_unasked),
      "too-many-runs");
}

}  // namespace clackers::campaign
