// Gives out empty tasks to the ranks of mpirun: clackers_dispatch FOLDER TASKS. Each rank writes its
// blocks into FOLDER/RANK, a line "first last" each; test_dispatch.py reads them.
#include <atomic>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

#include "clackers/base/error.hpp"
#include "clackers/campaign/ranks/client.hpp"
#include "clackers/campaign/ranks/server.hpp"
#include "cli/cluster/mpi_transport.hpp"

namespace {

using namespace clackers;

// As large as no rank takes unasked, so that it goes another way than short messages.
const std::string announcement(100000, 'x');

void write_blocks(const std::string& path, auto next) {
  std::ofstream file(path);
  while (const auto block = next()) file << block->first << ' ' << block->last << '\n';
}

int run(cli::MpiTransport& mpi, const std::string& folder, long long tasks) {
  const auto path = folder + "/" + std::to_string(mpi.rank());
  int exit_code = 0;
  if (mpi.rank() == 0) {
    campaign::Dispatcher dispatcher({{0, tasks}}, {.ranks = mpi.size(), .block_seconds = 1e-4});
    std::thread own([&] {
      write_blocks(path, [&] { return dispatcher.take(0, campaign::steady_seconds()); });
    });
    campaign::serve(mpi, dispatcher, announcement, false);
    own.join();
  } else {
    campaign::Client client(mpi);
    if (client.greet() != announcement) exit_code = 1;
    write_blocks(path, [&] { return client.next(); });
    client.leave({});
  }
  mpi.finish();
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const auto mpi = cli::start_mpi(campaign::launch_of_process());
    return run(*mpi, argv[1], std::stoll(argv[2]));
  } catch (const Error& error) {
    std::cerr << error.what() << " [" << error.code().name() << "]\n";
    return 2;
  }
}
