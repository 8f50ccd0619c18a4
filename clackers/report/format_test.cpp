#include "clackers/report/format.hpp"

#include <gtest/gtest.h>

#include "clackers/base/text.hpp"

namespace clackers::report {
namespace {

TEST(Format, WidthIsCountedInCharactersNotBytes) {
  EXPECT_EQ(display_width("2.00±0.01"), 9u);
  EXPECT_EQ(pad("±", 3, true), "  ±");
  EXPECT_EQ(pad("±", 3, false), "±  ");
  EXPECT_EQ(pad("long", 3, true), "long");
}

}  // namespace
}  // namespace clackers::report
