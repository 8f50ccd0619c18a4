#include "clackers/study/check/check_verdict.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace clackers::study {
namespace {

CheckedFile file(double step, double error, double printed = 0.0) {
  CheckedFile made;
  made.file = fmt::format("h{}.csv", step);
  made.rows = std::llround(20.0 / step);
  made.printed_floor = printed;
  made.score.step = step;
  made.score.finished = true;
  made.score.u_error = made.score.v_error = error;
  made.score.rounding_floor = std::max(printed, 2e-16 * double(made.rows));
  made.score.impacts = assess::ImpactScore{6, 6, 6, 0, 0, error, 0.0};
  return made;
}

CheckRecord decided(std::vector<CheckedFile> files, std::optional<Claim> expect = {},
                    std::optional<double> tolerance = {}) {
  CheckRecord record;
  record.files = std::move(files);
  record.expect = expect;
  record.tolerance = tolerance;
  decide(record);
  return record;
}

std::vector<CheckedFile> ladder(double order, double floor = 0.0, double printed = 0.0) {
  std::vector<CheckedFile> files;
  for (int i = 0; i < 7; ++i) {
    const double h = 0.04 * std::exp2(-i);
    files.push_back(file(h, std::pow(h, order) + floor, printed));
  }
  return files;
}

const Claim proper_2{Behaviour::proper, 2.0, {}};

TEST(CheckVerdict, PutsNeighbouringStepsIntoOneLevel) {
  std::vector<CheckedFile> files;
  for (int i = 0; i < 24; ++i) files.push_back(file(0.05 * std::exp2(-i / 8.0), 1e-3));
  const auto levels = levels_of(files);
  ASSERT_EQ(levels.size(), 3u);
  for (const auto& level : levels) EXPECT_EQ(level.runs.size(), 8u);
  EXPECT_DOUBLE_EQ(levels[1].step, 0.025);
  EXPECT_EQ(levels_of(ladder(2.0)).size(), 7u);
  std::vector<CheckedFile> wide;
  for (int i = 0; i < 5; ++i) wide.push_back(file(std::pow(1.5, -i), 1e-3));
  EXPECT_EQ(levels_of(wide).size(), 5u) << "steps of ratio 1.5 are levels";
}

TEST(CheckVerdict, GoesByTheExpectation) {
  EXPECT_EQ(decided(ladder(2.0), proper_2).verdict, Verdict::agrees);
  EXPECT_EQ(decided(ladder(1.0), proper_2).verdict, Verdict::disagrees);
  EXPECT_EQ(decided(ladder(1.0), Claim{Behaviour::reduced, 1.0, {}}).verdict, Verdict::agrees);
  EXPECT_EQ(decided({file(0.01, 1e-4)}, proper_2).verdict, Verdict::undecided);
  EXPECT_EQ(decided(ladder(2.0)).verdict, Verdict::not_claimed);
}

TEST(CheckVerdict, NamesPrintedDigitsThatStopALadder) {
  // Errors of order 2 and of printing, which adds up to its floor.
  const double printed = 5e-5;
  for (const auto& expect : {std::optional<Claim>{}, std::optional<Claim>{proper_2}}) {
    const auto record = decided(ladder(2.0, printed, printed), expect);
    EXPECT_EQ(record.assessment.displacement.behaviour, Behaviour::stagnating);
    EXPECT_EQ(record.reason, "printed-digits");
    EXPECT_EQ(record.verdict, expect ? Verdict::undecided : Verdict::not_claimed);
  }
  EXPECT_EQ(decided(ladder(2.0, printed, printed), Claim{Behaviour::stagnating, 0.0, {}}).verdict,
            Verdict::agrees);
  // The same floor with all digits is not printing's.
  const auto other = decided(ladder(2.0, 5e-3));
  EXPECT_NE(other.reason, "printed-digits");
  // A line that is long enough above the floor stays a line.
  EXPECT_EQ(decided(ladder(2.0, 1e-9, 1e-9), proper_2).verdict, Verdict::agrees);
}

TEST(CheckVerdict, AtThePrintedDigitsThroughoutIsNotExact) {
  const auto record = decided({file(0.01, 4e-6, 5e-6)}, Claim{Behaviour::exact, 0.0, {}});
  EXPECT_EQ(record.verdict, Verdict::undecided);
  EXPECT_EQ(record.reason, "printed-digits");
  EXPECT_EQ(decided({file(0.01, 1e-13)}, Claim{Behaviour::exact, 0.0, {}}).verdict,
            Verdict::agrees);
}

TEST(CheckVerdict, GoesByTheToleranceOfTheFinestUnlessPrintingBlursIt) {
  EXPECT_EQ(decided({file(0.02, 1e-1), file(0.01, 1e-3)}, {}, 2e-3).verdict, Verdict::agrees);
  EXPECT_EQ(decided({file(0.01, 3e-3)}, {}, 2e-3).verdict, Verdict::disagrees);
  EXPECT_EQ(decided({file(0.01, 2e-3)}, {}, 2e-3).verdict, Verdict::undecided)
      << "equal is not told by rounded numbers";
  for (const double error : {1.8e-3, 2.2e-3})
    EXPECT_EQ(decided({file(0.01, error, 5e-4)}, {}, 2e-3).reason, "printed-digits");
  EXPECT_EQ(decided({file(0.01, 1e-3, 5e-4)}, {}, 2e-3).verdict, Verdict::agrees);
}

TEST(CheckVerdict, IsTheWorseOfExpectationAndTolerance) {
  EXPECT_EQ(decided(ladder(2.0), proper_2, 1e-9).verdict, Verdict::disagrees);
  EXPECT_EQ(decided(ladder(1.0), proper_2, 1.0).verdict, Verdict::disagrees);
  EXPECT_EQ(decided({file(0.01, 1e-4)}, proper_2, 1.0).verdict, Verdict::undecided);
  EXPECT_EQ(decided(ladder(2.0), proper_2, 1.0).verdict, Verdict::agrees);
}

TEST(CheckVerdict, OfAnotherMotionDisagreesThoughNothingIsClaimed) {
  auto missed = file(0.01, 0.3);
  missed.score.impacts->missed = 1;
  auto extra = file(0.01, 0.3);
  extra.score.impacts->extra = 1;
  auto away = file(0.01, 0.3);
  away.first = 1.0;
  away.start_error = 0.5;
  for (const auto& one : {missed, extra, away}) {
    EXPECT_EQ(decided({one}).verdict, Verdict::disagrees);
    EXPECT_EQ(decided({one}, {}, 1.0).verdict, Verdict::disagrees);
    EXPECT_EQ(decided({file(0.02, 0.3), one}).verdict, Verdict::disagrees);
    EXPECT_EQ(decided({one, file(0.005, 0.1)}).verdict, Verdict::not_claimed)
        << "the finest history decides";
  }
  missed.rows_resolve_collisions = false;
  EXPECT_EQ(decided({missed}).verdict, Verdict::not_claimed);
  EXPECT_EQ(decided({missed}).reason, "sparse-rows");
  EXPECT_EQ(decided({file(0.01, 0.3)}).verdict, Verdict::not_claimed);
}

TEST(CheckVerdict, KnowsAFloorOfCompliantContacts) {
  auto files = ladder(2.0, 0.1);
  files.back().contact_time = 0.05;
  const auto record = decided(files, Claim{Behaviour::stagnating, 0.0, {}});
  EXPECT_EQ(record.verdict, Verdict::agrees);
  EXPECT_EQ(record.assessment.displacement.reason, "contact-stiffness");
}

}  // namespace
}  // namespace clackers::study
