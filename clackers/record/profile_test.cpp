#include "clackers/record/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/record/record.hpp"

namespace clackers::record {
namespace {

// Four levels of one run each, errors 0.05, 0.005, 0.0005, 0.00005 times `factor`, and steps
// 100, 200, 400, 800 times `price`.
Subject method(const std::string& name, double factor, long long price) {
  Subject result;
  result.name = name;
  for (int level = 0; level < 4; ++level) {
    measure::RunScore run;
    run.step = 0.1 * std::exp2(-level);
    run.finished = true;
    run.u_error = factor * 0.05 * std::pow(10.0, -level);
    run.work.steps = price * 100 * (1LL << level);
    run.work.force_evaluations = 2 * run.work.steps;
    run.seconds = 1.0;
    result.levels.push_back({run.step, {{run, {}, {}, {}}}});
  }
  return result;
}

CaseRecord study_of(const std::string& name, std::vector<Subject> methods) {
  CaseRecord record;
  record.problem.name = name;
  record.subjects = std::move(methods);
  return record;
}

TEST(Profiles, HaveTheErrorsThatSomeMethodReachesAsTasks) {
  const auto record = study_of("stop", {method("a", 1.0, 1), method("b", 100.0, 1)});
  const auto profiles = profiles_of({&record, 1});
  ASSERT_FALSE(profiles.empty());
  EXPECT_EQ(profiles[0].tasks,
            (std::vector<std::string>{"stop: error in u <= 1e-01", "stop: error in u <= 1e-02",
                                      "stop: error in u <= 1e-03", "stop: error in u <= 1e-04"}));
  ASSERT_EQ(profiles[0].methods.size(), 2u);
  EXPECT_EQ(profiles[0].methods[0].ratios, (std::vector<double>{1, 1, 1, 1}));
  // Its finest error is 0.005: two levels later than the other, and then never.
  EXPECT_EQ(profiles[0].methods[1].ratios, (std::vector<double>{4, 4, INFINITY, INFINITY}));
  EXPECT_EQ(profiles[0].methods[1].failed, 2);
}

TEST(Profiles, AreByCountersThatEveryMethodHasAndNotByTime) {
  const auto record = study_of("stop", {method("a", 1.0, 1), method("b", 1.0, 3)});
  const auto profiles = profiles_of({&record, 1});
  ASSERT_EQ(profiles.size(), 2u);
  EXPECT_EQ(profiles[0].counter, "steps");
  EXPECT_EQ(profiles[1].counter, "force_evaluations");
  EXPECT_EQ(profiles[1].methods[1].ratios[0], 3.0);
}

TEST(Profiles, CountARefusalAsAFailure) {
  auto record = study_of("stop", {method("a", 1.0, 1), {}});
  record.subjects[1].name = "b";
  record.subjects[1].refusal = "cannot";
  const auto profile = profiles_of({&record, 1}).at(0);
  EXPECT_EQ(profile.methods[1].failed, 4);
  EXPECT_TRUE(profile.methods[1].steps.empty());
}

TEST(Profiles, GoOverAllCases) {
  const CaseRecord records[] = {study_of("stop", {method("a", 1.0, 1), method("b", 1.0, 2)}),
                                study_of("sdof", {method("a", 1.0, 4), method("b", 1.0, 2)})};
  const auto profile = profiles_of(records).at(0);
  ASSERT_EQ(profile.tasks.size(), 8u);
  EXPECT_EQ(profile.tasks[4], "sdof: error in u <= 1e-01");
  EXPECT_EQ(profile.methods[0].ratios, (std::vector<double>{1, 1, 1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(profile.methods[1].ratios, (std::vector<double>{2, 2, 2, 2, 1, 1, 1, 1}));
}

TEST(Profiles, DoNotExistOfInterruptedStudiesOrWhereNothingIsReached) {
  auto record = study_of("stop", {method("a", 1.0, 1)});
  record.subjects[0].complete = false;
  EXPECT_TRUE(profiles_of({&record, 1}).empty());
  const auto hopeless = study_of("stop", {method("a", 1e6, 1)});
  EXPECT_TRUE(profiles_of({&hopeless, 1}).empty());
  EXPECT_TRUE(profiles_of({}).empty());
}

}  // namespace
}  // namespace clackers::record
