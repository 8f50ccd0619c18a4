#include "clackers/study/check/named_resolution.hpp"

#include <gtest/gtest.h>

namespace clackers::study {
namespace {

TEST(NamedResolution, StepFollowsAWordForIt) {
  const auto step = [](std::string_view path) { return named_resolution(path).step; };
  EXPECT_EQ(step("h0.01.csv"), 0.01);
  EXPECT_EQ(step("/data/h5/run-h=1e-3.txt"), 1e-3);
  EXPECT_EQ(step("disp_h_0.005.out"), 0.005);
  EXPECT_EQ(step("h.25"), 0.25);
  EXPECT_EQ(step("hh0.5-h0.25.csv"), 0.25);
  EXPECT_EQ(step("DT-0.002.dat"), 0.002);
  EXPECT_EQ(step("dt=0.01_rk4.csv"), 0.01);
  EXPECT_EQ(step("step_1e-3.csv"), 1e-3);
  EXPECT_EQ(step("timestep0p005.csv"), 0.005);
  EXPECT_FALSE(step("/h0.1/run.csv"));
  EXPECT_FALSE(step("graph0.1.csv"));
  EXPECT_FALSE(step("h0.csv"));
  EXPECT_FALSE(step("history.csv"));
  EXPECT_FALSE(step("n400.csv"));
}

TEST(NamedResolution, NumberOfStepsIsWhole) {
  const auto count = [](std::string_view path) { return named_resolution(path).count; };
  EXPECT_EQ(count("N400.csv"), 400.0);
  EXPECT_EQ(count("run_n=12800.txt"), 12800.0);
  EXPECT_EQ(count("nsteps_100.csv"), 100.0);
  EXPECT_FALSE(count("N2_h0.01.csv"));
  EXPECT_FALSE(count("n40.5"));
  EXPECT_FALSE(count("run400.csv"));
}

TEST(NamedResolution, ToleranceIsSmall) {
  const auto tolerance = [](std::string_view path) { return named_resolution(path).tolerance; };
  EXPECT_EQ(tolerance("rtol1e-06.csv"), 1e-6);
  EXPECT_EQ(tolerance("lsoda_tol_1e-6.csv"), 1e-6);
  EXPECT_EQ(tolerance("atol=1e-9,rtol=1e-7.csv"), 1e-9);
  EXPECT_FALSE(tolerance("tol3.csv"));
  EXPECT_FALSE(tolerance("h0.01.csv"));
}

// Histories of a case of 20 s with a fast period of 0.7 s, from names and times between rows.
NamedSteps steps_of(std::initializer_list<std::pair<const char*, double>> files) {
  std::vector<NamedHistory> set;
  for (const auto& [name, spacing] : files) set.push_back({named_resolution(name), spacing});
  return named_steps(set, 0.7, 20.0);
}
using Named = std::vector<std::optional<double>>;

TEST(NamedSteps, OfASetArePreferredToRowsOfDenseOutput) {
  EXPECT_EQ(steps_of({{"h0.02", 0.001}, {"h0.01", 0.001}}).steps, (Named{0.02, 0.01}));
  EXPECT_EQ(steps_of({{"h0.02", 0.005}, {"h0.01", 0.0025}}).steps, (Named{0.02, 0.01}));
  EXPECT_EQ(steps_of({{"n1000", 0.001}, {"n2000", 0.001}}).steps, (Named{0.02, 0.01}));
}

TEST(NamedSteps, ThatAreCountersAreNotTaken) {
  EXPECT_EQ(steps_of({{"h1", 0.02}, {"h2", 0.01}, {"h3", 0.005}}).steps, Named(3));
  EXPECT_EQ(steps_of({{"h0.1", 0.02}, {"h0.2", 0.01}}).steps, Named(2)) << "longer, closer rows";
  EXPECT_EQ(steps_of({{"h0.02", 0.02}, {"h0.02b", 0.01}}).steps, (Named{0.02, {}}));
}

TEST(NamedSteps, OfOneFileAreAtMostTheTimeBetweenRows) {
  EXPECT_EQ(steps_of({{"h0.01", 0.01}}).steps, Named{0.01});
  EXPECT_EQ(steps_of({{"h0.001", 0.01}}).steps, Named{0.001}) << "every tenth step";
  EXPECT_EQ(steps_of({{"h0.02", 0.01}}).steps, Named{std::nullopt});
}

TEST(NamedSteps, TolerancesMakeALadderWhereStepsDoNotDiffer) {
  const auto found = steps_of({{"rtol1e-3", 0.01}, {"rtol1e-6", 0.01}});
  EXPECT_TRUE(found.by_tolerance);
  EXPECT_EQ(found.steps, (Named{1e-3, 1e-6}));
  EXPECT_TRUE(steps_of({{"h0.01_tol1e-3", 0.01}, {"h0.01_tol1e-6", 0.01}}).by_tolerance);
  EXPECT_FALSE(steps_of({{"h0.02_tol1e-3", 0.01}, {"h0.01_tol1e-4", 0.01}}).by_tolerance);
  EXPECT_FALSE(steps_of({{"tol1e-3", 0.01}}).by_tolerance);
  EXPECT_FALSE(steps_of({{"tol1e-3", 0.01}, {"run", 0.01}}).by_tolerance);
}

}  // namespace
}  // namespace clackers::study
