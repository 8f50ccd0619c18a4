#include "clackers/base/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace clackers {
namespace {

std::pair<std::string, std::string> refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return {error.what(), std::string(error.code().name())};
  }
  return {"nothing was refused", ""};
}

using Told = std::pair<std::string, std::string>;

TEST(Refuse, SaysWhoWhatWhatIsAllowedAndWhatToDo) {
  EXPECT_EQ(
      refusal([] { refuse("newmark", "gamma", 0.4, "1/2 <= gamma <= 1", "Use gamma = 0.5."); }),
      (Told{"newmark: gamma = 0.4; allowed: 1/2 <= gamma <= 1. Use gamma = 0.5.", "out-of-range"}));
  EXPECT_EQ(refusal([] { refuse("case", "X", 4.0, "an odd number", {}, "not-odd"); }),
            (Told{"case: X = 4; allowed: an odd number.", "not-odd"}));
  EXPECT_EQ(
      refusal([] { refuse("clackers", "format", "xml", "table, csv, json", {}, "unknown-name"); }),
      (Told{"clackers: format = xml; allowed: table, csv, json.", "unknown-name"}));
}

TEST(Refuse, ShowsEveryDigitOfTheNumberThatWasGiven) {
  EXPECT_EQ(refusal([] { refuse("case", "r", 0.1 + 0.2, "r < 0.3"); }).first,
            "case: r = 0.30000000000000004; allowed: r < 0.3.");
}

TEST(Refuse, NamesNanAndInfinityByTheirOwnCodes) {
  EXPECT_EQ(refusal([] { refuse("case", "r", NAN, "r > 0", {}, "not-odd"); }),
            (Told{"case: r = nan; allowed: r > 0.", "not-a-number"}));
  EXPECT_EQ(refusal([] { refuse("case", "r", -INFINITY, "r > 0"); }),
            (Told{"case: r = -inf; allowed: r > 0.", "not-finite"}));
}

TEST(Error, InputAndFileErrorsAreToldApartAndHaveOneRoot) {
  EXPECT_THROW(throw InputError("x", "not-odd"), Error);
  EXPECT_THROW(throw FileError("x", "cannot-read"), Error);
  try {
    throw FileError("no disk", "cannot-write");
  } catch (const InputError&) {
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "no disk");
    EXPECT_EQ(error.code(), Code("cannot-write"));
  }
}

}  // namespace
}  // namespace clackers
