#pragma once

#include <string>
#include <vector>

namespace clackers::cli {

/// What `campaign submit` is asked for; texts as they were typed, empty where an option is not given.
struct SubmitOptions {
  std::string specification, database;
  std::string shards, jobs;
  std::vector<std::string> sbatch;  ///< "time=01:00:00"
  bool slurm = false, dry_run = false, yes = false, quiet = false;
};

/// Writes DATABASE.sbatch and DATABASE.merge.sbatch and, without dry_run, submits them: the job that
/// merges waits for all elements of the array. Throws InputError for options that do not fit, and
/// FileError (scheduler-failed) with what sbatch says.
void submit_campaign(const SubmitOptions& options);

}  // namespace clackers::cli
