#include "clackers/report/writers.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "clackers/base/constants.hpp"
#include "clackers/base/files/json.hpp"
#include "clackers/base/testing/refusal.hpp"
#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

using record::Sheet;

Sheet mixed_sheet() {
  return {"clackers/things/1",
          "Things",
          {{"name", "", "what"}, {"value", "m/s", "how much"}, {"n", "", ""}, {"side", "", ""}},
          {{"plain", 0.1, 7LL, "-"},
           {"with, comma", -1e-300, -9007199254740993LL, {}},
           {"with \"quotes\"", infinity, 0LL, "+"},
           {"two\nlines <&>", -infinity, 0LL, ""},
           {"naïve ±", std::nan(""), {}, {}}}};
}

std::string csv(const Sheet& sheet) {
  record::SheetRows rows(sheet);
  std::ostringstream out;
  write(rows, Format::csv, out);
  return out.str();
}

std::string json(const Sheet& sheet) {
  record::SheetRows rows(sheet);
  std::ostringstream out;
  write(rows, Format::json, out);
  return out.str();
}

std::string table(const Sheet& sheet, const Style& style = {}) {
  record::SheetRows rows(sheet);
  std::ostringstream out;
  write(rows, Format::table, out, style);
  return out.str();
}

std::vector<std::string> row_lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

// Reads csv as RFC 4180 says.
std::vector<std::vector<std::string>> parsed_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows{{""}};
  bool inside = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inside && c == '"' && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      inside = !inside;
    } else if (!inside && c == ',') {
      rows.back().emplace_back();
    } else if (!inside && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

TEST(Csv, StartsWithTheNamesAndQuotesOnlyWhatMustBe) {
  const auto text = csv(mixed_sheet());
  EXPECT_EQ(text.substr(0, text.find('\n')), "name,value,n,side");
  EXPECT_NE(text.find("\nplain,0.1,7,-\n"), std::string::npos);
  EXPECT_NE(text.find("\"with, comma\",-1e-300,-9007199254740993,\n"), std::string::npos);
  EXPECT_NE(text.find("\"with \"\"quotes\"\"\",inf,0,+\n"), std::string::npos);
}

TEST(Csv, ReadsBackAsItWas) {
  const auto sheet = mixed_sheet();
  const auto rows = parsed_csv(csv(sheet));
  ASSERT_EQ(rows.size(), sheet.rows.size() + 1);
  for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
    ASSERT_EQ(rows[r + 1].size(), 4u);
    EXPECT_EQ(rows[r + 1][0], std::get<std::string>(sheet.rows[r][0]));
  }
}

Sheet random_doubles(std::mt19937_64& bits) {
  Sheet sheet{"clackers/random/1", "", {{"x", "", ""}}, {}};
  while (sheet.rows.size() < 2000) {
    const auto value = std::bit_cast<double>(bits());
    if (std::isfinite(value)) sheet.rows.push_back({value});
  }
  return sheet;
}

TEST(Csv, NumbersReadBackToTheSameDouble) {
  std::mt19937_64 bits(7);
  const auto sheet = random_doubles(bits);
  const auto rows = parsed_csv(csv(sheet));
  for (std::size_t r = 0; r < sheet.rows.size(); ++r)
    EXPECT_EQ(std::strtod(rows[r + 1][0].c_str(), nullptr), std::get<double>(sheet.rows[r][0]));
}

TEST(Json, NumbersReadBackToTheSameDouble) {
  std::mt19937_64 bits(8);
  const auto sheet = random_doubles(bits);
  const auto read = parse_json(json(sheet));
  for (std::size_t r = 0; r < sheet.rows.size(); ++r)
    EXPECT_EQ(read["rows"][r][0].get<double>(), std::get<double>(sheet.rows[r][0]));
}

TEST(Json, WritesTheShortestOfTheTextsThatReadBack) {
  const Sheet sheet{"x/1", "", {{"x", "", ""}}, {{0.1}}};
  EXPECT_NE(json(sheet).find("[0.1]"), std::string::npos);
}

TEST(Json, HoldsSchemaColumnsAndRows) {
  const auto read = parse_json(json(mixed_sheet()));
  EXPECT_EQ(read["schema"], "clackers/things/1");
  EXPECT_EQ(read["title"], "Things");
  EXPECT_EQ(read["columns"][1],
            (nlohmann::ordered_json{{"name", "value"}, {"unit", "m/s"}, {"meaning", "how much"}}));
  ASSERT_EQ(read["rows"].size(), 5u);
  EXPECT_EQ(read["rows"][1],
            nlohmann::ordered_json::array({"with, comma", -1e-300, -9007199254740993LL, nullptr}));
  EXPECT_EQ(read["rows"][2][1], "inf");
  EXPECT_EQ(read["rows"][3][1], "-inf");
  EXPECT_EQ(read["rows"][4][1], "nan");
  EXPECT_EQ(read["rows"][3][0], "two\nlines <&>");
}

TEST(Json, SeveralSheetsAreOneObject) {
  const std::vector<Sheet> sheets{mixed_sheet(), {"clackers/empty/1", "", {{"x", "m", ""}}, {}}};
  std::ostringstream out;
  write(sheets, "clackers/show/1", Format::json, out);
  const auto read = parse_json(out.str());
  EXPECT_EQ(read["schema"], "clackers/show/1");
  ASSERT_EQ(read["sheets"].size(), 2u);
  EXPECT_EQ(read["sheets"][1]["schema"], "clackers/empty/1");
  EXPECT_TRUE(read["sheets"][1]["rows"].empty());
}

TEST(Sheets, StandBelowEachOtherInTextWithAnEmptyLineBetween) {
  const Sheet sheet{"x/1", "", {{"x", "", ""}}, {{1LL}}};
  std::ostringstream out;
  write(std::vector<Sheet>{sheet, sheet}, "y/1", Format::csv, out);
  EXPECT_EQ(out.str(), "x\n1\n\nx\n1\n");
}

TEST(Table, PutsNumbersToTheRightAndUnitsBelowNames) {
  const Sheet sheet{"x/1",
                    "Motion",
                    {{"t", "s", ""}, {"side", "", ""}, {"u1", "m", ""}},
                    {{0.5, {}, -0.25}, {10.25, "-", 1e-12}}};
  EXPECT_EQ(table(sheet),
            "Motion\n"
            "    t           u1\n"
            "  [s]  side    [m]\n"
            "──────────────────\n"
            "  0.5        -0.25\n"
            "10.25  -     1e-12\n");
}

Sheet wide_sheet(int columns) {
  Sheet sheet{"x/1", "", {}, {}};
  for (int c = 0; c < columns; ++c) sheet.columns.push_back({"energy_before", "J", ""});
  for (int r = 0; r < 20; ++r) {
    sheet.rows.emplace_back();
    for (int c = 0; c < columns; ++c) sheet.rows.back().push_back(-M_PI * std::pow(10.0, c - r));
  }
  return sheet;
}

TEST(Table, IsNeverWiderThanAskedAndNeverEndsALineWithSpace) {
  auto wordy = mixed_sheet();
  wordy.rows.push_back({std::string(500, 'x') + " " + std::string(500, 'y'), 1.0, 1LL, "z"});
  for (const int width : {40, 80, 132})
    for (const auto& sheet :
         {wide_sheet(1), wide_sheet(6), wide_sheet(9), wide_sheet(12), wide_sheet(40), wordy})
      for (const auto& line : row_lines(table(sheet, {.color = false, .width = width}))) {
        EXPECT_LE(display_width(line), std::size_t(width)) << line;
        EXPECT_FALSE(line.ends_with(' ')) << line;
      }
}

TEST(Table, FewColumnsKeepSixDigitsAndManyGiveUpSome) {
  EXPECT_NE(table(wide_sheet(2)).find("-3.14159\n"), std::string::npos);
  EXPECT_NE(table(wide_sheet(7)).find("-3.142e-10"), std::string::npos);
}

TEST(Table, WrapsLongTextInItsColumn) {
  const Sheet sheet{
      "x/1",
      "",
      {{"name", "", ""}, {"meaning", "", ""}},
      {{"m1", "the mass that stands to the left of the other one and is heavier than it is"}}};
  const auto out = row_lines(table(sheet, {.color = false, .width = 40}));
  ASSERT_EQ(out.size(), 5u);
  EXPECT_EQ(out[2], "m1    the mass that stands to the left");
  EXPECT_EQ(out[3], "      of the other one and is heavier");
}

TEST(Table, TakesTheWidthFromTheWidestColumn) {
  const Sheet sheet{
      "x/1",
      "",
      {{"name", "", ""}, {"meaning", "", ""}},
      {{"generalized-alpha", "a sentence that is much longer than the name before it"}}};
  EXPECT_EQ(row_lines(table(sheet, {.color = false, .width = 40}))[2],
            "generalized-alpha  a sentence that is");
}

TEST(Table, PutsAColumnOfNumbersAndTextToTheLeft) {
  const Sheet sheet{"x/1", "", {{"value", "", ""}, {"n", "", ""}}, {{2.0, 1LL}, {"proper", 2LL}}};
  EXPECT_EQ(row_lines(table(sheet))[2], "2       1");
}

TEST(Table, ATextAloneStandsAsItIs) {
  const Sheet card{"x/1", "newmark", {{"card", "", ""}}, {{"Order       2\n    u1 = u0 + h v0\n"}}};
  EXPECT_EQ(table(card), "newmark\nOrder       2\n    u1 = u0 + h v0\n");
}

TEST(Table, ATextAloneIsBrokenAnewToTheWidth) {
  const Sheet card{"x/1", "", {{"card", "", ""}}, {{"So short\na line.\n\n    u = 1\nwhere u\n"}}};
  EXPECT_EQ(table(card), "So short a line.\n\n    u = 1\nwhere u\n");
}

TEST(Table, LaterRowsKeepTheWidthsOfTheFirst) {
  // 2000 rows are more than are measured before the first is printed.
  Sheet sheet{"x/1", "", {{"t", "s", ""}, {"u", "m", ""}}, {}};
  for (int i = 0; i < 2000; ++i)
    sheet.rows.push_back({0.5 * i, i < 1000 ? 0.25 : -1.23456789e-300});
  const auto out = row_lines(table(sheet));
  ASSERT_EQ(out.size(), 2003u);
  EXPECT_EQ(out[3], "       0      0.25");
  EXPECT_EQ(out.back(), "   999.5   -1e-300");
}

TEST(Table, ColoursOnlyWhenAsked) {
  EXPECT_EQ(table(mixed_sheet()).find('\x1b'), std::string::npos);
  EXPECT_NE(table(mixed_sheet(), {.color = true}).find('\x1b'), std::string::npos);
}

/// Rows without end.
class Endless : public record::RowSource {
 public:
  std::string schema() const override { return "x/1"; }
  std::string title() const override { return {}; }
  const std::vector<record::Column>& columns() const override { return columns_; }
  bool next(std::vector<record::Cell>& row) override {
    row = {static_cast<long long>(++asked)};
    return asked < 1000000;
  }
  int asked = 0;

 private:
  std::vector<record::Column> columns_{{"k", "", ""}};
};

TEST(Rows, WritingStopsWhenTheStreamHasFailed) {
  for (const auto format : {Format::table, Format::csv, Format::json}) {
    Endless rows;
    std::ostringstream out;
    out.setstate(std::ios::badbit);
    write(rows, format, out);
    EXPECT_LE(rows.asked, 1001);
  }
}

/// Rows of numbers in blocks of two.
class Numbers : public record::NumberRows {
 public:
  explicit Numbers(std::vector<double> values) : values_(std::move(values)) {}
  std::string schema() const override { return "x/1"; }
  std::string title() const override { return {}; }
  const std::vector<record::Column>& columns() const override { return columns_; }
  long long count() const override { return static_cast<long long>(values_.size() / 3); }
  bool next_block(std::vector<double>& values) override {
    const auto end = std::min(read_ + 6, values_.size());
    values.assign(values_.begin() + std::ptrdiff_t(read_), values_.begin() + std::ptrdiff_t(end));
    read_ = end;
    return !values.empty();
  }

 private:
  std::vector<double> values_;
  std::size_t read_ = 0;
  std::vector<record::Column> columns_{{"k", "", "", record::ColumnKind::whole},
                                       {"side", "", "", record::ColumnKind::side},
                                       {"u", "m", "", record::ColumnKind::real}};
};

std::string written(record::RowSource& rows, Format format) {
  std::ostringstream out;
  write(rows, format, out);
  return out.str();
}

const std::vector<double> few{1, -1, 0.1, 2, 1, -0.0, 3, 0, -infinity, 1e18, 0, 5e-324};

TEST(NumberRows, AreWrittenAsTheirCellsAre) {
  for (const auto format : {Format::csv, Format::json, Format::table}) {
    Numbers blocks(few), cells(few);
    Sheet sheet{"x/1", "", cells.columns(), {}};
    for (std::vector<record::Cell> row; cells.next(row);) sheet.rows.push_back(row);
    EXPECT_EQ(sheet.rows.size(), 4u);
    record::SheetRows rows(sheet);
    EXPECT_EQ(written(blocks, format), written(rows, format));
  }
}

TEST(NumberRows, HaveNoNegativeZero) {
  Numbers rows(few);
  EXPECT_EQ(written(rows, Format::csv),
            "k,side,u\n1,-,0.1\n2,+,0\n3,,-inf\n1000000000000000000,,5e-324\n");
}

TEST(NumberRows, ReadBackToTheSameDouble) {
  std::mt19937_64 bits(9);
  std::vector<double> values;
  while (values.size() < 3000) {
    const auto value = std::bit_cast<double>(bits());
    if (std::isfinite(value)) values.insert(values.end(), {0, 0, value});
  }
  Numbers rows(values);
  const auto read = parsed_csv(written(rows, Format::csv));
  for (std::size_t r = 0; r < values.size() / 3; ++r)
    EXPECT_EQ(std::strtod(read[r + 1][2].c_str(), nullptr), values[3 * r + 2]);
}

TEST(Npy, HasAPaddedHeaderAndTheDoubles) {
  Numbers rows(few);
  const auto text = written(rows, Format::npy);
  EXPECT_EQ(text.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const auto size = std::size_t(static_cast<unsigned char>(text[8])) +
                    256 * std::size_t(static_cast<unsigned char>(text[9])) + 10;
  EXPECT_EQ(size % 64, 0u);
  const auto header = text.substr(10, size - 10);
  EXPECT_EQ(header.substr(0, header.find_last_not_of(" \n") + 1),
            "{'descr': [('k', '<f8'), ('side', '<f8'), ('u', '<f8'), ], 'fortran_order': False, "
            "'shape': (4,), }");
  EXPECT_EQ(header.back(), '\n');
  ASSERT_EQ(text.size(), size + few.size() * sizeof(double));
  EXPECT_EQ(std::memcmp(text.data() + size, few.data(), few.size() * sizeof(double)), 0);
}

class Wide : public Numbers {
 public:
  Wide() : Numbers({}) {}
  const std::vector<record::Column>& columns() const override { return columns_; }

 private:
  std::vector<record::Column> columns_{10000, {"u", "m", "", record::ColumnKind::real}};
};

TEST(Npy, OfManyColumnsHasALongerLength) {
  Wide rows;
  const auto header = written(rows, Format::npy);
  EXPECT_EQ(header[6], '\x02');
  EXPECT_EQ(header.size() % 64, 0u);
  const auto byte = [&](std::size_t i) {
    return std::size_t(static_cast<unsigned char>(header[i]));
  };
  EXPECT_EQ(byte(8) + 256 * byte(9) + 65536 * byte(10), header.size() - 12);
}

TEST(Npy, IsRefusedForRowsWithText) {
  const auto sheet = mixed_sheet();
  record::SheetRows rows(sheet);
  EXPECT_REFUSED(written(rows, Format::npy), "bad-syntax", "hold text", "Use csv or json");
}

TEST(Format, KnowsItsNamesAndRefusesOthersWithAGuess) {
  EXPECT_EQ(format_from("table"), Format::table);
  EXPECT_EQ(format_from("csv"), Format::csv);
  EXPECT_EQ(format_from("json"), Format::json);
  EXPECT_EQ(format_from("npy", Content::numbers), Format::npy);
  EXPECT_EQ(format_from("latex", Content::verdicts), Format::latex);
  for (const auto text : {"JSON", "", "xml", "npy", "junit"})
    EXPECT_REFUSED(format_from(text), "unknown-name", "table, csv, json");
  EXPECT_REFUSED(format_from("jsn"), "unknown-name", "Did you mean \"json\"?");
  EXPECT_REFUSED(format_from("npy", Content::verdicts), "unknown-name");
}

}  // namespace
}  // namespace clackers::report
