#include "clackers/measure/errors/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "clackers/base/constants.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;

TEST(Comparison, AsksForBothLimitsWhereATimeStandsTwice) {
  const ToyMotion reference(5.0);
  const auto problem = toy_problem(5.0);
  const auto history = history_of(reference, {0.0, 1.0, pi / 2, pi / 2, 2.0, 2.0, 3 * pi / 2, 5.0});
  const Comparison comparison(history, reference, problem);
  for (std::size_t i = 0; i < history.u.size(); ++i) {
    EXPECT_EQ(comparison.reference_u()[i], history.u[i]) << i;
    EXPECT_EQ(comparison.reference_v()[i], history.v[i]) << i;
    EXPECT_EQ(comparison.reference_a()[i], history.a[i]) << i;
  }
  EXPECT_EQ(comparison.reference_v()[2 * 2], -1.0);
  EXPECT_EQ(comparison.reference_v()[2 * 3], 1.0);
  EXPECT_EQ(comparison.reference_v()[2 * 6], 1.0);  // alone at an impact: after it
  for (std::size_t row = 0; row < 8; ++row) {
    EXPECT_EQ(comparison.is_left_limit(row), row == 2 || row == 4) << row;
    EXPECT_EQ(comparison.is_right_limit(row), row == 3 || row == 5) << row;
  }
  EXPECT_EQ(comparison.u_envelope()[1], 0.5);
}

TEST(Comparison, AsksForEachTimeOnceAndInBlocks) {
  const ToyMotion reference(5.0);
  const auto problem = toy_problem(5.0);
  std::vector<double> times;
  for (int i = 0; i <= 20000; ++i) times.push_back(5.0 * i / 20000.0);
  auto history = history_of(reference, times);
  history.a.clear();
  reference.samples = 0;
  const Comparison comparison(history, reference, problem);
  EXPECT_TRUE(comparison.reference_a().empty());
  EXPECT_LE(reference.samples, 20);  // 5 blocks, and the limits of impacts
  EXPECT_NEAR(comparison.step(), 5.0 / 20000.0, 1e-12);
}

TEST(Comparison, TakesARoundingBeyondTheEndForTheEnd) {
  const ToyMotion reference(5.0);
  const auto problem = toy_problem(5.0);
  auto history = history_of(reference, {0.0, 5.0});
  history.t.back() = 5.0 * (1.0 + 0x1p-51);
  EXPECT_EQ(Comparison(history, reference, problem).reference_u()[2], history.u[2]);
}

// Impacts of the reference at pi/2, 3pi/2 and 5pi/2; rows 0.05 apart.
model::Trajectory with_reports(const ToyMotion& reference, std::vector<model::Impact> reports) {
  std::vector<double> times;
  for (int i = 0; i <= 180; ++i) times.push_back(0.05 * i);
  auto history = history_of(reference, times);
  history.a.clear();
  history.impacts = std::move(reports);
  return history;
}

TEST(Comparison, MatchesReportsInOrderOfTimeWithTheTrueImpacts) {
  const ToyMotion reference(9.0);
  const auto problem = toy_problem(9.0);
  const auto history = with_reports(
      reference, {{7.9, 0, {}, {}, {}, 1.0}, {1.5, 0, {}, {}, {}, 2.0}, {3.0, 0, {}, {}, {}, nan}});
  const Comparison comparison(history, reference, problem);
  EXPECT_EQ(comparison.impact_source(), ImpactSource::reported);
  ASSERT_EQ(comparison.impacts().size(), 3u);
  EXPECT_EQ(comparison.impacts()[0].t, 1.5);
  EXPECT_EQ(comparison.impacts()[2].impulse, 1.0);
  ASSERT_EQ(comparison.matches().size(), 2u);
  EXPECT_EQ(comparison.matches()[0].found, 0u);
  EXPECT_EQ(comparison.matches()[0].reference.index, 1);
  EXPECT_EQ(comparison.matches()[1].found, 2u);
  EXPECT_EQ(comparison.matches()[1].reference.index, 3);
  EXPECT_EQ(comparison.expected(), 3);
  EXPECT_EQ(comparison.impact_score().missed, 1);
  EXPECT_EQ(comparison.impact_score().extra, 1);
}

TEST(Comparison, JoinsReportsOfAdjacentSteps) {
  const ToyMotion reference(9.0);
  const auto problem = toy_problem(9.0);
  const auto history =
      with_reports(reference, {{1.55, 0, {0.1, 0.0}, {-1.0, 0.5}, {-0.2, 0.1}, 0.8},
                               {1.60, 0, {0.0, 0.0}, {-0.2, 0.1}, {0.9, -0.4}, 1.1},
                               {1.75, 0, {}, {}, {}, nan}});
  const Comparison comparison(history, reference, problem);
  ASSERT_EQ(comparison.impacts().size(), 2u);
  const auto& joined = comparison.impacts().front();
  EXPECT_EQ(joined.t, 1.55);
  EXPECT_EQ(joined.v_before, (std::vector<double>{-1.0, 0.5}));
  EXPECT_EQ(joined.v_after, (std::vector<double>{0.9, -0.4}));
  EXPECT_NEAR(joined.impulse, 1.9, 1e-15);
  EXPECT_EQ(comparison.impact_ends()[0], 1.60);
  EXPECT_EQ(comparison.impact_ends()[1], 1.75);
  EXPECT_EQ(comparison.matches().size(), 1u);
}

TEST(Comparison, JoinsReportsOfAContactAmongThoseOfOthers) {
  const ToyMotion reference(9.0);
  auto problem = toy_problem(9.0);
  problem.contacts.push_back({Eigen::Vector2d(1.0, 0.0), 0.0, 1.0});
  const auto history = with_reports(reference, {{1.55, 0, {}, {}, {}, 1.0},
                                                {1.55, 1, {}, {}, {}, 2.0},
                                                {1.60, 1, {}, {}, {}, 3.0},
                                                {1.60, 0, {}, {}, {}, 4.0}});
  const Comparison comparison(history, reference, problem);
  ASSERT_EQ(comparison.impacts().size(), 2u);
  for (const int contact : {0, 1}) {
    EXPECT_EQ(comparison.impacts()[std::size_t(contact)].contact, contact);
    EXPECT_EQ(comparison.impacts()[std::size_t(contact)].impulse, 5.0);
    EXPECT_EQ(comparison.impact_ends()[std::size_t(contact)], 1.60);
  }
}

TEST(Comparison, TheImpactPeriodIsBetweenInstantsNotBetweenContacts) {
  const auto period = [](std::vector<double> impacts) {
    const ToyMotion reference(20.0, std::move(impacts));
    const auto problem = toy_problem();
    const auto history = history_of(reference, {0.0, 1.0, 2.0});
    return Comparison(history, reference, problem).impact_period();
  };
  EXPECT_EQ(period({2.0, 2.0, 5.0, 9.0}), 3.0);
  EXPECT_EQ(period({2.0, 2.0}), 20.0);
}

// Output every 1.5 s does not show the steps of the method: 4.5 and 4.9 stay two.
TEST(Comparison, DoesNotJoinReportsBecauseRowsAreFew) {
  const ToyMotion reference(20.0);
  const auto problem = toy_problem();
  auto history = history_of(reference, {0.0, 1.5, 3.0, 4.5, 6.0, 7.5, 9.0});
  history.impacts = {{1.6, 0, {}, {}, {}, nan},
                     {4.4, 0, {}, {}, {}, nan},
                     {4.9, 0, {}, {}, {}, nan},
                     {7.8, 0, {}, {}, {}, nan}};
  const Comparison comparison(history, reference, problem);
  EXPECT_EQ(comparison.impacts().size(), 4u);
  EXPECT_EQ(comparison.matches().size(), 3u);
}

TEST(Comparison, ForgetsVectorsWithHoles) {
  const ToyMotion reference(9.0);
  const auto problem = toy_problem(9.0);
  const auto history = with_reports(
      reference,
      {{1.55, 0, {0.0, nan}, {-1.0, 0.5}, {nan, nan}, std::numeric_limits<double>::infinity()}});
  const Comparison comparison(history, reference, problem);
  const auto& impact = comparison.impacts().front();
  EXPECT_TRUE(impact.u.empty());
  EXPECT_EQ(impact.v_before.size(), 2u);
  EXPECT_TRUE(impact.v_after.empty());
  EXPECT_TRUE(std::isnan(impact.impulse));
}

TEST(Comparison, FindsWhatIsNotReported) {
  const ToyMotion reference(9.0);
  const auto problem = toy_problem(9.0);
  auto history = with_reports(reference, {});
  EXPECT_EQ(Comparison(history, reference, problem).impacts().size(), 0u);  // reported: none
  history.impacts.reset();
  const Comparison comparison(history, reference, problem);
  EXPECT_EQ(comparison.impact_source(), ImpactSource::found_in_history);
  ASSERT_EQ(comparison.matches().size(), 3u);
  for (const auto& [found, impact] : comparison.matches())
    EXPECT_NEAR(comparison.impacts()[found].t, impact.t, 1e-8);
}

TEST(Comparison, ExpectsNothingBeforeAHistoryThatStartsLate) {
  const ToyMotion reference(9.0);
  const auto problem = toy_problem(9.0);
  auto history = history_of(reference, {2.0, 2.1, 2.2, 3.0, 9.0});
  EXPECT_EQ(Comparison(history, reference, problem).expected(), 2);
  // Though one found just behind its start belongs to the impact before it.
  history.impacts = {{2.05, 0, {}, {}, {}, nan}};
  EXPECT_EQ(Comparison(history, reference, problem).expected(), 3);
  EXPECT_EQ(Comparison(history, reference, problem).matches().size(), 1u);
}

TEST(Comparison, AddsTheLimitsOfReportedJumps) {
  const ToyMotion reference(9.0);
  const auto problem = toy_problem(9.0);
  const auto history =
      with_reports(reference, {{1.58, 0, {0.0, 0.0}, {-1.0, 0.5}, {1.0, -0.5}, 2.0}});
  const Comparison comparison(history, reference, problem);
  EXPECT_EQ(comparison.rows(), 183u);
  EXPECT_TRUE(comparison.is_left_limit(32));
  EXPECT_EQ(comparison.history().t[32], 1.58);
  EXPECT_EQ(comparison.reference_v().size(), 2 * 183u);
}

}  // namespace
}  // namespace clackers::measure
