#include "clackers/base/check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

TEST(Check, ReturnsWhatItAllows) {
  for (const double x : {0.0, -1.0, largest, -largest}) EXPECT_EQ(require_finite("w", "x", x), x);
  for (const double x : {smallest, 1.0, largest}) {
    EXPECT_EQ(require_positive("w", "x", x), x);
    EXPECT_EQ(require_step("w", x), x);
  }
  for (const double x : {-1.0, 0.0, 2.0}) EXPECT_EQ(require_within("w", "x", x, -1.0, 2.0), x);
}

TEST(Check, RefusesNanEverywhere) {
  EXPECT_REFUSED(require_finite("w", "x", NAN), "not-a-number");
  EXPECT_REFUSED(require_positive("w", "x", NAN), "not-a-number");
  EXPECT_REFUSED(require_within("w", "x", NAN, 0.0, 1.0), "not-a-number");
  EXPECT_REFUSED(require_step("w", NAN), "not-a-number");
}

TEST(Check, RefusesInfinityWhereFiniteNumbersAreMeant) {
  for (const double x : {INFINITY, -INFINITY}) {
    EXPECT_REFUSED(require_finite("w", "x", x), "not-finite");
    EXPECT_REFUSED(require_positive("w", "x", x), "not-finite");
    EXPECT_REFUSED(require_step("w", x), "not-finite");
  }
  EXPECT_EQ(require_within("w", "x", INFINITY, 0.0, INFINITY), INFINITY);
}

TEST(Check, RefusesWhatLiesOutside) {
  for (const double x : {0.0, -0.0, -smallest, -1.0}) {
    EXPECT_REFUSED(require_positive("w", "x", x), "out-of-range");
    EXPECT_REFUSED(require_step("w", x), "step-not-positive");
  }
  EXPECT_REFUSED(require_within("w", "x", std::nextafter(2.0, 3.0), -1.0, 2.0), "out-of-range");
  EXPECT_REFUSED(require_within("w", "x", std::nextafter(-1.0, -2.0), -1.0, 2.0), "out-of-range");
}

TEST(Check, SaysWhatIsAllowed) {
  EXPECT_EQ(test::refusal_of([] { require_within("case", "eta", 1.5, 0.0, 1.0); }),
            "case: eta = 1.5; allowed: 0 <= eta <= 1. [out-of-range]");
  EXPECT_EQ(test::refusal_of([] { require_positive("case", "m1", -2.0); }),
            "case: m1 = -2; allowed: 0 < m1 < infinity. [out-of-range]");
  EXPECT_EQ(test::refusal_of([] { require_step("rk4", 0.0); }),
            "rk4: h = 0; allowed: 0 < h < infinity, in seconds. [step-not-positive]");
  EXPECT_EQ(test::refusal_of([] { require_finite("case", "gap", NAN); }),
            "case: gap = nan; allowed: a finite number. [not-a-number]");
}

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

TEST(Suggest, CompletesTheBeginningOfAName) {
  const std::vector<std::string> options{"--step", "--samples-per-level"};
  EXPECT_EQ(nearest("--samples", options), "--samples-per-level");
  EXPECT_EQ(nearest("gen", known), "generalized-alpha");
  EXPECT_EQ(nearest("ge", known), "");
}

TEST(Suggest, ComparesOnlyNamesOfSuchALength) {
  EXPECT_EQ(nearest(std::string(std::size_t(1) << 22, 'n'), known), "");  // else gigabytes
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
