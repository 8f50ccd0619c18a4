#include "clackers/campaign/ranks/launch.hpp"

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace clackers::campaign {
namespace {

int whole(const char* text) {
  if (!text) return 1;
  const std::string_view digits = text;
  int number = 1;
  const auto end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  return read.ec == std::errc() && read.ptr == end && number > 0 ? number : 1;
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
