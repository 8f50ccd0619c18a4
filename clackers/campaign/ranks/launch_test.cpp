#include "clackers/campaign/ranks/launch.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace clackers::campaign {
namespace {

Launch launch_with(const std::map<std::string, std::string>& variables) {
  return launch_of([&](const char* name) -> const char* {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

TEST(Launch, WithoutALauncherOneProcess) {
  EXPECT_EQ(launch_with({}).ranks, 1);
  EXPECT_EQ(launch_with({{"OMPI_COMM_WORLD_SIZE", "many"}}).ranks, 1);
}

TEST(Launch, MpirunAndMpiexec) {
  const auto launch = launch_with({{"OMPI_COMM_WORLD_SIZE", "64"}, {"SLURM_STEP_NUM_TASKS", "2"}});
  EXPECT_EQ(launch.ranks, 64);
  EXPECT_TRUE(launch.with_mpi);
  EXPECT_EQ(launch.launcher, "mpirun");
  EXPECT_EQ(launch_with({{"PMI_SIZE", "3"}, {"PMI_RANK", "0"}}).ranks, 3);
}

TEST(Launch, StepOfSrunWithAndWithoutMpi) {
  const auto with = launch_with({{"SLURM_STEP_NUM_TASKS", "4"}, {"PMIX_RANK", "0"}});
  EXPECT_EQ(with.ranks, 4);
  EXPECT_TRUE(with.with_mpi);
  const auto without = launch_with({{"SLURM_STEP_NUM_TASKS", "4"}});
  EXPECT_EQ(without.ranks, 4);
  EXPECT_FALSE(without.with_mpi);
}

TEST(Launch, BatchScriptOfManyTasksIsOneProcess) {
  EXPECT_EQ(launch_with({{"SLURM_NTASKS", "16"}, {"SLURM_PROCID", "0"}}).ranks, 1);
}

}  // namespace
}  // namespace clackers::campaign
