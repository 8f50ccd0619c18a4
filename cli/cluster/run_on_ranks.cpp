#include "cli/cluster/run_on_ranks.hpp"

#include <fmt/format.h>

#include "cli/cluster/mpi_transport.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"

namespace clackers::cli {
namespace {

struct Opened {
  campaign::Specification specification;
  campaign::Store store;
};

// What rank 0 refuses ends the other ranks, too.
Opened open_first(campaign::Transport& transport, const FirstRank& first) try {
  auto specification = first.specification();
  auto store = campaign::Store::create_or_open(first.database, specification);
  campaign::adopt_ranks(store);
  return {std::move(specification), std::move(store)};
} catch (...) {
  campaign::dismiss(transport);
  throw;
}

int report_failures(const campaign::RanksSummary& summary) {
  for (const auto& departure : summary.failures)
    report_error(fmt::format("rank {}: {}", departure.rank, departure.failure), departure.code);
  return summary.failures.empty() ? 0 : 4;
}

int run_first(campaign::Transport& transport, const FirstRank& first,
              const campaign::RunOptions& options) {
  auto opened = open_first(transport, first);
  const auto summary = campaign::run_first_rank(transport, opened.specification, opened.store,
                                                options, interrupt_flag());
  if (first.report) first.report(summary);
  if (summary.interrupted) throw Interrupted();
  return report_failures(summary);
}

}  // namespace

int run_on_ranks(const campaign::Launch& launch, const FirstRank& first,
                 const campaign::RunOptions& options) {
  const auto mpi = start_mpi(launch);
  int exit_code = 0;
  try {
    if (mpi->rank() == 0)
      exit_code = run_first(*mpi, first, options);
    else
      campaign::run_other_rank(*mpi, options, interrupt_flag());
  } catch (...) {
    mpi->finish();
    throw;
  }
  mpi->finish();
  return exit_code;
}

}  // namespace clackers::cli
