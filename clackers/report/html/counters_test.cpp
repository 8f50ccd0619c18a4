#include "clackers/report/html/figures.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace clackers::report {
namespace {

record::CaseRecord with_run(bool finished) {
  record::CaseRecord record;
  record.subjects.emplace_back().levels.emplace_back().runs.emplace_back();
  auto& run = record.subjects[0].levels[0].runs[0].score;
  run.finished = finished;
  run.work.steps = 7;
  run.work.newton_iterations = 3;
  run.seconds = 0.5;
  return record;
}

const ShownCounter steps{judge::Counter::steps, "steps", "steps"};
const ShownCounter forces{judge::Counter::force_evaluations, "force_evaluations", "forces"};

TEST(Counters, AreThoseThatSomeFinishedRunHas) {
  const auto found = counters_of(with_run(true));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].field, "steps");
  EXPECT_EQ(found[1].field, "newton_iterations");
  EXPECT_EQ(found[1].title, "Newton iterations");
  EXPECT_EQ(found[2].title, "processor time [s]");
  EXPECT_TRUE(counters_of(with_run(false)).empty());
}

TEST(Counters, OfProfilesStandInTheSameOrder) {
  const std::vector<record::Profile> profiles{{"event_searches", {}, {}}, {"steps", {}, {}}};
  const auto found = counters_of(profiles);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].field, "steps");
  EXPECT_EQ(found[1].field, "event_searches");
}

TEST(Counters, ShowForceEvaluationsFirstWhereTheyAreCounted) {
  EXPECT_EQ(first_shown({steps, forces}).field, "force_evaluations");
  EXPECT_EQ(first_shown({steps, {judge::Counter::seconds, "seconds", ""}}).field, "steps");
  EXPECT_THROW(first_shown({}), std::logic_error);
}

TEST(Counters, AreChosenWithButtonsOfWhichOneIsPressed) {
  EXPECT_EQ(counter_choice({steps}, "work"), "");
  const auto html = counter_choice({steps, forces}, "work");
  EXPECT_NE(html.find("data-counter=\"steps\" data-of=\"work\" aria-pressed=\"false\">steps<"),
            std::string::npos);
  EXPECT_NE(html.find("data-counter=\"force_evaluations\" data-of=\"work\" "
                      "aria-pressed=\"true\">forces<"),
            std::string::npos);
}

}  // namespace
}  // namespace clackers::report
