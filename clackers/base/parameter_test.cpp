#include "clackers/base/parameter.hpp"

#include <limits>
#include <stdexcept>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

const std::vector<Parameter> two{{"beta", 0.25, "", "0 <= beta <= 1/2", "a weight"},
                                 {"stiffness", std::numeric_limits<double>::quiet_NaN(), "N/m",
                                  "0 < stiffness", "of a spring", "1e4 k1"}};

const std::vector<Parameter> law{{"law",
                                  "linear",
                                  "",
                                  "law = linear, hertz",
                                  "of the contact",
                                  {},
                                  {{"linear", "a spring"}, {"hertz", "two spheres"}}}};

TEST(ParameterValue, IsANumberOrAWord) {
  EXPECT_FALSE(ParameterValue(2.5).is_word());
  EXPECT_TRUE(ParameterValue("hertz").is_word());
  EXPECT_EQ(double(ParameterValue(2.5)), 2.5);
  EXPECT_EQ(ParameterValue(0.1).text(), "0.1");
  EXPECT_EQ(ParameterValue("hertz").text(), "hertz");
  EXPECT_EQ(ParameterValue("hertz"), ParameterValue("hertz"));
  EXPECT_NE(ParameterValue("hertz"), ParameterValue(0.0));
  EXPECT_THROW(static_cast<void>(double(ParameterValue("hertz"))), std::logic_error);
}

TEST(Parameter, DefaultIsANumberOrWords) {
  EXPECT_EQ(two[0].default_text(), "0.25");
  EXPECT_EQ(two[1].default_text(), "1e4 k1");
  EXPECT_EQ(law[0].default_text(), "linear");
}

TEST(Settings, AreCompletedInTheOrderOfTheParameters) {
  const auto all = complete("newmark", two, {{"stiffness", 5.0}});
  EXPECT_EQ(all, (Settings{{"beta", 0.25}, {"stiffness", 5.0}}));
  EXPECT_EQ(double(value_of(all, "stiffness")), 5.0);
}

TEST(Settings, OfAnUnknownNameAreRefusedWithAGuess) {
  EXPECT_REFUSED(complete("newmark", two, {{"bta", 1.0}}), "unknown-name",
                 "no parameter of newmark \"bta\"", "Did you mean \"beta\"?",
                 "beta, stiffness (clackers show newmark)");
  EXPECT_REFUSED(complete("rk4", {}, {{"order", 4.0}}), "unknown-name",
                 "All names: clackers show rk4");
}

TEST(Settings, OfAParameterWithWordsAreOneOfThem) {
  EXPECT_EQ(complete("penalty", law, {}), (Settings{{"law", "linear"}}));
  EXPECT_EQ(complete("penalty", law, {{"law", "hertz"}}), (Settings{{"law", "hertz"}}));
  EXPECT_REFUSED(complete("penalty", law, {{"law", "herz"}}), "unknown-name",
                 "no law of penalty \"herz\". Did you mean \"hertz\"? All names: linear, hertz");
  EXPECT_REFUSED(complete("penalty", law, {{"law", 3.0}}), "unknown-name",
                 "no law of penalty \"3\"");
}

TEST(Settings, OfAParameterWithoutWordsAreNumbers) {
  EXPECT_REFUSED(complete("newmark", two, {{"beta", "hertz"}}), "not-a-number",
                 "newmark: beta = hertz; allowed: 0 <= beta <= 1/2. A number is needed.");
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
