#include "clackers/campaign/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "clackers/base/error.hpp"
#include "clackers/campaign/tasks.hpp"
#include "clackers/campaign/tasks/prepared_system.hpp"

namespace clackers::campaign {
namespace {

using Clock = std::chrono::steady_clock;

// Systems of a case that are tried before it counts as refused.
constexpr long long most_tries = 10;
constexpr auto most_timing = std::chrono::seconds(10);
// Of rows in the database, without metrics: measured on 100,000 runs of pairs and assemblies.
constexpr double bytes_a_run = 170.0, bytes_a_task = 450.0, bytes_a_metric = 9.0;

// The first system of a case that is admissible, of a few evenly spaced ones; the last tried where none
// is.
std::unique_ptr<PreparedSystem> typical_system(const Specification& specification, long long first,
                                               long long count) {
  std::unique_ptr<PreparedSystem> prepared;
  const auto tries = std::min(count, most_tries);
  for (long long i = 0; i < tries && !(prepared && prepared->is_admissible()); ++i)
    prepared = std::make_unique<PreparedSystem>(specification,
                                                specification.system(first + count / tries * i));
  return prepared;
}

}  // namespace

Plan plan_of(const Specification& specification, const std::vector<std::string>& plugin_host,
             bool timed) {
  const auto solvers = solvers_of(specification, plugin_host);
  const auto start = Clock::now();
  Plan plan;
  plan.systems = specification.systems();
  plan.tasks = specification.tasks();
  double timed_runs = 0.0;
  long long first = 0;
  for (const auto& systems : specification.cases()) {
    const auto prepared = typical_system(specification, first, systems.size());
    first += systems.size();
    for (std::size_t m = 0; m < solvers.size(); ++m) {
      const bool has_time = timed && Clock::now() - start < most_timing;
      const auto cost = prepared->estimate(specification.methods()[m], solvers[m], has_time);
      const double runs = double(cost.runs) * double(systems.size());
      plan.runs += runs;
      if (!has_time) continue;
      timed_runs += runs;
      plan.seconds += cost.seconds * double(systems.size());
    }
  }
  if (timed_runs > 0.0) plan.seconds *= plan.runs / timed_runs;
  plan.bytes = bytes_a_task * double(plan.tasks) +
               (bytes_a_run + bytes_a_metric * double(specification.metrics().size())) * plan.runs;
  return plan;
}

study::Sheet plan_sheet(const Plan& plan) {
  study::Sheet sheet{
      "clackers/campaign-plan/1",
      "",
      {{"quantity", "", ""}, {"value", "", ""}, {"unit", "", ""}, {"meaning", "", ""}},
      {}};
  const auto add = [&](const char* name, study::Cell value, const char* unit, const char* meaning) {
    sheet.rows.push_back({name, std::move(value), unit[0] == 0 ? study::Cell() : unit, meaning});
  };
  add("systems", plan.systems, "", "cases with the values of their parameters");
  add("tasks", plan.tasks, "", "systems times methods");
  add("runs", static_cast<long long>(plan.runs), "", "of methods with one step each, about");
  add("processor_time", plan.seconds, "s", "estimated; divided by the number of workers");
  add("disk", plan.bytes, "B", "estimated size of the database");
  return sheet;
}

void require_few_runs(const Specification& specification,
                      const std::vector<std::string>& plugin_host) {
  // A task has a run at least, or is refused; without work for small campaigns.
  const auto few = plan_of(specification, plugin_host, false);
  if (few.runs <= most_runs_unasked) return;
  const auto plan = plan_of(specification, plugin_host, true);
  throw InputError(
      fmt::format(
          "{}: {:.3g} runs, about {:.3g} hours of one processor and {:.3g} GB; allowed without "
          "--yes: up to {:.0e} runs. Use fewer values, points, methods or levels, or give --yes.",
          specification.name(), plan.runs, plan.seconds / 3600.0, plan.bytes / 1e9,
          most_runs_unasked),
      "too-many-runs");
}

}  // namespace clackers::campaign
