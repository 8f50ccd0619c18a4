#pragma once

#include <string>
#include <vector>

#include "clackers/campaign/run.hpp"
#include "clackers/campaign/specification.hpp"
#include "clackers/campaign/task_source.hpp"
#include "cli/options.hpp"

// What `clackers campaign` does with its files, an action each.
namespace clackers::cli {

struct CampaignOptions {
  CommonOptions common;
  std::string action;
  std::vector<std::string> files;  ///< the first is the specification or the database
  std::string database, shard, jobs, table;
  bool yes = false, times = false;
  std::string shards;               ///< of submit
  std::vector<std::string> sbatch;  ///< of submit
  bool slurm = false, dry_run = false;
};

/// Each returns the exit code; `line` is the whole command line.
using CampaignAction = int (*)(const CampaignOptions& options, const std::string& line);

int plan_campaign(const CampaignOptions& options, const std::string& line);
int run_campaign(const CampaignOptions& options, const std::string& line);
int submit_campaign(const CampaignOptions& options, const std::string& line);
int show_status(const CampaignOptions& options, const std::string& line);
int merge_shards(const CampaignOptions& options, const std::string& line);
int export_rows(const CampaignOptions& options, const std::string& line);
int query_database(const CampaignOptions& options, const std::string& line);
int report_campaign(const CampaignOptions& options, const std::string& line);

/// The number of --jobs, 0 where it is not given. Throws InputError.
int jobs_from(const std::string& text);

/// Runs the unfinished tasks of a store, or of a shard of it, with a progress line.
campaign::RunSummary run_tasks(campaign::Store& store, const campaign::Shard& shard, int jobs,
                               bool quiet);

/// The database of a specification: --database, or the name of its file with the ending .db in the
/// current folder; of a shard its own.
std::string database_of(const CampaignOptions& options, const campaign::Shard& shard = {});

/// The specification that is given. Throws InputError (too-many-runs) for a large one without --yes.
campaign::Specification checked_specification(const CampaignOptions& options);

/// A database for reading, which a signal ends.
campaign::Store open_database(const std::string& path);

/// Prints how far a database is: tasks, verdicts, and the command that goes on.
void print_status(const CampaignOptions& options, const campaign::Store& store);

}  // namespace clackers::cli
