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
  campaign::stop_all_ranks(transport);
  throw;
}

void report_failures(const campaign::RanksSummary& summary) {
  for (const auto& result : summary.failures)
    report_error(fmt::format("rank {}: {}", result.rank, result.failure), result.code);
}

// The store is closed at the end.
campaign::RanksSummary run_first(campaign::Transport& transport, const FirstRank& first,
                                 const campaign::RunOptions& options) {
  auto opened = open_first(transport, first);
  return campaign::run_first_rank(transport, opened.specification, opened.store, options,
                                  interrupt_flag(), first.progress);
}

int first_rank(campaign::Transport& transport, const FirstRank& first,
               const campaign::RunOptions& options) {
  const auto summary = run_first(transport, first, options);
  const int exit_code = first.report(summary);
  report_failures(summary);
  return summary.failures.empty() ? exit_code : 4;
}

}  // namespace

int run_on_ranks(const campaign::Launch& launch, const FirstRank& first,
                 const campaign::RunOptions& options) {
  const auto mpi = start_mpi(launch);
  int exit_code = 0;
  try {
    if (mpi->rank() == 0)
      exit_code = first_rank(*mpi, first, options);
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
