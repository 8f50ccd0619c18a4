// Compares what each format shows of one sample record with an approved file; scripts/approve
// rewrites the files.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"

namespace clackers::report {
namespace {

const std::string folder = CLACKERS_GOLDEN_FOLDER;

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void expect_approved(const std::string& name, const std::string& text) {
  const auto path = folder + "/" + name;
  if (std::getenv("CLACKERS_APPROVE") != nullptr) {
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  const auto approved = lines_of(content_of(path)), now = lines_of(text);
  for (std::size_t i = 0; i < std::min(approved.size(), now.size()); ++i)
    ASSERT_EQ(now[i], approved[i])
        << name << ", line " << i + 1 << ". If the new text is right: scripts/approve";
  EXPECT_EQ(now.size(), approved.size()) << name << ": number of lines";
}

// The page without the style, the scripts and their hashes, the data and the licences.
std::string skeleton(std::string page) {
  const auto cut = [&](std::string_view open, std::string_view close) {
    for (auto from = page.find(open); from != std::string::npos; from = page.find(open, from)) {
      from += open.size();
      page.replace(from, page.find(close, from) - from, "...");
    }
  };
  cut("<style>", "</style>");
  cut("<script>", "</script>");
  cut("script-src ", ";");
  cut("id=\"data\">", "</script>");
  cut("id=\"specifications\">", "</script>");
  cut("<pre tabindex=\"0\">", "</pre>");
  return page;
}

TEST(Golden, TableIsAsApproved) {
  expect_approved("record.txt", written(sample_of_all(), Format::table));
}

TEST(Golden, CsvIsAsApproved) {
  expect_approved("record.csv", written(sample_of_all(), Format::csv));
}

TEST(Golden, JsonIsAsApproved) {
  expect_approved("record.json", written(sample_of_all(), Format::json));
}

TEST(Golden, JunitIsAsApproved) {
  expect_approved("record.xml", written(sample_of_all(), Format::junit));
}

TEST(Golden, LatexIsAsApproved) {
  expect_approved("record.tex", written(sample_of_all(), Format::latex));
}

TEST(Golden, PageIsAsApproved) { expect_approved("record.html", skeleton(html(sample_of_all()))); }

}  // namespace
}  // namespace clackers::report
