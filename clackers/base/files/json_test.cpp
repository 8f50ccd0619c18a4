#include "clackers/base/files/json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

std::string object_of(int members) {
  std::string text;
  for (int i = 0; i < members; ++i) text += (i > 0 ? ",\"" : "{\"") + std::to_string(i) + "\":0";
  return text + "}";
}

TEST(Json, ObjectsHaveFewMembersButThereMayBeManyObjects) {
  EXPECT_EQ(parse_json(object_of(most_members)).size(), std::size_t(most_members));
  EXPECT_REFUSED(parse_json(object_of(most_members + 1)), "bad-syntax", "more than 1000 members");
  EXPECT_REFUSED(parse_json("{\"a\":[1," + object_of(most_members + 1) + "]}"), "bad-syntax",
                 "members");
  const auto whole = object_of(most_members);
  EXPECT_EQ(parse_json("[" + whole + "," + whole + ",{\"a\":" + whole + ",\"b\":{}}]").size(), 3u);
}

}  // namespace
}  // namespace clackers
