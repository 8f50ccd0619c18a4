// NumPy files and memory are refused by the rules of text, each with its own place.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "clackers/base/testing/test_file.hpp"
#include "clackers/input/history.hpp"
#include "clackers/input/testing/test_columns.hpp"

namespace clackers::input {
namespace {

// The same refusal of a file and of memory, each with its own place.
void expect_refused(const Data& data, const std::string& code, const std::string& place,
                    const std::string& words) {
  const auto memory = memory_of(data);
  const TestFile structured(structured_of(data));
  EXPECT_REFUSED(read_history(memory.columns, {}), code, "history 1" + place);
  EXPECT_REFUSED(read_history(memory.columns, {}), code, words);
  EXPECT_REFUSED(read_history(structured.path(), {}), code, structured.path() + place);
  EXPECT_REFUSED(read_history(structured.path(), {}), code, words);
}

TEST(SourcesRefused, RefuseByTheRulesOfText) {
  expect_refused({{"t", "u1"}, {{0, 1}, {2, 1}, {1, 1}}}, "not-sorted", " row 2 (from 0): t = 1",
                 "at least 2 s");
  expect_refused({{"t", "u1"}, {{0, 1}, {1, 1}, {1, 1}, {1, 1}}}, "not-sorted",
                 " row 3 (from 0): t = 1", "at most two rows");
  expect_refused({{"t", "u1"}, {{0, 1}, {1, nan}, {2, 1}}}, "not-finite",
                 " row 1 (from 0): u1 = nan", "a finite number");
  expect_refused({{"t", "u1"}, {{0, 1}, {-INFINITY, 1}, {2, 1}}}, "not-finite",
                 " row 1 (from 0): t = -inf", "a finite number");
  expect_refused({{"t", "u1"}, {{1, 1}, {1, 2}}}, "too-short", "", "two different times");
  expect_refused({{"t", "u1"}, {}}, "too-short", "", "has no rows");
  expect_refused({{"t", "x"}, {{0, 1}, {1, 1}}}, "no-column", "", "no column u1");
  expect_refused({{"t", "u1", "U"}, {{0, 1, 1}, {1, 1, 1}}}, "no-column", "", "");
  expect_refused({{"t", "u1", "U1"}, {{0, 1, 1}, {1, 1, 1}}}, "no-column", "", "u1 appears twice");
}

TEST(SourcesRefused, EndAtTheFirstNumberThatIsNotFiniteWhereAskedTo) {
  const Data data{{"t", "u1", "v1"}, {{0, 1, 2}, {1, 3, 4}, {2, nan, 6}, {3, 7, 8}}};
  const auto memory = memory_of(data);
  const TestFile file(structured_of(data));
  for (const Source& source : std::initializer_list<Source>{memory.columns, file.path()}) {
    const auto history = read_history(source, {.until_not_finite = true});
    EXPECT_EQ(history.motion.t, (Numbers{0.0, 1.0}));
    EXPECT_EQ(history.motion.v, (Numbers{2.0, 4.0}));
    EXPECT_NE(history.not_finite.find("row 2 (from 0): u1 = nan"), std::string::npos);
  }
}

TEST(SourcesRefused, TakeTheSidesOfAJumpAsNumbers) {
  const Data data{{"t", "side", "u1"}, {{0, 0, 1}, {1, -1, 0}, {1, 1, 0}, {2, 0, 1}}};
  const auto memory = memory_of(data);
  EXPECT_EQ(read_history(memory.columns, {}).motion.t, (Numbers{0.0, 1.0, 1.0, 2.0}));
  expect_refused({{"t", "side", "u1"}, {{0, 0, 1}, {1, 1, 0}, {1, -1, 0}}}, "not-sorted",
                 " row 2 (from 0): side = -", "before the jump");
  expect_refused({{"t", "side", "u1"}, {{0, 0, 1}, {1, 1, 0}, {1, 0, 0}}}, "not-sorted",
                 " row 2 (from 0): side = nothing", "before the jump");
  expect_refused({{"t", "side", "u1"}, {{0, 0, 1}, {1, 2, 0}, {1, 0, 0}}}, "out-of-range",
                 " row 1 (from 0): side = 2", "-1 (before the jump)");
  expect_refused({{"t", "side", "u1"}, {{0, nan, 1}, {1, 2, 0}, {1, 0, 0}}}, "not-a-number",
                 " row 0 (from 0): side = nan", "-1 (before the jump)");
}

TEST(SourcesRefused, OfPlainArraysNeedNames) {
  const Data data{{"t", "u1"}, {{0, 1}, {1, 2}, {2, 3}}};
  const TestFile plain(plain_of(data));
  EXPECT_REFUSED(read_history(plain.path(), {}), "no-column", "2 columns of numbers have no names");
  EXPECT_REFUSED(read_history(plain.path(), {}), "no-column", "--columns t,u1,v1");
  EXPECT_REFUSED(read_history(plain.path(), {.columns = {"t"}}), "ragged-row",
                 "has 2 columns; allowed: 1, one for each name.");
  EXPECT_REFUSED(read_history(plain.path(), {.columns = {"t", "u1", "v1"}}), "ragged-row",
                 "save the transposed array");
  EXPECT_EQ(read_history(plain.path(), {.columns = {"_", "U1"}, .step = 1.0}).motion.u,
            (Numbers{1.0, 2.0, 3.0}));
}

TEST(SourcesRefused, LeaveColumnsWithoutNumbersOut) {
  const auto row = bytes_of(Numbers{0.0}) + "abcd" + bytes_of(Numbers{1.0}),
             next = bytes_of(Numbers{1.0}) + "abcd" + bytes_of(Numbers{2.0});
  const TestFile file(npy("[('t', '<f8'), ('label', '|S4'), ('u', '<f8')]", "(2,)", row + next));
  const auto history = read_history(file.path(), {});
  EXPECT_EQ(history.motion.u, (Numbers{1.0, 2.0}));
  ASSERT_EQ(history.notes.size(), 1u);
  EXPECT_EQ(history.notes[0].text, "label");
  EXPECT_REFUSED(read_history(file.path(), {.columns = {"t", "u", "_"}}), "not-a-number",
                 "column u holds no real numbers; allowed: floating-point");
  auto memory = memory_of({{"t", "u"}, {{0.0, 1.0}, {1.0, 2.0}}});
  memory.columns.columns[1].first = nullptr;
  EXPECT_REFUSED(read_history(memory.columns, {}), "not-a-number", "history 1: column u");
}

}  // namespace
}  // namespace clackers::input
