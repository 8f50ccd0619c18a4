#include "clackers/report/counters.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace clackers::report {
namespace {

study::Record with_run(bool finished) {
  study::Record record;
  record.methods.emplace_back().ladder.emplace_back().runs.emplace_back();
  auto& run = record.methods[0].ladder[0].runs[0];
  run.finished = finished;
  run.work.steps = 7;
  run.work.newton_iterations = 3;
  run.seconds = 0.5;
  return record;
}

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
  const std::vector<study::Profile> profiles{{"event_searches", {}, {}}, {"steps", {}, {}}};
  const auto found = counters_of(profiles);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].field, "steps");
  EXPECT_EQ(found[1].field, "event_searches");
}

TEST(Counters, ShowForceEvaluationsFirstWhereTheyAreCounted) {
  EXPECT_EQ(first_shown({{"steps", ""}, {"force_evaluations", ""}}).field, "force_evaluations");
  EXPECT_EQ(first_shown({{"steps", ""}, {"seconds", ""}}).field, "steps");
  EXPECT_THROW(first_shown({}), std::logic_error);
}

TEST(Counters, AreChosenWithButtonsOfWhichOneIsPressed) {
  EXPECT_EQ(counter_choice({{"steps", "steps"}}, "work"), "");
  const auto html = counter_choice({{"steps", "steps"}, {"force_evaluations", "forces"}}, "work");
  EXPECT_NE(html.find("data-counter=\"steps\" data-of=\"work\" aria-pressed=\"false\">steps<"),
            std::string::npos);
  EXPECT_NE(html.find("data-counter=\"force_evaluations\" data-of=\"work\" "
                      "aria-pressed=\"true\">forces<"),
            std::string::npos);
}

}  // namespace
}  // namespace clackers::report
