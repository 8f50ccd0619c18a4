#pragma once

#include <memory>

#include "clackers/campaign/ranks/launch.hpp"
#include "clackers/campaign/ranks/transport.hpp"

namespace clackers::cli {

/// MPI between its start and finish(). Functions may be called from several threads, one at a time.
class MpiTransport : public campaign::Transport {
 public:
  /// Ends MPI: waits, with little load, until all ranks call it. A process that ends without it ends
  /// the others, too, by its launcher.
  virtual void finish() = 0;
};

/// MPI_Init, in each of the processes that were launched. Throws InputError (no-mpi) where this build
/// or the launcher has no MPI, or MPI sees another number of ranks than the launcher started.
std::unique_ptr<MpiTransport> start_mpi(const campaign::Launch& launch);

}  // namespace clackers::cli
