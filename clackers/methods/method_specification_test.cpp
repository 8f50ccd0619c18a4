#include "clackers/methods/method_specification.hpp"

#include <gtest/gtest.h>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::methods {
namespace {

TEST(MethodSpecification, TakesNamesAndParametersApart) {
  const auto plain = parse_specification("rk4");
  EXPECT_EQ(plain.first.name, "rk4");
  EXPECT_TRUE(plain.first.settings.empty());
  EXPECT_FALSE(plain.contact);

  const auto full = parse_specification("newmark:beta=0.25,gamma=.5+penalty:stiffness=1e+6");
  EXPECT_EQ(full.first.settings, (Settings{{"beta", 0.25}, {"gamma", 0.5}}));
  ASSERT_TRUE(full.contact);
  EXPECT_EQ(full.contact->name, "penalty");
  EXPECT_EQ(full.contact->settings, (Settings{{"stiffness", 1e6}}));
}

TEST(MethodSpecification, SeparatesAtAPlusOnlyBeforeALetter) {
  const auto specification = parse_specification("generalized-alpha:rho=1e+0+event-driven");
  EXPECT_EQ(specification.first.settings, (Settings{{"rho", 1.0}}));
  EXPECT_EQ(specification.contact->name, "event-driven");
}

TEST(MethodSpecification, RefusesWhatIsOutsideTheGrammar) {
  for (const char* text :
       {"", ":a=1", "+rk4", "a+", "a:b", "a:", "a:=1", "a:b=1,", "a+b+c", "a=1", "a b", "a,b"})
    EXPECT_REFUSED(parse_specification(text), "bad-syntax", "allowed: name:parameter=value");
}

TEST(MethodSpecification, TakesWordsAsValues) {
  const auto specification = parse_specification("newmark+penalty:law=kelvin-voigt,stiffness=1e6");
  EXPECT_EQ(specification.contact->settings,
            (Settings{{"law", "kelvin-voigt"}, {"stiffness", 1e6}}));
  EXPECT_EQ(parse_specification("a:b=x2").first.settings, (Settings{{"b", "x2"}}));
}

TEST(MethodSpecification, WritesWordsThatDifferFromTheDefault) {
  const std::vector<Parameter> law{
      {"law", "linear", "", "", "", {}, {{"linear", ""}, {"hertz", ""}}}};
  EXPECT_EQ(specification("penalty", law, {{"law", "hertz"}}), "penalty:law=hertz");
  EXPECT_EQ(specification("penalty", law, {{"law", "linear"}}), "penalty");
}

TEST(MethodSpecification, RefusesValuesThatAreNeitherAFiniteNumberNorAWord) {
  for (const char* text : {"a:b=", "a:b=1x", "a:b=nan", "a:b=X", "a:b=-x", "a:b=x_y", "a:b=1e999"})
    EXPECT_REFUSED(parse_specification(text), "not-a-number", "b = ");
  for (const char* text : {"a:b=inf", "a:b=-inf"})
    EXPECT_REFUSED(parse_specification(text), "not-finite", "not finite");
}

}  // namespace
}  // namespace clackers::methods
