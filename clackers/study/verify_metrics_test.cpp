#include <gtest/gtest.h>

#include <algorithm>

#include "clackers/measure/metrics/metric.hpp"
#include "clackers/study/verify.hpp"

// What a study measures beside its levels: metrics, and what the runs say without the reference.
namespace clackers::study {
namespace {

// A mass above a stop, five levels of two steps: milliseconds.
VerifyRequest small_metrics(std::vector<std::string> methods) {
  VerifyRequest request;
  request.methods = std::move(methods);
  request.cases = {"stop"};
  request.settings = {{"t_end", 8.0}};
  request.plan = {0.1, 5, 2};
  return request;
}

TEST(Verify, MeasuresAllMetricsOfTheFirstRunOfTheFinestLevel) {
  const auto record = verify(small_metrics({"newmark"}));
  const auto& finest = record.cases[0].subjects[0].levels[4].runs[0];
  ASSERT_EQ(record.cases[0].subjects[0].shown_run(), &finest);
  ASSERT_EQ(finest.metrics.size(), measure::metrics().size());
  const auto found =
      std::ranges::find(finest.metrics, "u-max-relative", &record::MetricResult::name);
  EXPECT_EQ(found->value, finest.score.u_error);
}

TEST(Verify, MeasuresMetricsOfTheFinestLevelThatCanBeStored) {
  auto request = small_metrics({"rk4"});
  request.plan = {4e-5, 2, 1};  // 200 000 and 400 000 steps
  const auto method = verify(request).cases[0].subjects[0];
  EXPECT_FALSE(method.levels[0].runs[0].metrics.empty());
  EXPECT_TRUE(method.levels[1].runs[0].metrics.empty());
  request.plan = {2e-5, 1, 1};
  EXPECT_EQ(verify(request).cases[0].subjects[0].shown_run(), nullptr);
}

TEST(Verify, SplitsTheErrorOfALinearContactSpringAlone) {
  const auto record = verify(small_metrics({"newmark+penalty", "newmark+penalty:law=hertz"}));
  const auto split = [&](std::size_t i) {
    const auto& metrics = record.cases[0].subjects[i].shown_run()->metrics;
    return *std::ranges::find(metrics, "u-penalty-model-max-relative", &record::MetricResult::name);
  };
  EXPECT_GT(split(0).value, 0.0);
  EXPECT_EQ(split(1).reason, "No contact spring of the run is known.");
}

TEST(Verify, MeasuresNoMetricsOfARunThatFailed) {
  auto request = small_metrics({"central-difference"});
  request.plan = {4.0, 1, 1};  // twice its stability limit
  request.settings = {{"t_end", 4000.0}};
  const auto run = verify(request).cases[0].subjects[0].levels[0].runs[0];
  ASSERT_FALSE(run.score.finished);
  EXPECT_TRUE(run.metrics.empty());
}

TEST(Verify, ComparesSelfConvergenceWithTheReference) {
  auto request = small_metrics({"rk4", "newmark+penalty"});
  request.plan = {0.005, 6, 2};  // the contact is resolved from the first level on
  request.settings = {{"t_end", 6.0}};
  const auto record = verify(request);
  const auto& rk4 = *record.cases[0].subjects[0].self_convergence;
  EXPECT_EQ(rk4.order, 4.0);
  EXPECT_FALSE(rk4.against_reference.false_convergence);
  // A penalty spring claims a floor and no order: its integrator's is expected.
  const auto& penalty = *record.cases[0].subjects[1].self_convergence;
  EXPECT_EQ(record.cases[0].subjects[1].claim.order, 0.0);
  EXPECT_EQ(penalty.order, 2.0);
  EXPECT_TRUE(penalty.against_reference.false_convergence);
  EXPECT_EQ(penalty.against_reference.reason, "wrong-limit");
}

TEST(Verify, HoldsDifferencesToTheClaimThroughImpactsBeforeTheSmoothOrder) {
  const auto record = verify(small_metrics({"newmark+reversal"}));  // order 2 in smooth motion
  EXPECT_EQ(record.cases[0].subjects[0].self_convergence->order, 1.0);
}

TEST(Verify, ComparesTheEndsOfRunsWithTheTrueEnd) {
  const auto record = verify(small_metrics({"newmark"}));
  const auto& method = record.cases[0].subjects[0];
  ASSERT_TRUE(method.self_convergence.has_value());
  const auto& errors = method.self_convergence->errors;
  ASSERT_EQ(errors.errors.size(), 5u);
  for (std::size_t l = 0; l < 5; ++l) {
    // The error at the end is one of those whose maximum u_error is.
    EXPECT_GT(errors.errors[l], 0.0);
    EXPECT_LE(errors.errors[l], std::max(method.levels[l].runs[0].score.u_error,
                                         method.levels[l].runs[1].score.u_error));
  }
  EXPECT_NEAR(errors.order, 2.0, 0.2);
}

TEST(Verify, ProfilesItsMethodsOverTheErrorsTheyReach) {
  const auto record = verify(small_metrics({"rk4", "newmark"}));
  ASSERT_FALSE(record.cases[0].profiles.empty());
  EXPECT_EQ(record.cases[0].profiles[0].counter, "steps");
  EXPECT_EQ(record.cases[0].profiles[0].tasks[0], "stop: error in u <= 1e-01");
  ASSERT_EQ(record.cases[0].profiles[0].methods.size(), 2u);
  EXPECT_EQ(record.cases[0].profiles[0].methods[0].failed, 0)
      << "of higher order, it reaches what is reached";
  EXPECT_GT(record.cases[0].profiles[0].methods[1].failed, 0);
}

}  // namespace
}  // namespace clackers::study
