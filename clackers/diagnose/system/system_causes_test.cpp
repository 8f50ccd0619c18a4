#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/testing/wrong_solvers.hpp"

namespace clackers::diagnose::testing {
namespace {

const std::vector<Fault>& all_faults() {
  static const auto all = faults();
  return all;
}
const std::vector<std::string>& all_right() {
  static const auto all = right_solvers();
  return all;
}

class FaultySolver : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FaultySolver, IsFoundWithItsValue) {
  const auto& fault = all_faults()[GetParam()];
  SCOPED_TRACE(fault.name);
  for (const bool fourth_order : {true, false}) {
    const auto which = cases::make("three-parameter", {{"N", 1.0}});
    auto problem = which.problem;
    std::string solver = fourth_order ? "method=rk4" : "method=newmark";
    ASSERT_TRUE(fault.put(problem, solver));
    const auto found = system_causes(solved(which, problem, solver, 0.2, 3).question());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].code, fault.code);
    if (!std::isnan(fault.value)) {
      EXPECT_NEAR(found[0].value, fault.value, fault.within());
    }
    EXPECT_GE(found[0].confidence, 0.7);
    EXPECT_GE(found[0].fact("gain"), 30.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FaultySolver, ::testing::Range<std::size_t>(0, faults().size()));

class CorrectSolver : public ::testing::TestWithParam<std::size_t> {};

TEST_P(CorrectSolver, HasNoCauseButItsPeriodError) {
  const auto& right = all_right()[GetParam()];
  SCOPED_TRACE(right);
  const auto which = GetParam() % 2 == 0 ? cases::make("three-parameter", {{"N", 1.0}})
                                         : cases::make("stop", {{"eta", 0.5}});
  for (const int count : {1, 3})
    for (const auto& one :
         system_causes(solved(which, which.problem, right, 0.4, count).question()))
      EXPECT_EQ(one.code, "period-error") << one.value << " " << one.unit;
}

INSTANTIATE_TEST_SUITE_P(All, CorrectSolver,
                         ::testing::Range<std::size_t>(0, right_solvers().size()));

TEST(SystemCauses, RestitutionIsTheValueItself) {
  const auto which = cases::make("stop", {{"eta", 0.5}});
  auto problem = which.problem;
  problem.contacts[0].restitution = 1.0;
  const auto found = system_causes(solved(which, problem, "method=rk4", 0.1, 3).question());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, "restitution-differs");
  EXPECT_NEAR(found[0].value, 1.0, 1e-5);
  EXPECT_EQ(found[0].fact("expected"), 0.5);
}

TEST(SystemCauses, OneFileNamesAFrequencyThatNoMethodMakes) {
  const auto which = cases::make("three-parameter", {{"N", 1.0}});
  auto problem = which.problem;
  problem.system.stiffness(1, 1) *= 1.05;
  const auto causes = [&](double turn) {
    return system_causes(solved(which, problem, "method=rk4", turn, 1).question());
  };
  const auto found = causes(0.1);
  ASSERT_EQ(codes(found), "frequency-differs");
  EXPECT_NEAR(found[0].value, 100.0 * (std::sqrt(1.05) - 1.0), 1e-3);
  EXPECT_LE(found[0].confidence, 0.9);
  EXPECT_EQ(found[0].fact("files"), 1.0);
  // (0.25)^2/2 is more than that.
  EXPECT_EQ(codes(causes(0.25)), "");
}

// By half a fast period and more.
TEST(SystemCauses, AClockThatStartsLateIsOneShiftOfTime) {
  const auto which = cases::make("three-parameter");
  for (const double late : {0.7, 1.0, 5.3})
    for (const int count : {1, 2})
      for (const bool has_v : {true, false}) {
        Files files{which};
        for (int i = 0; i < count; ++i) {
          const double h = 0.02 / (i + 1.0);
          auto rows = exact_rows(which, h, which.motion->end() - late - h);
          for (double& t : rows.t) t += late;
          if (!has_v) rows.v.clear();
          files.add(rows, h);
        }
        const auto found = system_causes(files.question());
        ASSERT_EQ(codes(found), "time-shifted") << late << count << has_v;
        EXPECT_EQ(found[0].unit, "s");
        EXPECT_NEAR(found[0].value, late, 1e-9);
      }
}

TEST(SystemCauses, WhatRoundingMakesIsNoCause) {
  const auto which = cases::make("three-parameter");
  Files files{which};
  for (const double h : {0.02, 0.01, 0.005}) files.add(exact_rows(which, h), h);
  EXPECT_TRUE(system_causes(files.question()).empty());
}

TEST(SystemCauses, PrintedDigitsAreNoCause) {
  const auto which = cases::make("three-parameter");
  auto problem = which.problem;
  problem.system.stiffness(0, 0) *= 1.0 + 1e-6;
  EXPECT_TRUE(system_causes(solved(which, problem, "method=rk4", 0.1, 3, 4).question()).empty());
}

TEST(SystemCauses, WhatIsWrongBesideRestitutionIsNamed) {
  const auto which = cases::make("stop");
  for (const bool of_damping : {true, false})
    for (const auto* solver : {"method=rk4", "method=newmark"}) {
      auto problem = which.problem;
      problem.contacts[0].restitution = 0.9;
      (of_damping ? problem.system.damping : problem.system.stiffness)(0, 0) *= 1.1;
      const auto found = system_causes(solved(which, problem, solver, 0.05, 3).question());
      const auto* beside = find(found, of_damping ? "damping-differs" : "frequency-differs");
      ASSERT_EQ(found.size(), 2u) << codes(found);
      EXPECT_EQ(found[0].code, "restitution-differs");
      EXPECT_NEAR(found[0].value, 0.9, 1e-3);
      ASSERT_NE(beside, nullptr) << codes(found);
      const double expected = of_damping ? 10.0 : 100.0 * (std::sqrt(1.1) - 1.0);
      EXPECT_NEAR(beside->value, expected, 0.02 * expected) << solver;
      EXPECT_GE(beside->confidence, sure);
    }
}

TEST(SystemCauses, WhatMakesNextToNothingBesideRestitutionIsNotNamed) {
  const auto which = cases::make("stop");
  auto problem = which.problem;
  problem.contacts[0].restitution = 0.9;
  problem.system.damping *= 1.001;
  EXPECT_EQ(codes(system_causes(solved(which, problem, "method=rk4", 0.05, 3).question())),
            "restitution-differs");
}

TEST(SystemCauses, AGapThatNoRowReachesIsNone) {
  const auto which = cases::make("three-parameter", {{"N", 1.0}, {"xi1", 0.0}});
  for (const auto* spring : {"300", "1000"})
    EXPECT_FALSE(find(system_causes(solved(which, which.problem,
                                           std::string("method=newmark spring=") + spring, 0.025, 3)
                                        .question()),
                      "gap-differs"))
        << spring;
}

TEST(SystemCauses, RestitutionIsFoundBesideImpactsAtTheEndsOfSteps) {
  const auto which = cases::make("three-parameter", {{"N", 2.0}});
  auto problem = which.problem;
  const std::string late = "method=rk4 contact=end-of-step";
  for (const auto& one : system_causes(solved(which, problem, late, 0.2, 3).question()))
    EXPECT_EQ(one.code, "period-error") << one.value << " gain " << one.fact("gain");
  problem.contacts[0].restitution = 0.9;
  const auto found = system_causes(solved(which, problem, late, 0.2, 3).question());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, "restitution-differs");
  EXPECT_NEAR(found[0].value, 0.9, 1e-3);
}

}  // namespace
}  // namespace clackers::diagnose::testing
