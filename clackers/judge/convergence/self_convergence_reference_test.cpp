#include <gtest/gtest.h>

#include <cmath>

#include "clackers/judge/convergence/self_convergence.hpp"
#include "clackers/judge/testing/expect_behaviour.hpp"
#include "clackers/judge/testing/synthetic_ladder.hpp"
#include "clackers/judge/testing/synthetic_runs.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using std::pow;
using Values = std::vector<double>;

constexpr SelfContext claims_second{.claimed_order = 2.0};

SelfAgainstReference against(const std::vector<ResponseLevel>& made, double exact,
                             const SelfContext& context = claims_second) {
  return compare(self_convergence(made, context), true_convergence(made, Values{exact}, context));
}

TEST(SelfAgainstReference, ARightModelIsToldTruly) {
  const auto made = runs([](double h) { return Values{midpoint(h)}; }, 7, 1, 0.2);
  const auto reference = true_convergence(made, Values{std::cos(3.0)}, claims_second);
  EXPECT_BEHAVIOUR(reference, Behaviour::proper, "");
  const auto both = compare(self_convergence(made, claims_second), reference);
  EXPECT_FALSE(both.false_convergence);
  EXPECT_EQ(both.reason, "");
  EXPECT_NEAR(both.error_ratio, 1.0, 0.01);
}

TEST(SelfAgainstReference, AModelOnePercentTooStiffConvergesProperlyToAWrongLimit) {
  const auto made = runs([](double h) { return Values{midpoint(h, 1.01)}; }, 8, 1, 0.2);
  const auto self = self_convergence(made, claims_second);
  EXPECT_TRUE(self.proper);
  const auto both = compare(self, true_convergence(made, Values{std::cos(3.0)}, claims_second));
  EXPECT_TRUE(both.false_convergence);
  EXPECT_EQ(both.reason, "wrong-limit");
  // cos(3 sqrt(1.01)) - cos 3 = -0.0020.
}

TEST(SelfAgainstReference, AnErrorThatHidesFromTheDifferencesIsFound) {
  // A part that falls like h^0.02 changes by 1.4 % a level: its differences stay below the others.
  const auto made = runs([](double h) { return Values{h * h + 2e-6 * pow(h, 0.02)}; }, 6, 1, 0.1);
  const auto self = self_convergence(made, claims_second);
  EXPECT_TRUE(self.proper);
  const auto both = compare(self, true_convergence(made, Values{-5e-5}, claims_second));
  EXPECT_TRUE(both.false_convergence);
  EXPECT_GT(both.error_ratio, 2.0);
}

TEST(SelfAgainstReference, RunsThatAllAgreeOnAWrongValueWouldHaveLied) {
  const auto both = against(runs([](double) { return Values{1.0}; }, 8), 1.1);
  EXPECT_TRUE(both.false_convergence);
  EXPECT_EQ(both.reason, "wrong-limit");
  EXPECT_FALSE(against(runs([](double) { return Values{1.0}; }, 8), 1.0).false_convergence);
}

TEST(SelfAgainstReference, RunsThatAgreeOnSomethingTheReferenceDecidesNothingOfAreNotBelieved) {
  // The error is as large as the motion: the reference is undecided, the runs are still wrong.
  const auto both = against(runs([](double) { return Values{1.0}; }, 8), 3.0);
  EXPECT_TRUE(both.false_convergence);
  EXPECT_EQ(both.reason, "");
}

TEST(SelfAgainstReference, GrowingErrorsUnderShrinkingDifferencesWouldHaveLied) {
  // U = h^2 around a reference that every refinement leaves further behind.
  auto made = runs([](double h) { return Values{h * h}; }, 8);
  const auto self = self_convergence(made, claims_second);
  LadderFit reference;
  reference.behaviour = Behaviour::divergent;
  EXPECT_TRUE(compare(self, reference).false_convergence);
}

TEST(SelfAgainstReference, DifferencesThatPromiseNothingDoNotLie) {
  Scatter scatter(3.0, 4);
  const auto both = against(runs([&](double) { return Values{scatter()}; }, 8), 0.0);
  EXPECT_FALSE(both.false_convergence);
}

TEST(SelfAgainstReference, ARatioOfTwoIsBelievedAndMoreIsNot) {
  SelfConvergence self;
  self.proper = true;
  self.estimate = 1.0;
  self.differences.behaviour = Behaviour::proper;
  self.differences.has_line = true;
  self.differences.steps = {0.1, 0.05};
  self.differences.last_level = 0;
  LadderFit reference = self.differences;
  for (const double ratio : {1.99, 2.01}) {
    reference.errors = {100.0, ratio};
    EXPECT_EQ(compare(self, reference).false_convergence, ratio > 2.0);
    EXPECT_EQ(compare(self, reference).error_ratio, ratio);
  }
}

TEST(SelfAgainstReference, AReferenceBetterThanTheDifferencesShowIsSaid) {
  // One step a level and only four levels: three differences carry nothing, four errors do.
  const auto both = against(runs([](double h) { return Values{h * h}; }, 4), 0.0);
  EXPECT_FALSE(both.false_convergence);
}

}  // namespace
}  // namespace clackers::judge
