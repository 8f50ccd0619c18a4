#pragma once

#include <functional>
#include <string>

namespace clackers::campaign {

/// What the environment says about the launcher of this process.
struct Launch {
  int ranks = 1;         ///< processes that one launcher started; 1 where there is no launcher
  bool with_mpi = true;  ///< they can reach each other
  std::string launcher;  ///< "mpirun", "srun"
};

/// The value of a variable of the environment, nullptr where it is not set.
using Environment = std::function<const char*(const char*)>;

/// From OMPI_COMM_WORLD_SIZE (Open MPI), PMI_SIZE (MPICH and others), or SLURM_STEP_NUM_TASKS with
/// PMIX_RANK or PMI_RANK (srun --mpi). A step of srun without either has no MPI. The number of tasks
/// of a batch script (SLURM_NTASKS) says nothing: one process runs it.
Launch launch_of(const Environment& environment);
/// The same from this process' environment.
Launch launch_of_process();

}  // namespace clackers::campaign
