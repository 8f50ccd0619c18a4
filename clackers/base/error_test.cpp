#include "clackers/base/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <type_traits>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

using test::refusal_of;

TEST(Refuse, SaysWhoWhatWhatIsAllowedAndWhatToDo) {
  EXPECT_EQ(
      refusal_of([] { refuse("newmark", "gamma", 0.4, "1/2 <= gamma <= 1", "Use gamma = 0.5."); }),
      "newmark: gamma = 0.4; allowed: 1/2 <= gamma <= 1. Use gamma = 0.5. [out-of-range]");
  EXPECT_EQ(refusal_of([] { refuse("case", "X", 4.0, "an odd number", {}, "not-odd"); }),
            "case: X = 4; allowed: an odd number. [not-odd]");
  EXPECT_EQ(refusal_of([] {
              refuse("clackers", "format", "xml", "table, csv, json", {}, "unknown-name");
            }),
            "clackers: format = xml; allowed: table, csv, json. [unknown-name]");
}

TEST(Refuse, ShowsEveryDigitOfTheNumberThatWasGiven) {
  EXPECT_EQ(refusal_of([] { refuse("case", "r", 0.1 + 0.2, "r < 0.3"); }),
            "case: r = 0.30000000000000004; allowed: r < 0.3. [out-of-range]");
}

TEST(Refuse, NamesNanAndInfinityByTheirOwnCodes) {
  EXPECT_EQ(refusal_of([] { refuse("case", "r", NAN, "r > 0", {}, "not-odd"); }),
            "case: r = nan; allowed: r > 0. [not-a-number]");
  EXPECT_EQ(refusal_of([] { refuse("case", "r", -INFINITY, "r > 0"); }),
            "case: r = -inf; allowed: r > 0. [not-finite]");
}

TEST(Error, OfInputAndOfFilesHaveOneRoot) {
  EXPECT_THROW(throw InputError("x", "not-odd"), Error);
  EXPECT_REFUSED(throw FileError("no disk", "cannot-write"), "cannot-write", "no disk");
  EXPECT_FALSE((std::is_base_of_v<InputError, FileError>));
  EXPECT_FALSE((std::is_base_of_v<FileError, InputError>));
}

}  // namespace
}  // namespace clackers
