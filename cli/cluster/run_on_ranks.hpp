#pragma once

#include <functional>
#include <string>
#include <vector>

#include "clackers/campaign/ranks/launch.hpp"
#include "clackers/campaign/ranks/run_ranks.hpp"

namespace clackers::cli {

/// What rank 0 alone does.
struct FirstRank {
  std::function<campaign::Specification()> specification;
  std::string database;
  campaign::RanksProgress progress;
  std::function<int(const campaign::RunSummary&)> report;  ///< returns the exit code
};

/// Runs a campaign on the ranks of a launcher; every rank calls it with the same arguments. Returns the
/// exit code of this rank; only rank 0 prints and fails.
int run_on_ranks(const campaign::Launch& launch, const FirstRank& first,
                 const campaign::RunOptions& options);

/// A campaign as a job array of Slurm, an element a shard, and a job behind it that merges the shards.
/// Paths are absolute.
struct BatchJob {
  std::string program;  ///< this command
  std::string folder;   ///< where relative paths of the specification begin
  std::string specification, database;
  long long shards = 1;
  long long jobs = 1;     ///< threads of an element
  bool is_large = false;  ///< passes --yes on
  std::vector<std::string>
      options;  ///< of sbatch, without dashes: "time=01:00:00"; they go before ours
};

/// The script of the array. An element that is started again, by hand or by Slurm when its node fails,
/// goes on where it stopped. Throws InputError (bad-syntax) for paths and options of several lines.
std::string array_script(const BatchJob& job);
/// The script of the job that merges.
std::string merge_script(const BatchJob& job);

}  // namespace clackers::cli
