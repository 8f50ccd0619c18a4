#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "clackers/campaign/ranks/server.hpp"
#include "clackers/campaign/ranks/transport.hpp"
#include "clackers/campaign/run.hpp"

// A campaign on the ranks of one launcher. Rank 0 writes into the database, each other rank into its
// shard, rank_path(). No rank waits for another but for an answer of rank 0.
namespace clackers::campaign {

/// What all ranks did.
struct RanksSummary : RunSummary {
  std::vector<RankResult>
      failures;  ///< of other ranks than 0; their tasks are left for the next start
};

/// Called with the tasks of blocks that any rank has finished, and with all that this run has to do.
using RanksProgress = std::function<void(long long done, long long all)>;

/// The work of rank 0: computes, too, on options.jobs threads, answers the other ranks meanwhile, and
/// merges their shards into the store at the end. Throws what run_campaign() throws, after the other
/// ranks have left; their shards then stay.
RanksSummary run_first_rank(Transport& transport, const Specification& specification, Store& store,
                            const RunOptions& options, const std::atomic<bool>& interrupt,
                            const RanksProgress& progress = {});

/// The work of a rank other than 0. Its failure is for rank 0 to report.
void run_other_rank(Transport& transport, const RunOptions& options,
                    const std::atomic<bool>& interrupt);

}  // namespace clackers::campaign
