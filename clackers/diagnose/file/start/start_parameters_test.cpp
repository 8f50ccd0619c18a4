#include "clackers/diagnose/start_parameters.hpp"

#include <gtest/gtest.h>

#include "clackers/diagnose/testing/histories.hpp"
#include "clackers/methods/testing/runs.hpp"

namespace clackers::diagnose {
namespace {

using testing::exact_rows;

std::string found_for(const char* name, const model::Trajectory& rows) {
  const auto problem = cases::make(name);
  const FirstRows opening{0.01, rows, std::vector<bool>(std::size_t(rows.dof), true), 0.0, {}};
  std::string text;
  for (const auto& one :
       start_parameters(opening, problem.problem, *problem.motion, study::family_of(problem))) {
    char value[32];
    std::snprintf(value, sizeof value, "%.17g", one.value);
    text += (text.empty() ? "" : ",") + one.name + "=" + value;
  }
  return text;
}

std::string found_for(const char* name, const cases::Settings& settings) {
  return found_for(name, exact_rows(cases::make(name, settings), 0.01));
}

TEST(StartParameters, FindsOne) {
  for (const char* N : {"0", "5", "20"})
    EXPECT_EQ(found_for("three-parameter", {{"N", std::atof(N)}}), std::string("N=") + N);
  for (const char* xi1 : {"0", "0.25"})
    for (const char* name : {"three-parameter", "stop", "sdof", "symmetric-pair"})
      EXPECT_EQ(std::atof(found_for(name, {{"xi1", std::atof(xi1)}}).substr(4).c_str()),
                std::atof(xi1))
          << name;
}

TEST(StartParameters, FindsOneOfMany) {
  EXPECT_EQ(found_for("synchronized-pair", {{"r", 2.0}}), "r=2");
}

TEST(StartParameters, FindsTwo) {
  EXPECT_EQ(found_for("three-parameter", {{"N", 5.0}, {"xi1", 0.25}}), "N=5,xi1=0.25");
  EXPECT_EQ(found_for("two-parameter", {{"N", 1.0}, {"xi1", 0.125}}), "N=1,xi1=0.125");
}

TEST(StartParameters, FindsNoneForFilesThatAreReadWrongly) {
  auto rows = exact_rows(cases::make("three-parameter"), 0.01);
  for (auto* values : {&rows.u, &rows.v})
    for (double& x : *values) x *= 1000.0;
  EXPECT_EQ(found_for("three-parameter", rows), "");
  EXPECT_EQ(found_for("synchronized-pair", rows), "");
}

// left and right are numbers of buildings.
TEST(StartParameters, NeverMakeAnotherNumberOfMasses) {
  auto rows = exact_rows(cases::make("buildings"), 0.1);
  rows.v[0] *= 1.5;
  EXPECT_TRUE(found_for("buildings", rows).ends_with(",V=1.5"));
}

// Damped, though it starts with the velocities of the undamped case.
TEST(StartParameters, TakesAStartAtRestForNoUndampedSystem) {
  for (const char* name : {"three-parameter", "stop", "sdof", "symmetric-pair"}) {
    auto problem = cases::make(name).problem;
    problem.start.v.setZero();
    EXPECT_EQ(found_for(name, methods::runs::run("rk4", problem, 0.01).trajectory), "") << name;
    EXPECT_EQ(found_for(name, {{"xi1", 0.0}}), "xi1=0") << name;
  }
}

}  // namespace
}  // namespace clackers::diagnose
