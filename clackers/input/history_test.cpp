#include "clackers/input/history.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/testing/test_file.hpp"

namespace clackers::input {
namespace {

using Numbers = std::vector<double>;

History history(const std::string& bytes, int dof = 2, HistoryOptions options = {}) {
  const TestFile file(bytes);
  options.dof = dof;
  return read_history(file.path(), options);
}

TEST(History, TakesColumnsInAnyOrderAndLeavesOthersOut) {
  const auto h = history("u2,side,energy,v1,t,v2,u1\n2,,9,3,0,4,1\n6,,9,7,0.5,8,5\n");
  EXPECT_EQ(h.motion.t, (Numbers{0.0, 0.5}));
  EXPECT_EQ(h.motion.u, (Numbers{1.0, 2.0, 5.0, 6.0}));
  EXPECT_EQ(h.motion.v, (Numbers{3.0, 4.0, 7.0, 8.0}));
  EXPECT_TRUE(h.motion.a.empty());
  EXPECT_FALSE(h.motion.impacts.has_value());
  ASSERT_EQ(h.notes.size(), 1u);
  EXPECT_EQ(h.notes[0].code, "columns-not-used");
  EXPECT_EQ(h.notes[0].text, "energy");
}

TEST(History, OfOneMassMayLeaveItsNumberOut) {
  const auto h = history("Time u v a\n0 1 2 3\n1 4 5 6\n", 1);
  EXPECT_EQ(h.motion.u, (Numbers{1.0, 4.0}));
  EXPECT_EQ(h.motion.v, (Numbers{2.0, 5.0}));
  EXPECT_EQ(h.motion.a, (Numbers{3.0, 6.0}));
}

TEST(History, KnowsWhichMassesItHas) {
  const auto h = history("t,u2,v2\n0,1,2\n1,3,4\n");
  EXPECT_EQ(h.has_u, (std::vector<bool>{false, true}));
  EXPECT_EQ(h.motion.u, (Numbers{0.0, 1.0, 0.0, 3.0}));
  EXPECT_TRUE(h.motion.v.empty());
  ASSERT_EQ(h.notes.size(), 1u);
  EXPECT_EQ(h.notes[0].code, "velocities-incomplete");
}

TEST(History, EndsAtTheFirstNumberThatIsNotFiniteWhereAskedTo) {
  const std::string bytes = "t,u1,v1\n0,1,2\n1,3,4\n2,nan,6\n3,7,8\n";
  const auto h = history(bytes, 1, {.until_not_finite = true});
  EXPECT_EQ(h.motion.t, (Numbers{0.0, 1.0}));
  EXPECT_EQ(h.motion.u, (Numbers{1.0, 3.0}));
  EXPECT_EQ(h.motion.v, (Numbers{2.0, 4.0}));
  EXPECT_NE(h.not_finite.find("line 4: u1 = \"nan\""), std::string::npos) << h.not_finite;
  EXPECT_REFUSED(history(bytes, 1), "not-finite", "line 4");
  EXPECT_REFUSED(history("t,u1\n0,1\n1,inf\n2,3\n", 1, {.until_not_finite = true}), "not-finite",
                 "line 3");
}

TEST(History, HasTheNotesOfItsTable) {
  const auto h = history("# t u1 x\n0 1 2\n1 3 4", 1);
  ASSERT_EQ(h.notes.size(), 3u);
  EXPECT_EQ(h.notes[0].code, "columns-not-used");
  EXPECT_EQ(h.notes[1].code, "columns-from-comment");
  EXPECT_EQ(h.notes[2].code, "last-line-incomplete");
  EXPECT_EQ(h.notes[2].numbers, Numbers{3.0});
}

TEST(History, KeepsBothLimitsOfAJump) {
  const auto h = history("t,side,u1,v1\n0,,1,0\n1,-,0,-1\n1,+,0,1\n2,,1,0\n", 1);
  EXPECT_EQ(h.motion.t, (Numbers{0.0, 1.0, 1.0, 2.0}));
  EXPECT_EQ(h.motion.v, (Numbers{0.0, -1.0, 1.0, 0.0}));
}

TEST(History, RefusesTimesOutOfOrder) {
  EXPECT_REFUSED(history("t,u1\n0,1\n2,1\n1,1\n", 1), "not-sorted", "line 4: t = 1");
  EXPECT_REFUSED(history("t,u1\n-0,1\n-1,1\n", 1), "not-sorted", "at least 0 s");
  EXPECT_REFUSED(history("t,u1\n0,1\n1,1\n1,1\n1,1\n", 1), "not-sorted", "line 5");
  EXPECT_REFUSED(history("t,side,u1\n0,,1\n1,+,0\n1,-,0\n", 1), "not-sorted", "side");
}

TEST(History, RefusesOneTimeAlone) {
  EXPECT_REFUSED(history("t,u1\n0,1\n", 1), "too-short", "two different times");
  EXPECT_REFUSED(history("t,u1\n1,1\n1,2\n", 1), "too-short", "two different times");
}

TEST(History, RefusesMissingAndDoubleColumns) {
  EXPECT_REFUSED(history("t,x\n0,1\n1,2\n"), "no-column", "no column u1 or u2; its columns: t, x");
  EXPECT_REFUSED(history("u1,v1\n0,1\n1,2\n", 1), "no-column", "no column t");
  EXPECT_REFUSED(history("t,u1,U1\n0,1,1\n1,2,2\n", 1), "no-column", "u1 appears twice");
  EXPECT_REFUSED(history("t,time,u1\n0,0,1\n1,1,2\n", 1), "no-column", "appears twice");
}

TEST(History, WithoutTimesHasThemFromTheStep) {
  const auto h = history("u1\n1\n2\n3\n", 1, {.step = 0.25});
  EXPECT_FALSE(h.has_time);
  EXPECT_EQ(h.motion.t, (Numbers{0.0, 0.25, 0.5}));
  EXPECT_EQ(h.spacing, 0.25);
  EXPECT_THROW(history("u1\n1\n2\n", 1, {.step = -1.0}), InputError);
}

TEST(History, KnowsTheMedianTimeBetweenRows) {
  EXPECT_DOUBLE_EQ(history("t,u1\n0,1\n1,1\n1,1\n1.01,1\n2.01,1\n3.01,1\n", 1).spacing, 1.0);
}

TEST(History, SaysWhatPrintingHides) {
  // As OpenSees prints with six digits.
  const auto h = history("t u1\n0 1\n0.0078125 0.123457\n0.015625 -0.00123457\n", 1);
  ASSERT_EQ(h.columns.size(), 2u);
  EXPECT_EQ(h.columns[0].name, "t");
  EXPECT_EQ(h.columns[1].digits, 6);
  EXPECT_DOUBLE_EQ(h.columns[1].half_unit, 0.5e-5);
  // These times were not rounded: they are equally spaced.
  EXPECT_EQ(h.time_half_unit, 0.0);
}

TEST(History, SaysWhatPrintingHidesOfTimes) {
  // 10 + n/128 s with six digits.
  const auto h = history("t u1\n10.0078 1\n10.0156 1\n10.0234 1\n10.0312 1\n10.0391 1\n", 1);
  EXPECT_DOUBLE_EQ(h.time_half_unit, 0.5e-4);
}

TEST(History, NeverHoldsMoreThanItsNumbers) {
  std::string text = "t,u1,v1\n";
  for (int i = 0; i < 5000; ++i) text += std::to_string(i) + ",1.00000,2.00000\n";
  const auto h = history(text, 1);
  EXPECT_EQ(h.motion.u.size(), 5000u);
  // 2 % beyond the guess, and lines grow by a digit or three.
  EXPECT_LT(h.motion.u.capacity(), 6000u);
}

TEST(Events, AreReadWithWhatIsKnownOfThem) {
  const TestFile file(
      "k,t,u1,v1-,v1+,v2-,v2+,impulse,energy_before\n1,1.5,0,-1,1,3,-3,2,9\n2,4.7,0,-2,2,6,-6,4,"
      "8\n");
  const auto events = read_events(file.path(), 2);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].t, 4.7);
  EXPECT_EQ(events[1].impulse, 4.0);
  EXPECT_EQ(events[1].v_before, (Numbers{-2.0, 6.0}));
  EXPECT_EQ(events[1].v_after, (Numbers{2.0, -6.0}));
  ASSERT_EQ(events[1].u.size(), 2u);
  EXPECT_EQ(events[1].u[0], 0.0);
  EXPECT_TRUE(std::isnan(events[1].u[1]));
}

TEST(Events, NameTheirContactWhereThereAreSeveral) {
  const TestFile file("t,contact\n1.5,2\n1.5,0\n"), nameless("t\n1.5\n"),
      beyond("t,contact\n1.5,3\n"), half("t,contact\n1.5,0.5\n");
  const auto events = read_events(file.path(), 3, 3);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].contact, 2);
  EXPECT_EQ(events[1].contact, 0);
  EXPECT_REFUSED(read_events(nameless.path(), 3, 3), "no-column", "3 contacts");
  for (const auto* wrong : {&beyond, &half})
    EXPECT_REFUSED(read_events(wrong->path(), 3, 3), "out-of-range", "a whole number from 0 to 2");
  // With one contact the column says nothing.
  EXPECT_EQ(read_events(beyond.path(), 2).front().contact, 0);
}

TEST(Events, MayBeTimesAloneOrNone) {
  const TestFile times("# found by the solver\n1.5\n4.7\n"), none("t,impulse\n"),
      back("t\n4.7\n1.5\n"), other("k,u\n1,2\n");
  const auto events = read_events(times.path(), 2);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_TRUE(std::isnan(events[0].impulse));
  EXPECT_TRUE(events[0].u.empty() && events[0].v_before.empty() && events[0].v_after.empty());
  EXPECT_TRUE(read_events(none.path(), 2).empty());
  EXPECT_REFUSED(read_events(back.path(), 2), "not-sorted", "line 3");
  EXPECT_REFUSED(read_events(other.path(), 2), "no-column", "no column t");
}

TEST(JoinedHistory, HasTheRowsOfBothFiles) {
  const TestFile u("0 1 2\n0.5 3 4\n1 5 6\n"), v("0.5,7,8\n0.75,0,0\n1,9,10\n");
  const auto joined = u.path() + "+" + v.path();
  const auto h = read_history(joined, {.dof = 2, .columns = {"t", "u1", "u2+t", "v1", "v2"}});
  EXPECT_EQ(h.motion.t, (std::vector{0.5, 1.0}));
  EXPECT_EQ(h.motion.u, (std::vector{3.0, 4.0, 5.0, 6.0}));
  EXPECT_EQ(h.motion.v, (std::vector{7.0, 8.0, 9.0, 10.0}));
  EXPECT_REFUSED(read_history(joined, {.dof = 2, .columns = {"t", "u1", "u2"}}), "ragged-row",
                 "joined by +");
  EXPECT_REFUSED(read_history(joined, {.dof = 2, .columns = {"t", "u1", "u2+_", "v1", "v2"}}),
                 "no-column", "no t");
}

}  // namespace
}  // namespace clackers::input
