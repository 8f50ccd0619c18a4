#include "clackers/input/text/text_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "clackers/base/number.hpp"
#include "clackers/base/testing/test_file.hpp"

namespace clackers::input {
namespace {

using Names = std::vector<std::string>;

struct Rows {
  Names names;
  std::vector<std::vector<double>> rows;
  bool from_comment = false;
};

Rows read(const std::string& bytes, const Names& names = {}, TableKind kind = TableKind::history) {
  const TestFile file(bytes);
  TextTable reader(InputFile(file.path(), nullptr), names, kind);
  Rows table{reader.names(), {}};
  while (reader.next()) {
    table.rows.emplace_back();
    for (std::size_t c = 0; c < reader.names().size(); ++c) {
      Number number;
      reader.read_number(c, number);
      table.rows.back().push_back(number.value);
    }
  }
  table.from_comment = std::ranges::count(reader.notes(), "columns-from-comment", &Note::code) > 0;
  return table;
}

void read_path(const std::string& path, const std::atomic<bool>* interrupt = nullptr) {
  const TextTable table(InputFile(path, interrupt), {}, TableKind::history);
}

const std::vector<std::vector<double>> two_rows{{0.0, 1.0}, {0.5, -2.0}};

TEST(TextTable, TakesEverySeparation) {
  for (const std::string text :
       {"t,u1\n0,1\n0.5,-2\n", "t, u1\n0 , 1\n 0.5,  -2 \n", "t;u1\n0;1\n0.5;-2\n",
        "t\tu1\n0\t1\n0.5\t-2\n", "t u1\n0 1\n0.5 -2\n", "t [s] u1 [m]\n0 1\n1/2 -2\n",
        " t   u1\n  0    1 \n0.5\t -2\n", "t \t u1\n0 \t 1\n0.5   -2\n", "t,u1\n0,1,\n0.5,-2,\n"}) {
    SCOPED_TRACE(text);
    const auto table = read(text);
    EXPECT_EQ(table.names, (Names{"t", "u1"}));
    EXPECT_EQ(table.rows, two_rows);
  }
}

TEST(TextTable, TakesEveryEndOfLineAndAByteOrderMark) {
  for (const std::string text :
       {"t,u1\r\n0,1\r\n0.5,-2\r\n", "t,u1\n0,1\n0.5,-2", "t,u1\r\n0,1\r\n0.5,-2\r",
        "\xEF\xBB\xBFt,u1\n0,1\n0.5,-2\n", "\n\nt,u1\n\n0,1\n   \n0.5,-2\n\n\n"}) {
    SCOPED_TRACE(text);
    const auto table = read(text);
    EXPECT_EQ(table.names, (Names{"t", "u1"}));
    EXPECT_EQ(table.rows, two_rows);
  }
}

TEST(TextTable, LeavesCommentsOut) {
  const auto table =
      read("# made by a program\n% t,u9\nt,u1 # header\n0,1\n# half\n0.5,-2 % end\n");
  EXPECT_EQ(table.names, (Names{"t", "u1"}));
  EXPECT_EQ(table.rows, two_rows);
  EXPECT_FALSE(table.from_comment);
}

TEST(TextTable, ALongFileMayHaveCommentsAnywhere) {
  // More than a block of 2^20 bytes without one.
  for (const auto* first : {"", "# first\n"}) {
    std::string text = std::string(first) + "t,u1\n";
    for (int i = 0; i < 200000; ++i)
      text += std::to_string(100000 + i) + ",0.125" + (i % 99999 == 99998 ? " # note\n" : "\n");
    const auto rows = read(text + "% below\n").rows;
    ASSERT_EQ(rows.size(), 200000u);
    EXPECT_EQ(rows.back(), (std::vector<double>{299999.0, 0.125}));
  }
}

TEST(TextTable, ACommentBelowTheRowsMayStateTheCost) {
  const auto cost = [](const std::string& comments) {
    const TestFile file("# steps 7\nt,u1\n0,1\n0.5,-2\n" + comments);
    TextTable table(InputFile(file.path(), nullptr), {}, TableKind::history);
    while (table.next()) continue;
    return table.cost();
  };
  EXPECT_EQ(cost("# seconds 1.5e-3 steps 20 evaluations 80\n").seconds, 1.5e-3);
  EXPECT_EQ(cost("# seconds 1.5e-3 steps 20 evaluations 80\n").steps, 20.0);
  EXPECT_EQ(cost("# done\n# evaluations 80\n").evaluations, 80.0);
  // Other comments state nothing, and the first rows have none above them.
  for (const auto* text : {"", "# seconds -1\n", "# seconds nan\n", "# steps 1e99\n",
                           "# 20 steps\n", "# seconds 1 by us\n"})
    EXPECT_EQ(cost(text).seconds + cost(text).steps, 0.0) << text;
}

TEST(TextTable, NamesAreWithoutCaseQuotesAndUnits) {
  EXPECT_EQ(read("\"T [s]\",U1 (m),V1-\n0,1,2\n").names, (Names{"t", "u1", "v1-"}));
}

TEST(TextTable, NamesMayStandInTheCommentAboveTheRows) {
  const auto table = read("# run 7\n# t u1\n0 1\n0.5 -2\n");
  EXPECT_EQ(table.names, (Names{"t", "u1"}));
  EXPECT_TRUE(table.from_comment);
  // Two words that are no names, and names of another number, do not.
  EXPECT_REFUSED(read("# run 7\n0 1\n"), "no-column", "--columns");
  EXPECT_REFUSED(read("# t u1 v1\n0 1\n"), "no-column", "2 columns");
}

TEST(TextTable, GivenNamesReplaceAHeaderAndStandForNone) {
  EXPECT_EQ(read("time,x\n0,1\n0.5,-2\n", {"t", "U1"}).names, (Names{"t", "u1"}));
  EXPECT_EQ(read("0 1\n0.5 -2\n", {"t", "_"}).rows, two_rows);
  EXPECT_REFUSED(read("0 1 7\n0.5 -2 7\n", {"t", "u1"}), "ragged-row", "3 fields; allowed: 2");
}

TEST(TextTable, AListOfImpactsMayBeTimesAloneOrAHeaderAlone) {
  EXPECT_EQ(read("0.5\n1.5\n", {}, TableKind::events).names, Names{"t"});
  EXPECT_EQ(read("t,impulse\n", {}, TableKind::events).names, (Names{"t", "impulse"}));
  EXPECT_TRUE(read("t,impulse\n", {}, TableKind::events).rows.empty());
  EXPECT_REFUSED(read("", {}, TableKind::events), "too-short", "is empty");
  EXPECT_REFUSED(read("0.5\n1.5\n"), "no-column", "have no names");
}

TEST(TextTable, RefusesFilesWithoutRows) {
  EXPECT_REFUSED(read(""), "too-short", "is empty");
  EXPECT_REFUSED(read("\n# nothing\n"), "too-short", "is empty");
  EXPECT_REFUSED(read("t,u1\n"), "too-short", "has a header and no rows");
}

TEST(TextTable, RefusesRaggedRowsWithTheirLine) {
  EXPECT_REFUSED(read("t u1\n0 1\n0.5\n"), "ragged-row", "line 3 has 1 fields; allowed: 2");
  EXPECT_REFUSED(read("t,u1\n# c\n0,1\n0.5,-2,7\n"), "ragged-row", "line 4 has 3 fields");
}

TEST(TextTable, RefusesDecimalCommasWithAHint) {
  EXPECT_REFUSED(read("t;u1\n0;1\n0,5;-2\n"), "decimal-comma", "line 3: t = \"0,5\"");
  EXPECT_REFUSED(read("t\tu1\n0,0\t1\n"), "decimal-comma", "decimal point");
  EXPECT_REFUSED(read("t,u1\n0,5,-2,0\n"), "ragged-row", "Are the commas decimal?");
  EXPECT_REFUSED(read("0,05 1,0\n", {"t", "u1", "v1"}), "decimal-comma", "\"05 1\"");
  EXPECT_REFUSED(read("0,05 1,0\n"), "no-column", "Are the commas decimal?");
}

TEST(TextTable, RefusesWhatIsNoFiniteNumberWithItsLine) {
  EXPECT_REFUSED(read("t,u1\n0,1\n0.5,nan\n"), "not-finite", "line 3: u1 = \"nan\"");
  EXPECT_REFUSED(read("t,u1\n0,-inf\n"), "not-finite", "line 2");
  EXPECT_REFUSED(read("t,u1\n0,1\n0.5,x\n"), "not-a-number", "line 3: u1 = \"x\"");
  EXPECT_REFUSED(read("t,u1\n0,\n0.5,1\n"), "ragged-row", "line 2");
  EXPECT_REFUSED(read("t,u1,v1\n0,,1\n"), "not-a-number", "u1 = \"\"");
}

TEST(TextTable, RefusesWhatIsNoText) {
  EXPECT_REFUSED(read(std::string("t,u1\n0,1\n0.5\0,2\n", 17)), "not-text", "byte 0");
  EXPECT_REFUSED(read("\xFF\xFEt,u1\n"), "not-text", "UTF-16");
  EXPECT_REFUSED(read(std::string("\xFF\xFE\0\0t\0\0\0", 8)), "not-text", "UTF-32");
  EXPECT_REFUSED(read("\x1F\x8B\b"), "not-text", "compressed with gzip");
  EXPECT_REFUSED(read("PK\x03\x04"), "not-text", "spreadsheet");
  EXPECT_REFUSED(read("t,u1\n" + std::string((1 << 24) + 1, '1')), "not-text", "line 2 is longer");
}

TEST(TextTable, CutLastRowIsRefusedWithThatReason) {
  EXPECT_REFUSED(read("t,u1\n0,1\n0.5"), "ragged-row", "may have been cut");
}

TEST(TextTable, LineEndsOfAllSystemsGiveTheSameRows) {
  for (const std::string end : {"\n", "\r\n", "\r", "\r\r\n"}) {
    const auto table = read(
        "\xEF\xBB\xBF"
        "t,u1" +
        end + "0,1" + end + "# note" + end + "0.5,-2" + end);
    ASSERT_EQ(table.rows.size(), 2u) << ::testing::PrintToString(end);
    EXPECT_EQ(table.rows[1], (std::vector<double>{0.5, -2.0}));
  }
}

TEST(TextTable, RowsOfTwentyThousandColumnsAreRead) {
  constexpr std::size_t columns = 20'000;
  std::string header = "t", row = "0";
  for (std::size_t i = 1; i < columns; ++i) {
    header += ",u" + std::to_string(i);
    row += ",0.123456789012345";
  }
  const auto table = read(header + "\n" + row + "\n" + row + "\n");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[1].size(), columns);
  EXPECT_EQ(table.rows[1].back(), 0.123456789012345);
}

TEST(TextTable, RefusesWhatCannotBeRead) {
  EXPECT_REFUSED(read_path("/nowhere/at/all"), "cannot-read", "No such file");
  EXPECT_REFUSED(read_path("/"), "cannot-read", "directory");
}

TEST(TextTable, ReadsRowsAcrossItsBlocks) {
  std::string text = "t,u1\n";
  constexpr int rows = 150'000;  // three blocks and more
  for (int i = 0; i < rows; ++i) text += std::to_string(i) + ",0.123456789012\n";
  const auto table = read(text);
  ASSERT_EQ(table.rows.size(), std::size_t(rows));
  for (int i = 0; i < rows; ++i) {
    ASSERT_EQ(table.rows[std::size_t(i)][0], double(i));
    ASSERT_EQ(table.rows[std::size_t(i)][1], 0.123456789012);
  }
}

TEST(TextTable, StopsWhenInterrupted) {
  const TestFile file("t,u1\n0,1\n");
  const std::atomic<bool> interrupt{true};
  EXPECT_REFUSED(read_path(file.path(), &interrupt), "interrupted", "");
}

}  // namespace
}  // namespace clackers::input
