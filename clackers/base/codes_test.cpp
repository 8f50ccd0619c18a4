#include "clackers/base/codes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <regex>
#include <set>
#include <string>

namespace clackers {
namespace {

TEST(Codes, EveryNameIsKebabCase) {
  const std::regex kebab("[a-z][a-z0-9]*(-[a-z0-9]+)*");
  for (const auto& entry : code_table())
    EXPECT_TRUE(std::regex_match(std::string(entry.name), kebab)) << entry.name;
}

TEST(Codes, EveryNameStandsOnce) {
  std::set<std::string_view> names;
  for (const auto& entry : code_table()) EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
}

TEST(Codes, EveryKindIsOneOfFive) {
  constexpr std::array<std::string_view, 6> kinds{"refusal", "failure",   "behaviour",
                                                  "reason",  "diagnosis", "verdict"};
  for (const auto& entry : code_table())
    EXPECT_NE(std::ranges::find(kinds, entry.kind), kinds.end()) << entry.name;
}

TEST(Codes, EveryMeaningIsASentence) {
  for (const auto& entry : code_table()) {
    ASSERT_FALSE(entry.meaning.empty()) << entry.name;
    EXPECT_TRUE(entry.meaning.front() >= 'A' && entry.meaning.front() <= 'Z') << entry.name;
    EXPECT_EQ(entry.meaning.back(), '.') << entry.name;
    EXPECT_EQ(entry.meaning.find("  "), std::string_view::npos) << entry.name;
  }
}

TEST(Codes, ANameFindsItsRowAndNothingElseDoes) {
  for (const auto& entry : code_table()) EXPECT_EQ(find_code(entry.name), &entry);
  EXPECT_EQ(find_code("no-such-code"), nullptr);
  EXPECT_EQ(find_code(""), nullptr);
}

TEST(Codes, ACodeKnowsItsNameAndMeaning) {
  constexpr Code code = "not-odd";
  static_assert(code.name() == "not-odd");
  EXPECT_EQ(code.meaning(), find_code("not-odd")->meaning);
  EXPECT_EQ(code, Code("not-odd"));
  EXPECT_FALSE(code == Code("out-of-range"));
}

// Exact motions give this code to every event that is not certain.
TEST(Codes, NotAdmissibleNamesClosedFormsAndEvents) {
  const auto meaning = Code("not-admissible").meaning();
  for (const auto* word : {"r*(X)", "graze", "two impacts", "comes to rest", "opens"})
    EXPECT_NE(meaning.find(word), std::string_view::npos) << word;
}

}  // namespace
}  // namespace clackers
