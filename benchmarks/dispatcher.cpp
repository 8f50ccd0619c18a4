// How many empty tasks a second rank 0 gives out in blocks of one task; dispatcher.py starts it with
// mpirun. Prints the seconds.
#include <fmt/format.h>

#include <cstdlib>

#include "clackers/campaign/ranks/client.hpp"
#include "clackers/campaign/ranks/server.hpp"
#include "cli/cluster/mpi_transport.hpp"

namespace {

using namespace clackers;

// Takes all tasks there are; they are empty.
template <class Next>
long long take_all(Next next) {
  long long tasks = 0;
  while (const auto block = next()) tasks += block->size();
  return tasks;
}

// Rank 0 takes tasks only if it is alone: its own requests are no messages.
long long give_all(cli::MpiTransport& mpi, campaign::Dispatcher& dispatcher) {
  if (mpi.size() == 1)
    return take_all([&] { return dispatcher.take(0, campaign::steady_seconds()); });
  long long tasks = 0;
  for (const auto& departure : campaign::serve(mpi, dispatcher, "empty tasks", false))
    tasks += departure.summary.tasks;
  return tasks;
}

int time_of_tasks(cli::MpiTransport& mpi, long long tasks) {
  constexpr double no_time = 1e-12;  // [s]: no rank gets more than one task at a time
  campaign::Dispatcher dispatcher({{0, tasks}}, {mpi.size(), 1, no_time});
  const auto start = campaign::steady_seconds();
  const bool all = give_all(mpi, dispatcher) == tasks;
  fmt::print("{:.6f}\n", campaign::steady_seconds() - start);
  return all ? 0 : 1;
}

int work(cli::MpiTransport& mpi) {
  campaign::Client client(mpi);
  client.greet();
  client.leave({take_all([&] { return client.next(); })});
  return 0;
}

}  // namespace

// The argument is the number of tasks.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto mpi = cli::start_mpi(campaign::launch_of_process());
  const int exit_code = mpi->rank() == 0 ? time_of_tasks(*mpi, std::atoll(argv[1])) : work(*mpi);
  mpi->finish();
  return exit_code;
}
