#include "clackers/methods/registry.hpp"

#include <gtest/gtest.h>

#include "clackers/base/error.hpp"

namespace clackers::methods {
namespace {

std::string message_of(const char* specification) {
  try {
    method(specification);
  } catch (const InputError& error) {
    return std::string(error.what()) + " [" + std::string(error.code().name()) + "]";
  }
  return {};
}

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

TEST(Registry, SuggestsNamesThatAreNear) {
  EXPECT_EQ(
      message_of("newmrak"),
      "clackers: no method \"newmrak\". Did you mean \"newmark\"? All names: clackers list methods "
      "[unknown-name]");
  EXPECT_NE(message_of("newmark+penality").find("Did you mean \"penalty\"?"), std::string::npos);
  EXPECT_NE(message_of("newmark:bta=0.25")
                .find("no parameter of newmark \"bta\". Did you mean \"beta\"?"),
            std::string::npos);
  EXPECT_NE(message_of("rk4:order=4").find("no parameter of rk4"), std::string::npos);
}

TEST(Registry, RefusesParametersOutsideTheirRangeAndFalsePairs) {
  EXPECT_NE(message_of("newmark:gamma=0.4").find("1/2 <= gamma <= 1"), std::string::npos);
  EXPECT_NE(message_of("newmark+penalty:stiffness=0").find("0 < stiffness"), std::string::npos);
  EXPECT_NE(message_of("moreau-jean:theta=0.4").find("1/2 <= theta <= 1"), std::string::npos);
  EXPECT_NE(message_of("generalized-alpha:rho=2").find("0 <= rho <= 1"), std::string::npos);
  EXPECT_NE(message_of("moreau-jean+penalty").find("brings its own contact treatment"),
            std::string::npos);
  EXPECT_NE(message_of("event-driven").find("no method"), std::string::npos);
}

TEST(Registry, ListsEveryNameWithItsCard) {
  std::vector<std::string> names;
  for (const auto& entry : entries()) {
    names.push_back(entry.name);
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
    EXPECT_EQ(entry.card.find("///"), std::string::npos);
    for (const auto& p : entry.parameters) {
      EXPECT_FALSE(p.default_value.empty());
      EXPECT_NE(p.allowed.find(p.name), std::string::npos);
      EXPECT_FALSE(p.meaning.empty());
    }
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"newmark", "central-difference", "rk4", "generalized-alpha",
                                      "event-driven", "reversal", "penalty", "moreau-jean"}));
  EXPECT_EQ(entries()[0].card.substr(0, 26), "Newmark's one-step family ");
  EXPECT_EQ(entries()[0].parameters[0].default_value, "0.25");
  EXPECT_EQ(entries()[6].parameters[0].default_value, "1e4 k1");
}

TEST(Registry, PairsAndPanelAreMethods) {
  EXPECT_EQ(pairs().size(), 13u);
  for (const auto& name : pairs()) EXPECT_EQ(method(name)->facts().name, name);
  EXPECT_EQ(default_panel().size(), 7u);
  for (const auto& name : default_panel()) EXPECT_NO_THROW(method(name)) << name;
}

}  // namespace
}  // namespace clackers::methods
