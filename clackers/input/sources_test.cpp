// What every source shares: text, NumPy files and memory give the same history and are refused alike.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

#include "clackers/base/testing/test_file.hpp"
#include "clackers/input/history.hpp"
#include "clackers/input/testing/test_columns.hpp"

namespace clackers::input {
namespace {

void expect_same(const History& found, const History& expected) {
  EXPECT_EQ(found.motion.t, expected.motion.t);
  EXPECT_EQ(found.motion.u, expected.motion.u);
  EXPECT_EQ(found.motion.v, expected.motion.v);
  EXPECT_EQ(found.motion.a, expected.motion.a);
  EXPECT_EQ(found.has_u, expected.has_u);
  EXPECT_EQ(found.has_time, expected.has_time);
  EXPECT_EQ(found.names, expected.names);
  EXPECT_EQ(found.time_half_unit, expected.time_half_unit);
  EXPECT_EQ(found.spacing, expected.spacing);
  ASSERT_EQ(found.columns.size(), expected.columns.size());
  for (std::size_t c = 0; c < found.columns.size(); ++c) {
    SCOPED_TRACE(expected.columns[c].name);
    EXPECT_EQ(found.columns[c].name, expected.columns[c].name);
    EXPECT_EQ(found.columns[c].digits, expected.columns[c].digits);
    EXPECT_EQ(found.columns[c].single, expected.columns[c].single);
    EXPECT_EQ(found.columns[c].half_unit, expected.columns[c].half_unit);
  }
  ASSERT_EQ(found.notes.size(), expected.notes.size());
  for (std::size_t i = 0; i < found.notes.size(); ++i) {
    EXPECT_EQ(found.notes[i].code, expected.notes[i].code);
    EXPECT_EQ(found.notes[i].text, expected.notes[i].text);
  }
}

// Whole doubles, six printed digits, single precision, and a column of no use.
Data example(std::size_t rows) {
  Data data{{"energy", "u2", "T [s]", "u1", "v1", "v2", "a1"}, {}};
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 0.01 * double(i);
    data.rows.push_back(
        {7.0, 0.9 * std::sin(t), t, std::cos(t), double(float(std::sin(t))), -std::sin(t), 0.0});
  }
  for (auto& row : data.rows) row[1] = std::stod(fmt::format("{:.6f}", row[1]));
  return data;
}

TEST(Sources, GiveTheSameHistory) {
  for (const std::size_t rows : {3u, 5000u}) {
    const auto data = example(rows);
    const TestFile text(text_of(data)), structured(structured_of(data)), plain(plain_of(data));
    HistoryOptions options{.dof = 2};
    const auto expected = read_history(text.path(), options);
    EXPECT_EQ(expected.motion.t.size(), rows);
    EXPECT_EQ(expected.motion.u.size(), 2 * rows);
    expect_same(read_history(structured.path(), options), expected);
    const auto memory = memory_of(data), reversed = memory_of(data, true);
    expect_same(read_history(memory.columns, options), expected);
    expect_same(read_history(reversed.columns, options), expected);
    for (const auto& name : data.names) options.columns.push_back(name);
    expect_same(read_history(plain.path(), options), expected);
  }
}

TEST(Sources, KeepSixDigitsAndSinglePrecisionKnown) {
  const auto memory = memory_of(example(3000));
  const auto history = read_history(memory.columns, {.dof = 2});
  ASSERT_EQ(history.columns.size(), 5u);
  EXPECT_EQ(history.columns[0].digits, 17);  // t
  EXPECT_EQ(history.columns[1].digits, 17);  // u1
  EXPECT_EQ(history.columns[2].name, "v1");
  EXPECT_TRUE(history.columns[2].single);
  EXPECT_EQ(history.columns[3].name, "u2");
  EXPECT_EQ(history.columns[3].digits, 6);
  EXPECT_DOUBLE_EQ(history.columns[3].half_unit, 0.5e-6);
}

TEST(Sources, OfSinglePrecisionAreKnownAsSuch) {
  std::vector<float> numbers;
  for (int i = 0; i < 100; ++i)
    numbers.insert(numbers.end(), {0.01f * float(i), std::cos(0.01f * float(i))});
  const TestFile file(npy("[('t', '<f4'), ('u', '<f4')]", "(100,)", bytes_of(numbers)));
  const auto history = read_history(file.path(), {});
  EXPECT_TRUE(history.columns[0].single && history.columns[1].single);
  EXPECT_EQ(history.columns[1].half_unit, std::ldexp(1.0, -24));
  EXPECT_EQ(history.motion.u[50], double(numbers[101]));
}

TEST(Sources, HoldNoMoreThanTheirNumbers) {
  const auto data = example(5000);
  const auto memory = memory_of(data);
  const TestFile file(structured_of(data));
  for (const auto& history :
       {read_history(memory.columns, {.dof = 2}), read_history(file.path(), {.dof = 2})}) {
    EXPECT_EQ(history.motion.t.capacity(), 5000u);
    EXPECT_EQ(history.motion.u.capacity(), 10'000u);
    EXPECT_EQ(history.motion.v.capacity(), 10'000u);
  }
}

TEST(Sources, WithoutTimesHaveThemFromTheStep) {
  const auto memory = memory_of({{"u"}, {{1.0}, {2.0}, {3.0}}});
  const TestFile file(npy("'<f8'", "(3,)", bytes_of(Numbers{1.0, 2.0, 3.0})));
  const auto times = Numbers{0.0, 0.25, 0.5};
  EXPECT_EQ(read_history(memory.columns, {.step = 0.25}).motion.t, times);
  EXPECT_EQ(read_history(file.path(), {.columns = {"u1"}, .step = 0.25}).motion.t, times);
  EXPECT_REFUSED(read_history(memory.columns, {}), "no-column", "history 1 has no column t");
}

TEST(Sources, OfImpactsAreReadAlike) {
  const Data data{{"k", "t", "u1", "v1-", "v1+", "v2-", "v2+", "impulse"},
                  {{1, 1.5, 0, -1, 1, 3, -3, 2}, {2, 4.7, 0, -2, 2, 6, -6, 4}}};
  const auto memory = memory_of(data);
  const TestFile file(structured_of(data));
  for (const Source& source : std::initializer_list<Source>{memory.columns, file.path()}) {
    const auto events = read_events(source, 2);
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[1].t, 4.7);
    EXPECT_EQ(events[1].impulse, 4.0);
    EXPECT_EQ(events[1].v_before, (Numbers{-2.0, 6.0}));
    EXPECT_TRUE(std::isnan(events[1].u[1]));
  }
  const TestFile times(npy("'<f8'", "(2,)", bytes_of(Numbers{1.5, 4.7}))),
      none(npy("'<f8'", "(0,)", "")), table(plain_of(data)),
      back(npy("'<f8'", "(2,)", bytes_of(Numbers{4.7, 1.5})));
  EXPECT_EQ(read_events(times.path(), 2).size(), 2u);
  EXPECT_TRUE(read_events(none.path(), 2).empty());
  EXPECT_TRUE(read_events(NumberColumns{"events 1", 0, {{"t", nullptr, 1}}}, 2).empty());
  EXPECT_REFUSED(read_events(table.path(), 2), "no-column", "a structured array with a field t");
  EXPECT_REFUSED(read_events(back.path(), 2), "not-sorted", "row 1 (from 0): t = 1.5");
}

TEST(Sources, StopWhenInterrupted) {
  const auto memory = memory_of(example(3));
  const TestFile file(structured_of(example(3)));
  const std::atomic<bool> interrupt = true;
  EXPECT_REFUSED(read_history(memory.columns, {.dof = 2, .interrupt = &interrupt}), "interrupted",
                 "");
  EXPECT_REFUSED(read_history(file.path(), {.dof = 2, .interrupt = &interrupt}), "interrupted", "");
}

TEST(Sources, ReportTheirShareAsTheyAreRead) {
  const auto data = example(70'000);
  const auto memory = memory_of(data);
  const TestFile text(text_of(data)), structured(structured_of(data));
  for (const Source& source :
       std::initializer_list<Source>{memory.columns, text.path(), structured.path()}) {
    Numbers shares;
    read_history(source, {.dof = 2, .progress = [&](double share) { shares.push_back(share); }});
    ASSERT_GE(shares.size(), 2u);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_LT(shares.front(), 0.5);
    EXPECT_LE(shares.back(), 1.0);
    EXPECT_GT(shares.back(), 0.9);
  }
}

TEST(Sources, HaveNames) {
  const Source memory = NumberColumns{"history 1", 0, {}};
  EXPECT_EQ(name_of(memory), "history 1");
  EXPECT_EQ(given_name(memory), "history 1");
  EXPECT_EQ(path_of(memory), "");
  EXPECT_TRUE(is_given(memory));
  const Source input = std::string("-"), none = std::string();
  EXPECT_EQ(name_of(input), "standard input");
  EXPECT_EQ(given_name(input), "-");
  EXPECT_EQ(path_of(input), "-");
  EXPECT_TRUE(is_given(input));
  EXPECT_FALSE(is_given(none));
}

}  // namespace
}  // namespace clackers::input
