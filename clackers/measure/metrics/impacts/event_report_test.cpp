#include "clackers/measure/metrics/definitions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/base/constants.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;
const ToyMotion report_reference(12.0);  // impacts at pi/2, 3pi/2, 5pi/2, 7pi/2
const auto report_problem = toy_problem(12.0);

model::Trajectory history(std::vector<model::Impact> reports) {
  std::vector<double> times;
  for (int i = 0; i <= 150; ++i) times.push_back(0.08 * i);
  auto rows = history_of(report_reference, times);
  rows.impacts = std::move(reports);
  return rows;
}

const auto spoilt = history({{pi / 2 + 0.05, 0, {}, {-1.1, 0.5}, {0.9, -0.6}, 2.3},
                             {3.0, 0, {}, {}, {}, nan},
                             {3 * pi / 2 - 0.02, 0, {}, {}, {0.8, -0.5}, nan},
                             {7 * pi / 2 + 0.1, 0, {}, {-1.0, 0.7}, {}, 1.9}});

TEST(EventReport, StandsImpactBesideImpact) {
  const Comparison comparison(spoilt, report_reference, report_problem);
  const auto report = event_report(comparison);
  EXPECT_EQ(report.source, ImpactSource::reported);
  EXPECT_EQ(report.expected, 4);
  EXPECT_EQ(report.found, 4);
  EXPECT_EQ(report.matched, 3);
  EXPECT_EQ(report.missed, 1);
  EXPECT_EQ(report.extra, 1);
  EXPECT_EQ(report.late, 1);  // by more than the step, 0.08
  ASSERT_EQ(report.impacts.size(), 3u);
  const auto& [first, second, last] =
      std::tie(report.impacts[0], report.impacts[1], report.impacts[2]);
  EXPECT_EQ(first.index, 1);
  EXPECT_EQ(first.found, 0u);
  EXPECT_EQ(first.t, pi / 2 + 0.05);
  EXPECT_NEAR(first.time_error, 0.05, 1e-15);
  EXPECT_NEAR(first.before[0], 0.1, 1e-15);
  EXPECT_NEAR(first.before[1], 0.0, 1e-15);
  EXPECT_NEAR(first.after[0], 0.1, 1e-15);
  EXPECT_NEAR(first.after[1], 0.1, 1e-15);
  EXPECT_NEAR(first.impulse, 0.3, 1e-15);
  EXPECT_FALSE(first.late);
  EXPECT_EQ(second.index, 2);
  EXPECT_EQ(second.found, 2u);
  EXPECT_NEAR(second.time_error, -0.02, 1e-15);
  EXPECT_TRUE(second.before.empty());
  EXPECT_TRUE(std::isnan(second.impulse));
  EXPECT_EQ(last.index, 4);
  EXPECT_TRUE(last.after.empty());
  EXPECT_TRUE(last.late);
}

TEST(EventReport, GivesTheWorstOfWhatIsKnown) {
  const Comparison comparison(spoilt, report_reference, report_problem);
  EXPECT_NEAR(impact_time_error(comparison).value, 0.1, 1e-14);
  const auto before = velocity_before_error(comparison), after = velocity_after_error(comparison);
  EXPECT_NEAR(before.masses[0], 0.1, 1e-15);
  EXPECT_NEAR(before.masses[1], 0.2, 1e-15);
  EXPECT_NEAR(before.value, 0.2, 1e-15);
  EXPECT_NEAR(after.masses[0], 0.2, 1e-15);
  EXPECT_NEAR(after.masses[1], 0.1, 1e-15);
  EXPECT_NEAR(impulse_error(comparison).value, 0.3, 1e-15);
  EXPECT_EQ(missed_impacts(comparison).value, 1.0);
  EXPECT_EQ(extra_impacts(comparison).value, 1.0);
  EXPECT_EQ(late_impacts(comparison).value, 1.0);
}

TEST(EventReport, TheWorstTimeMayBeAnEarlyOne) {
  const auto early = history({{pi / 2 - 0.3, 0, {}, {}, {}, nan}});
  EXPECT_NEAR(impact_time_error({early, report_reference, report_problem}).value, 0.3, 1e-15);
  EXPECT_EQ(late_impacts({early, report_reference, report_problem}).value, 0.0);
}

TEST(EventReport, SaysWhyThereIsNothingToCompare) {
  const auto none = history({}), bare = history({{pi / 2, 0, {}, {}, {}, nan}});
  const Comparison no_match(none, report_reference, report_problem),
      nothing_known(bare, report_reference, report_problem);
  for (const auto measure :
       {impact_time_error, velocity_before_error, velocity_after_error, impulse_error})
    EXPECT_EQ(measure(no_match).reason, "No impact of the history belongs to a true one.");
  EXPECT_EQ(missed_impacts(no_match).value, 4.0);
  EXPECT_EQ(impact_time_error(nothing_known).value, 0.0);
  EXPECT_NE(velocity_before_error(nothing_known).reason.find("before"), std::string::npos);
  EXPECT_NE(velocity_after_error(nothing_known).reason.find("after"), std::string::npos);
  EXPECT_NE(impulse_error(nothing_known).reason.find("impulse"), std::string::npos);
  auto early = history_of(report_reference, {0.0, 0.1, 1.0});
  EXPECT_EQ(impact_time_error({early, report_reference, report_problem}).reason,
            "The reference has no impact by then.");
}

}  // namespace
}  // namespace clackers::measure
