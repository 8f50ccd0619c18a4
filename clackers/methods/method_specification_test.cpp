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

TEST(MethodSpecification, RefusesValuesThatAreNoFiniteNumber) {
  for (const char* text : {"a:b=x", "a:b=", "a:b=1x", "a:b=nan"})
    EXPECT_REFUSED(parse_specification(text), "not-a-number", "b = ");
  for (const char* text : {"a:b=inf", "a:b=-inf"})
    EXPECT_REFUSED(parse_specification(text), "not-finite", "not finite");
}

}  // namespace
}  // namespace clackers::methods
