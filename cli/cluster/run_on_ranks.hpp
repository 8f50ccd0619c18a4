#pragma once

#include <functional>
#include <string>

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

}  // namespace clackers::cli
