#include "clackers/methods/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::methods {
namespace {

TEST(Registry, JoinsIntegratorsWithTreatments) {
  EXPECT_EQ(method("newmark")->facts().name, "newmark+event-driven");
  EXPECT_EQ(method("newmark:beta=0.25,gamma=0.5+event-driven")->facts().name,
            "newmark+event-driven");
  EXPECT_EQ(method("generalized-alpha:rho=0.8+penalty:stiffness=1e+6")->facts().name,
            "generalized-alpha:rho=0.8+penalty:stiffness=1000000");
  EXPECT_EQ(method("moreau-jean:theta=0.5")->facts().name, "moreau-jean");
  EXPECT_EQ(method("rk4")->facts().through_impacts.order, 4.0);
  EXPECT_EQ(method("newmark:gamma=0.6,beta=0.3025")->facts().through_impacts.order, 1.0);
  EXPECT_EQ(method("rk4+penalty")->facts().through_impacts.reason, "contact-stiffness");
}

TEST(Registry, UnknownNamesAreRefusedWithAGuess) {
  EXPECT_EQ(
      test::refusal_of([] { method("newmrak"); }),
      "clackers: no method \"newmrak\". Did you mean \"newmark\"? All names: clackers list methods "
      "[unknown-name]");
  EXPECT_REFUSED(method("newmark+penality"), "unknown-name", "Did you mean \"penalty\"?");
  EXPECT_REFUSED(method("newmark:bta=0.25"), "unknown-name",
                 "no parameter of newmark \"bta\". Did you mean \"beta\"?");
  EXPECT_REFUSED(method("rk4:order=4"), "unknown-name", "no parameter of rk4");
  EXPECT_REFUSED(method("event-driven"), "unknown-name", "no method");
}

TEST(Registry, ParametersOutsideTheirRangeAreRefused) {
  EXPECT_REFUSED(method("newmark:gamma=0.4"), "out-of-range", "1/2 <= gamma <= 1");
  EXPECT_REFUSED(method("newmark+penalty:stiffness=0"), "out-of-range", "0 < stiffness");
  EXPECT_REFUSED(method("moreau-jean:theta=0.4"), "out-of-range", "1/2 <= theta <= 1");
  EXPECT_REFUSED(method("generalized-alpha:rho=2"), "out-of-range", "0 <= rho <= 1");
}

TEST(Registry, AParameterGivenTwiceIsRefused) {
  EXPECT_REFUSED(method("newmark:beta=0.1,beta=0.2"), "bad-syntax", "newmark: beta = 0.2", "twice");
}

TEST(Registry, AMethodThatStandsAloneTakesNoTreatment) {
  EXPECT_REFUSED(method("moreau-jean+penalty"), "bad-syntax", "brings its own contact treatment");
}

TEST(Registry, ListsEveryNameWithItsCard) {
  for (const auto& entry : entries()) {
    SCOPED_TRACE(entry.name);
    EXPECT_FALSE(entry.summary.empty());
    std::size_t at = 0;
    for (const char* part : {"Order       ", "Stability   ", "Dissipation ", "Memory      ",
                             "Cost        ", "Source      "}) {
      const auto found = entry.card.find(std::string("\n") + part);
      EXPECT_NE(found, std::string::npos) << part;
      EXPECT_GE(found, at) << part;
      at = found;
    }
    for (const auto& p : entry.parameters) {
      EXPECT_NE(p.default_text(), "nan");
      EXPECT_NE(p.allowed.find(p.name), std::string::npos);
      EXPECT_FALSE(p.meaning.empty());
    }
  }
}

TEST(Registry, CardsAreFoundByName) {
  EXPECT_TRUE(card("newmark").starts_with("Newmark's one-step family for M a"));
  EXPECT_TRUE(card("no-such-method").empty());
}

TEST(Registry, PairsHaveEveryVariantWithTwoIntegratorsOfThePanel) {
  const auto all = pairs();
  int found = 0;
  for (const auto& entry : entries())
    for (const auto& variant : variants(entry))
      for (const auto& integrator : {default_panel()[0], default_panel()[1]})
        found += int(std::ranges::count(all, integrator + '+' + variant.specification));
  EXPECT_EQ(found, 14);  // seven laws besides the default one
  EXPECT_EQ(std::ranges::count(all, "newmark+penalty:law=hertz"), 1);
  EXPECT_EQ(std::ranges::count(all, "newmark+penalty:law=linear"), 0);
  EXPECT_TRUE(method(default_panel()[0])->facts().is_unconditionally_stable());
  EXPECT_FALSE(method(default_panel()[1])->facts().is_unconditionally_stable());
}

TEST(Registry, PairsAndPanelAreMethods) {
  for (const auto& name : pairs()) EXPECT_EQ(method(name)->facts().name, name);
  for (const auto& name : default_panel()) EXPECT_NO_THROW(method(name)) << name;
}

}  // namespace
}  // namespace clackers::methods
