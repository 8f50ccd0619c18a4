#include "clackers/campaign/ranks/launch.hpp"

#include <cstdlib>
#include <limits>

#include "clackers/base/number.hpp"

namespace clackers::campaign {
namespace {

int whole(const char* text) {
  const auto number = text ? whole_number(text).value_or(1) : 1;
  return number > 0 && number <= std::numeric_limits<int>::max() ? int(number) : 1;
}

}  // namespace

Launch launch_of(const Environment& environment) {
  if (const auto* size = environment("OMPI_COMM_WORLD_SIZE")) return {whole(size), true, "mpirun"};
  if (const auto* size = environment("PMI_SIZE")) return {whole(size), true, "mpiexec"};
  const bool with_mpi = environment("PMIX_RANK") || environment("PMI_RANK");
  return {whole(environment("SLURM_STEP_NUM_TASKS")), with_mpi, "srun"};
}

Launch launch_of_process() {
  return launch_of([](const char* name) -> const char* { return std::getenv(name); });
}

}  // namespace clackers::campaign
