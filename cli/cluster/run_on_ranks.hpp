#pragma once

#include <functional>
#include <string>

#include "clackers/campaign/ranks/launch.hpp"
#include "clackers/campaign/ranks/run_ranks.hpp"

namespace clackers::cli {

/// The part of a campaign's run that rank 0 alone does before the work begins: reads the specification,
/// opens the database, reports. Other ranks never call it.
struct FirstRank {
  std::function<campaign::Specification()> specification;
  std::string database;
  std::function<void(const campaign::RanksSummary&)> report;
};

/// Runs a campaign on the ranks of a launcher; every rank calls it with the same arguments. Returns the
/// exit code of this rank; only rank 0 prints and fails.
int run_on_ranks(const campaign::Launch& launch, const FirstRank& first,
                 const campaign::RunOptions& options);

}  // namespace clackers::cli
