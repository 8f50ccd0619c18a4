#include <gtest/gtest.h>

#include <algorithm>

#include "clackers/assess/metrics/metric.hpp"
#include "clackers/study/cause_metrics.hpp"
#include "clackers/study/verify.hpp"

// What a study measures beside its ladders: metrics, and what the runs say without the reference.
namespace clackers::study {
namespace {

// A mass above a stop, five levels of two steps: milliseconds.
VerifyRequest small(std::vector<std::string> methods) {
  VerifyRequest request;
  request.methods = std::move(methods);
  request.case_name = "stop";
  request.settings = {{"t_end", 8.0}};
  request.plan = {0.1, 5, 2};
  return request;
}

TEST(Verify, MeasuresAllMetricsOfTheFirstRunOfTheFinestLevel) {
  const auto record = verify(small({"newmark"}));
  const auto& method = record.methods[0];
  const auto& finest = method.ladder[4].runs[0];
  EXPECT_EQ(method.metrics_step, finest.step);
  ASSERT_EQ(method.metrics.size(), assess::metrics().size() + cause_metrics().size());
  const auto found = std::ranges::find(method.metrics, "u-max-relative", &MetricResult::name);
  EXPECT_EQ(found->value, finest.u_error);  // the same definition, measured twice
}

TEST(Verify, MeasuresMetricsOfTheFinestLevelThatCanBeStored) {
  auto request = small({"rk4"});
  request.plan = {4e-5, 2, 1};  // 200 000 and 400 000 steps
  const auto method = verify(request).methods[0];
  EXPECT_EQ(method.metrics_step, method.ladder[0].runs[0].step);
  EXPECT_FALSE(method.metrics.empty());
  request.plan = {2e-5, 1, 1};
  const auto long_run = verify(request).methods[0];
  EXPECT_EQ(long_run.metrics_step, 0.0);
  EXPECT_TRUE(long_run.metrics.empty());
}

TEST(Verify, MeasuresNoMetricsOfARunThatFailed) {
  auto request = small({"central-difference"});
  request.plan = {4.0, 1, 1};  // twice its stability limit
  request.settings = {{"t_end", 4000.0}};
  const auto method = verify(request).methods[0];
  ASSERT_FALSE(method.ladder[0].runs[0].finished);
  EXPECT_TRUE(method.metrics.empty());
  EXPECT_EQ(method.metrics_step, 0.0);
}

TEST(Verify, SetsWhatTheRunsSayOfThemselvesBesideTheReference) {
  auto request = small({"rk4", "newmark+penalty"});
  request.plan = {0.005, 6, 2};  // the contact is resolved from the first level on
  request.settings = {{"t_end", 6.0}};
  const auto record = verify(request);
  const auto& rk4 = *record.methods[0].self_convergence;
  EXPECT_EQ(rk4.order, 4.0);
  EXPECT_FALSE(rk4.against_reference.would_have_lied) << rk4.against_reference.sentence;
  // A penalty spring claims a floor and no order: its integrator's is expected.
  const auto& penalty = *record.methods[1].self_convergence;
  EXPECT_EQ(record.methods[1].claim.order, 0.0);
  EXPECT_EQ(penalty.order, 2.0);
  EXPECT_TRUE(penalty.against_reference.would_have_lied) << penalty.against_reference.sentence;
  EXPECT_EQ(penalty.against_reference.reason, "wrong-limit");
}

TEST(Verify, HoldsDifferencesToTheClaimThroughImpactsBeforeTheSmoothOrder) {
  const auto record = verify(small({"newmark+reversal"}));  // order 2 in smooth motion
  EXPECT_EQ(record.methods[0].self_convergence->order, 1.0);
}

TEST(Verify, ComparesTheEndsOfRunsWithTheTrueEnd) {
  const auto record = verify(small({"newmark"}));
  const auto& method = record.methods[0];
  ASSERT_TRUE(method.self_convergence.has_value());
  const auto& errors = method.self_convergence->errors;
  ASSERT_EQ(errors.errors.size(), 5u);
  for (std::size_t l = 0; l < 5; ++l) {
    // The error at the end is one of those whose maximum u_error is.
    EXPECT_GT(errors.errors[l], 0.0);
    EXPECT_LE(errors.errors[l],
              std::max(method.ladder[l].runs[0].u_error, method.ladder[l].runs[1].u_error));
  }
  EXPECT_NEAR(errors.order, 2.0, 0.2);
}

TEST(Verify, ProfilesItsMethodsOverTheErrorsTheyReach) {
  const auto record = verify(small({"rk4", "newmark"}));
  ASSERT_FALSE(record.profiles.empty());
  EXPECT_EQ(record.profiles[0].counter, "steps");
  EXPECT_EQ(record.profiles[0].tasks[0], "stop: error in u <= 1e-01");
  ASSERT_EQ(record.profiles[0].methods.size(), 2u);
  EXPECT_EQ(record.profiles[0].methods[0].failed, 0)
      << "of higher order, it reaches what is reached";
  EXPECT_GT(record.profiles[0].methods[1].failed, 0);
}

}  // namespace
}  // namespace clackers::study
