#include "clackers/base/parameter.hpp"

#include <limits>
#include <stdexcept>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

const std::vector<Parameter> two{{"beta", 0.25, "", "0 <= beta <= 1/2", "a weight"},
                                 {"stiffness", std::numeric_limits<double>::quiet_NaN(), "N/m",
                                  "0 < stiffness", "of a spring", "1e4 k1"}};

TEST(Parameter, DefaultIsANumberOrWords) {
  EXPECT_EQ(two[0].default_text(), "0.25");
  EXPECT_EQ(two[1].default_text(), "1e4 k1");
}

TEST(Settings, AreCompletedInTheOrderOfTheParameters) {
  const auto all = complete("newmark", two, {{"stiffness", 5.0}});
  EXPECT_EQ(all, (Settings{{"beta", 0.25}, {"stiffness", 5.0}}));
  EXPECT_EQ(value_of(all, "stiffness"), 5.0);
}

TEST(Settings, OfAnUnknownNameAreRefusedWithAGuess) {
  EXPECT_REFUSED(complete("newmark", two, {{"bta", 1.0}}), "unknown-name",
                 "no parameter of newmark \"bta\"", "Did you mean \"beta\"?",
                 "beta, stiffness (clackers show newmark)");
  EXPECT_REFUSED(complete("rk4", {}, {{"order", 4.0}}), "unknown-name",
                 "All names: clackers show rk4");
}

TEST(Settings, GivenTwiceAreRefused) {
  EXPECT_REFUSED(complete("newmark", two, {{"beta", 0.1}, {"beta", 0.1}}), "bad-syntax",
                 "newmark: beta = 0.1", "set twice");
}

TEST(Settings, WithoutTheNameAskedForAreAnErrorOfTheProgram) {
  EXPECT_THROW(value_of(Settings{{"beta", 1.0}}, "bta"), std::logic_error);
}

}  // namespace
}  // namespace clackers
