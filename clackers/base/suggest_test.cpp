#include "clackers/base/check.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

const std::vector<std::string> known{"newmark", "central-difference", "rk4", "generalized-alpha"};

TEST(Suggest, FindsANameOneSlipAway) {
  EXPECT_EQ(nearest("newmrak", known), "newmark");   // two letters swapped
  EXPECT_EQ(nearest("newmarkk", known), "newmark");  // one too many
  EXPECT_EQ(nearest("ewmark", known), "newmark");    // one missing
  EXPECT_EQ(nearest("newmork", known), "newmark");   // one replaced
  EXPECT_EQ(nearest("newmark", known), "newmark");
  EXPECT_EQ(nearest("generalised-alpha", known), "generalized-alpha");
}

TEST(Suggest, AllowsAThirdOfTheLengthPlusOne) {
  const std::vector<std::string> six{"abcdef"};
  EXPECT_EQ(nearest("abcxyz", six), "abcdef");  // three of six letters wrong: 6 / 3 + 1
  EXPECT_EQ(nearest("abwxyz", six), "");
  const std::vector<std::string> swaps{"badcfe"};
  EXPECT_EQ(nearest("abcdef", swaps), "badcfe");  // three swaps, not six replacements
}

TEST(Suggest, IsSilentWhereNothingIsNear) {
  EXPECT_EQ(nearest("houbolt-wilson", known), "");
  EXPECT_EQ(nearest("rk4", {}), "");
  const std::vector<std::string> options{"--jobs"};
  EXPECT_EQ(nearest("--nope", options), "");  // the dashes are no letters
  EXPECT_EQ(nearest("--", options), "");
}

TEST(Suggest, TakesTheNearestAndOfEquallyNearTheFirst) {
  const std::vector<std::string> names{"penalty", "penalties", "penalt"};
  EXPECT_EQ(nearest("penalte", names), "penalty");
  EXPECT_EQ(nearest("penal", names), "penalt");
}

TEST(RefuseName, NamesTheNearestAndWhereAllAreListed) {
  EXPECT_EQ(test::refusal_of([] { refuse_name("integrator", "newmrak", known, "clackers list"); }),
            "clackers: no integrator \"newmrak\". Did you mean \"newmark\"? All names: clackers "
            "list [unknown-name]");
  EXPECT_EQ(test::refusal_of([] { refuse_name("integrator", "houbolt", known, "clackers list"); }),
            "clackers: no integrator \"houbolt\". All names: clackers list [unknown-name]");
}

}  // namespace
}  // namespace clackers
