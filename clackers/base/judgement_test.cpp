#include "clackers/base/judgement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "clackers/base/testing/refusal.hpp"

namespace clackers {
namespace {

constexpr Behaviour behaviours[] = {
    Behaviour::exact,      Behaviour::proper,    Behaviour::reduced,  Behaviour::irregular,
    Behaviour::stagnating, Behaviour::divergent, Behaviour::undecided};
constexpr Verdict verdicts[] = {Verdict::agrees, Verdict::disagrees, Verdict::not_claimed,
                                Verdict::undecided};

TEST(Judgement, WordsReadBackToThemselves) {
  for (const auto behaviour : behaviours)
    EXPECT_EQ(behaviour_from(to_string(behaviour)), behaviour);
}

TEST(Judgement, WordsAreThoseOfTheManual) {
  EXPECT_EQ(to_string(Behaviour::exact), "exact");
  EXPECT_EQ(to_string(Behaviour::stagnating), "stagnating");
  EXPECT_EQ(to_string(Behaviour::undecided), "undecided");
  EXPECT_EQ(to_string(Verdict::agrees), "agrees");
  EXPECT_EQ(to_string(Verdict::not_claimed), "not claimed");
}

TEST(Judgement, EveryWordCanBeExplained) {
  for (const auto behaviour : behaviours)
    EXPECT_NE(find_code(to_string(behaviour)), nullptr) << to_string(behaviour);
  for (const auto verdict : verdicts) {
    std::string name(to_string(verdict));
    std::ranges::replace(name, ' ', '-');
    EXPECT_NE(find_code(name), nullptr) << name;
  }
}

TEST(Judgement, RefusesOtherWordsAndNamesTheRightOnes) {
  EXPECT_REFUSED(behaviour_from("propper"), "unknown-name",
                 "clackers: behaviour = propper; allowed: exact, proper, reduced, irregular, "
                 "stagnating, divergent, undecided.");
  EXPECT_THROW(behaviour_from("agrees"), InputError);
  EXPECT_THROW(behaviour_from(""), InputError);
}

TEST(Claim, OfNothingIsTheDefault) { EXPECT_EQ(Claim{}.behaviour, Behaviour::undecided); }

}  // namespace
}  // namespace clackers
