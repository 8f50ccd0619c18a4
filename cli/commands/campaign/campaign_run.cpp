#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/campaign/run.hpp"
#include "clackers/report/write.hpp"
#include "cli/cluster/run_on_ranks.hpp"
#include "cli/commands/campaign/campaign_actions.hpp"
#include "cli/files/results.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/progress_line.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

constexpr int most_jobs = 1024;

}  // namespace

int jobs_from(const std::string& text) {
  if (text.empty()) return 0;
  return static_cast<int>(read_whole("--jobs", text, 1, most_jobs));
}

campaign::RunSummary run_tasks(campaign::Store& store, const campaign::Shard& shard, int jobs,
                               bool quiet) {
  const auto& specification = store.specification();
  campaign::RunOptions how;
  how.jobs = jobs;
  // The blocks of a shard depend on the number of shards alone.
  const auto block =
      campaign::block_size(specification, shard.is_all() ? thread_count(how.jobs) : shard.count);
  campaign::LocalTasks source(specification.tasks(), store.finished(), block, shard);
  ProgressLine line("campaign", quiet);
  const auto all = source.remaining();
  how.progress = [&](const campaign::RunSummary& done) {
    line.report(all > 0 ? double(done.tasks) / double(all) : 1.0, done.runs, "runs");
  };
  return campaign::run_campaign(specification, store, source, how, &interrupt_flag());
}

namespace {

int report_end(const CampaignOptions& options, const std::string& database,
               const campaign::RunSummary& summary) {
  // The signal that ended the run does not end this.
  print_status(options, campaign::Store::open(database));
  if (!summary.interrupted) return 0;
  report_error("interrupted; what was finished is stored. The same command continues.",
               "interrupted");
  return 130;
}

// One of several processes that mpirun or srun started.
int run_ranks(const CampaignOptions& options, const campaign::Launch& launch,
              const std::string& database) {
  campaign::RunOptions how;
  how.jobs = options.jobs.empty() ? 1 : jobs_from(options.jobs);
  FirstRank first;
  first.database = database;
  ProgressLine line("campaign", options.common.quiet);
  first.specification = [&] { return checked_specification(options); };
  first.progress = [&](long long done, long long all) {
    line.report(all > 0 ? double(done) / double(all) : 1.0, done, "tasks");
  };
  first.report = [&](const campaign::RunSummary& summary) {
    return report_end(options, database, summary);
  };
  return run_on_ranks(launch, first, how);
}

}  // namespace

std::string database_of(const CampaignOptions& options, const campaign::Shard& shard) {
  auto path = options.database;
  if (path.empty())
    path = std::filesystem::path(options.files.front()).filename().replace_extension(".db");
  return campaign::shard_path(path, shard);
}

campaign::Specification checked_specification(const CampaignOptions& options) {
  auto specification = campaign::Specification::read(options.files.front());
  if (!options.yes) campaign::require_few_runs(specification);
  return specification;
}

int plan_campaign(const CampaignOptions& options, const std::string&) {
  const auto specification = campaign::Specification::read(options.files.front());
  Results results(options.common, OnInterrupt::stop);
  const auto sheet = campaign::plan_sheet(campaign::plan_of(specification, true));
  record::SheetRows rows(sheet);
  report::write(rows, results.format(), results.stream(), results.style());
  results.finish();
  return 0;
}

int run_campaign(const CampaignOptions& options, const std::string&) {
  const auto shard =
      options.shard.empty() ? campaign::Shard{} : campaign::shard_from(options.shard);
  const auto database = database_of(options, shard);
  const auto jobs = jobs_from(options.jobs);
  const auto launch = campaign::launch_of_process();
  // A shard is the work of one process, whatever started it.
  if (shard.is_all() && launch.ranks > 1) return run_ranks(options, launch, database);
  const auto specification = checked_specification(options);
  campaign::RunSummary summary;
  {
    auto store = campaign::Store::create_or_open(database, specification, options.shard);
    if (shard.is_all()) campaign::adopt_ranks(store);
    summary = run_tasks(store, shard, jobs, options.common.quiet);
  }
  return report_end(options, database, summary);
}

}  // namespace clackers::cli
