#include "clackers/measure/impacts/impact_matcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "clackers/base/error.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

// True impacts at 2, 6, 10, 14, 18: a quarter of the spacing is 1.
const std::vector<double> regular{2.0, 6.0, 10.0, 14.0, 18.0};

ImpactScore match(const std::vector<double>& reports, double step = 0.01, double end = 20.0,
                  const std::vector<double>& impacts = regular) {
  const ToyMotion reference(20.0, impacts);
  ImpactMatcher matcher(reference, step);
  for (const double t : reports) matcher.take(t);
  return matcher.score(end, 1e-12);
}

#define EXPECT_SCORE(score, is_expected, is_found, is_matched, is_missed, is_extra) \
  {                                                                                 \
    const auto s = score;                                                           \
    EXPECT_EQ(s.expected, is_expected);                                             \
    EXPECT_EQ(s.found, is_found);                                                   \
    EXPECT_EQ(s.matched, is_matched);                                               \
    EXPECT_EQ(s.missed, is_missed);                                                 \
    EXPECT_EQ(s.extra, is_extra);                                                   \
  }

TEST(ImpactMatcher, TakesAllThatHappen) {
  const auto score = match({2.003, 5.9, 10.0, 14.2, 18.0});
  EXPECT_SCORE(score, 5, 5, 5, 0, 0);
  EXPECT_NEAR(score.worst_time_error, 0.2, 1e-14);
}

// Impacts at 10 - 10/2^k until 10, where the contact stays closed until 15.
struct Chatter : ToyMotion {
  static std::vector<double> impacts() {
    std::vector<double> all;
    for (int k = 1; k <= 40; ++k) all.push_back(10.0 - std::ldexp(10.0, -k));
    all.push_back(17.0);
    return all;
  }
  explicit Chatter(const std::vector<double>& times = impacts()) : ToyMotion(20.0, times) {}
  std::vector<model::ClosedContact> closed_contacts() const override {
    model::ClosedContact closed;
    closed.from = 10.0;
    closed.until = 15.0;
    closed.accumulates = true;
    return {closed};
  }
};

TEST(ImpactMatcher, ExpectsOnlyImpactsThatStepsResolve) {
  const Chatter reference;
  const auto found = [&](const std::vector<double>& reports) {
    ImpactMatcher matcher(reference, 0.005);
    for (const double t : reports) matcher.take(t);
    return matcher.score(20.0, 1e-12);
  };
  // From 9.375 on they follow within 62 and fewer steps, and may be reported early.
  EXPECT_SCORE(found({5.0, 7.5, 8.75, 17.0}), 4, 4, 4, 0, 0);
  EXPECT_SCORE(found({5.0, 7.5, 8.75, 9.375, 9.95, 10.1, 12.0, 14.9, 17.0}), 5, 5, 5, 0, 0);
  EXPECT_SCORE(found({5.0, 8.75, 17.0}), 4, 3, 3, 1, 0);
  EXPECT_SCORE(found({5.0, 7.5, 8.75, 9.1, 9.2, 17.0}), 4, 4, 4, 0, 0);
  // Late by half of what the next one allows, 0.16, that one may be anywhere; late by less, not.
  EXPECT_SCORE(found({5.0, 7.6, 8.95, 9.2, 17.0}), 3, 3, 3, 0, 0);
  EXPECT_SCORE(found({5.0, 7.6, 8.3, 17.0}), 3, 3, 3, 0, 0);
  EXPECT_SCORE(found({5.0, 7.55, 8.95, 17.0}), 4, 4, 3, 1, 1);
  EXPECT_SCORE(found({5.0, 7.5, 8.75, 15.5, 17.0}), 4, 5, 4, 0, 1);
  EXPECT_SCORE(found({5.0, 6.2, 7.5, 8.75, 17.0}), 4, 5, 4, 0, 1);
  EXPECT_SCORE(found({5.0, 7.5, 8.75, 9.0, 17.0}), 4, 5, 4, 0, 1);
  // Half a contact of a compliant law counts as a step.
  ImpactMatcher compliant(reference, 1e-4, 0.0, 1, 0.01);
  for (const double t : {5.0, 7.5, 8.75, 9.375, 9.8, 17.0}) compliant.take(t);
  EXPECT_SCORE(compliant.score(20.0, 1e-12), 5, 5, 5, 0, 0);
}

// The contact closes for a second time at 18, after 17, 17.5, 17.75, ...
TEST(ImpactMatcher, ExpectsImpactsBetweenAccumulations) {
  struct TwoChatters : Chatter {
    static std::vector<double> impacts() {
      auto all = Chatter::impacts();
      for (int k = 1; k <= 20; ++k) all.push_back(18.0 - std::ldexp(1.0, -k));
      return all;
    }
    TwoChatters() : Chatter(impacts()) {}
    std::vector<model::ClosedContact> closed_contacts() const override {
      auto all = Chatter::closed_contacts();
      all.push_back(all.front());
      all.back().from = 18.0;
      all.back().until = 20.0;
      return all;
    }
  };
  const TwoChatters reference;
  const auto found = [&](const std::vector<double>& reports, double step = 0.005) {
    ImpactMatcher matcher(reference, step);
    for (const double t : reports) matcher.take(t);
    return matcher.score(20.0, 1e-12);
  };
  EXPECT_SCORE(found({5.0, 7.5, 8.75, 17.0, 17.5}), 5, 5, 5, 0, 0);
  EXPECT_SCORE(found({5.0, 7.5, 8.75, 17.5}), 5, 4, 4, 1, 0);
  EXPECT_SCORE(found({5.0, 7.5, 8.75, 17.04, 17.6}), 4, 4, 4, 0, 0);
  // What was late before the first one says nothing of the second.
  EXPECT_SCORE(found({5.0, 7.6, 16.0, 17.0, 17.5}), 4, 5, 4, 0, 1);
  // With such steps none of the second is resolved, but what comes soon after the opening is extra.
  EXPECT_SCORE(found({5.0, 7.5, 15.8, 16.6}, 0.02), 2, 3, 2, 0, 1);
}

// Flights that grow shorter are the reason, not those of an orbit before them.
TEST(ImpactMatcher, ExpectsAllImpactsOfEqualFlightsBeforeAnAccumulation) {
  struct OrbitThenChatter : Chatter {
    OrbitThenChatter() : Chatter({1.0, 2.0, 3.0, 4.0, 5.0, 7.5, 8.75, 17.0}) {}
  };
  const OrbitThenChatter reference;
  ImpactMatcher matcher(reference, 0.005);
  for (const double t : {1.0, 2.2, 3.5, 4.0, 5.0, 7.5, 8.75, 17.0}) matcher.take(t);
  EXPECT_SCORE(matcher.score(20.0, 1e-12), 8, 8, 7, 1, 1);
}

TEST(ImpactMatcher, ExpectsMoreRoomAfterManyImpacts) {
  const Chatter reference;
  const auto found = [&](double step, const std::vector<double>& reports) {
    ImpactMatcher matcher(reference, step);
    for (const double t : reports) matcher.take(t);
    return matcher.score(20.0, 1e-12);
  };
  // The fifth comes 71 steps before the sixth, and that 36 before the next: a method that is late by
  // two steps an impact does not resolve it.
  EXPECT_SCORE(found(0.0022, {5.0, 7.5, 8.75, 9.375, 17.0}), 5, 5, 5, 0, 0);
  // Others may be reported early.
  EXPECT_SCORE(found(0.0045, {5.0, 7.5, 8.75, 9.375, 9.6875, 9.815, 17.0}), 6, 6, 6, 0, 0);
}

TEST(ImpactMatcher, CountsAMissedOneWithoutLosingTheOthers) {
  EXPECT_SCORE(match({2.0, 10.1, 14.0, 18.0}), 5, 4, 4, 1, 0);
  EXPECT_SCORE(match({6.0, 10.0, 14.0, 18.0}), 5, 4, 4, 1, 0);
  EXPECT_SCORE(match({2.0, 6.0, 10.0, 14.0}), 5, 4, 4, 1, 0);
  EXPECT_SCORE(match({}), 5, 0, 0, 5, 0);
}

TEST(ImpactMatcher, CountsAnExtraOneWithoutLosingTheOthers) {
  EXPECT_SCORE(match({0.3, 2.0, 6.0, 8.0, 10.0, 14.0, 18.0, 19.6}), 5, 8, 5, 0, 3);
}

TEST(ImpactMatcher, BeyondAQuarterOfTheSpacingIsMissedAndExtra) {
  EXPECT_SCORE(match({2.0, 6.999, 10.0, 14.0, 18.0}), 5, 5, 5, 0, 0);
  EXPECT_SCORE(match({2.0, 7.001, 10.0, 14.0, 18.0}), 5, 5, 4, 1, 1);
  EXPECT_SCORE(match({2.0, 5.001, 10.0, 14.0, 18.0}), 5, 5, 5, 0, 0);
  EXPECT_SCORE(match({2.0, 4.999, 10.0, 14.0, 18.0}), 5, 5, 4, 1, 1);
}

TEST(ImpactMatcher, TheNearerNeighbourSetsTheReach) {
  // Spacings 4 and 1 around 6, so a quarter of 1 on both sides of it; 1 at the first impact.
  const std::vector<double> uneven{2.0, 6.0, 7.0, 14.0};
  EXPECT_SCORE(match({2.9, 6.0, 7.0, 14.0}, 0.01, 20.0, uneven), 4, 4, 4, 0, 0);
  EXPECT_SCORE(match({2.0, 5.7, 7.0, 14.0}, 0.01, 20.0, uneven), 4, 4, 3, 1, 1);
  EXPECT_SCORE(match({2.0, 6.0, 7.3, 14.0}, 0.01, 20.0, uneven), 4, 4, 3, 1, 1);
  EXPECT_SCORE(match({2.0, 6.0, 7.2, 15.7}, 0.01, 20.0, uneven), 4, 4, 4, 0, 0);
  EXPECT_SCORE(match({2.0, 6.0, 7.2, 15.8}, 0.01, 20.0, uneven), 4, 4, 3, 1, 1);
  // One alone reaches a quarter of the run.
  EXPECT_SCORE(match({12.9}, 0.01, 20.0, {8.0}), 1, 1, 1, 0, 0);
  EXPECT_SCORE(match({13.1}, 0.01, 20.0, {8.0}), 1, 1, 0, 1, 1);
}

TEST(ImpactMatcher, ReportsInAdjacentStepsAreOneImpactTimedAtTheFirst) {
  const auto twice = match({2.05, 2.15, 6.0, 6.1, 6.2, 6.3, 10.0, 14.0, 18.0}, 0.1);
  EXPECT_SCORE(twice, 5, 5, 5, 0, 0);
  EXPECT_NEAR(twice.worst_time_error, 0.05, 1e-14);
  // Located within adjacent steps they may lie almost two steps apart.
  EXPECT_SCORE(match({2.01, 2.19, 6.0, 10.0, 14.0, 18.0}, 0.1), 5, 5, 5, 0, 0);
  // Two steps apart it has fired twice.
  EXPECT_SCORE(match({2.0, 2.2, 6.0, 10.0, 14.0, 18.0}, 0.1), 5, 6, 5, 0, 1);
}

TEST(ImpactMatcher, OfSeveralAroundOneTheNearestIsItsMatch) {
  const auto later = match({1.5, 2.1, 6.0, 10.0, 14.0, 18.0});
  EXPECT_SCORE(later, 5, 6, 5, 0, 1);
  EXPECT_NEAR(later.worst_time_error, 0.1, 1e-14);
  const auto earlier = match({1.9, 2.5, 6.0, 10.0, 14.0, 18.0});
  EXPECT_SCORE(earlier, 5, 6, 5, 0, 1);
  EXPECT_NEAR(earlier.worst_time_error, 0.1, 1e-14);
}

TEST(ImpactMatcher, AContactThatLastsIsOneImpact) {
  const ToyMotion reference(20.0, {8.0});
  ImpactMatcher matcher(reference, 0.01);
  for (const double t : {8.02, 8.1, 9.0, 14.0}) matcher.take(t, true);
  const auto score = matcher.score(20.0, 0.0);
  EXPECT_SCORE(score, 1, 1, 1, 0, 0);
  EXPECT_NEAR(score.worst_time_error, 0.02, 1e-14);
  // Without rest the same reports are extra.
  EXPECT_SCORE(match({8.02, 8.1, 9.0, 14.0}, 0.01, 20.0, {8.0}), 1, 4, 1, 0, 3);
}

// An impact at 4; lands without one at 8, opens at 12, lands at 16 by an impact and opens at 18.
struct SoftLanding : ToyMotion {
  SoftLanding() : ToyMotion(20.0, {4.0, 16.0}) {}
  std::vector<model::ClosedContact> closed_contacts() const override {
    model::ClosedContact soft, hard;
    soft.from = 8.0;
    soft.begins = {8.0, 8.0};
    soft.until = 12.0;
    hard.from = 16.0;
    hard.begins = {16.0, 16.0};
    hard.until = 18.0;
    soft.opens = hard.opens = true;
    return {soft, hard};
  }
};

TEST(ImpactMatcher, AroundASoftLandingOrAnOpeningNoReportIsExtra) {
  const SoftLanding reference;
  const auto found = [&](const std::vector<double>& reports) {
    ImpactMatcher matcher(reference, 0.01);
    for (const double t : reports) matcher.take(t);
    return matcher.score(20.0, 1e-12);
  };
  // A quarter of the 4 s before the landing, of the 4 s after the opening, of the 2 s to the end.
  EXPECT_SCORE(found({4.0, 7.1, 8.1, 10.0, 12.9, 16.0, 18.4}), 2, 2, 2, 0, 0);
  EXPECT_SCORE(found({4.0, 6.9, 16.0}), 2, 3, 2, 0, 1);
  EXPECT_SCORE(found({4.0, 13.1, 16.0}), 2, 3, 2, 0, 1);
  EXPECT_SCORE(found({4.0, 16.0, 18.6}), 2, 3, 2, 0, 1);
  EXPECT_NEAR(found({4.0, 13.1, 16.0}).worst_time_error, 0.0, 1e-14);
  // Before an impact there is but its match.
  EXPECT_SCORE(found({4.0, 14.0, 15.9}), 2, 3, 2, 0, 1);
}

TEST(ImpactMatcher, ExpectsOnlyWhatHappensBeforeTheEndOfTheRun) {
  EXPECT_SCORE(match({2.0, 6.0}, 0.01, 9.0), 2, 2, 2, 0, 0);
  EXPECT_SCORE(match({2.0, 6.0}, 0.01, 11.0), 3, 2, 2, 1, 0);
}

TEST(ImpactMatcher, AnImpactInTheLastTwoStepsIsExpectedOnlyIfFound) {
  EXPECT_SCORE(match({2.0, 6.0}, 0.1, 10.15), 2, 2, 2, 0, 0);
  EXPECT_SCORE(match({2.0, 6.0, 10.05}, 0.1, 10.15), 3, 3, 3, 0, 0);
  EXPECT_SCORE(match({2.0, 6.0}, 0.1, 10.25), 3, 2, 2, 1, 0);
  // Found just before the end, truly just after it.
  EXPECT_SCORE(match({2.0, 6.0, 9.9}, 0.1, 9.95), 3, 3, 3, 0, 0);
}

TEST(ImpactMatcher, AskingForTheScoreChangesNothing) {
  const ToyMotion reference(20.0, regular);
  ImpactMatcher matcher(reference, 0.01);
  matcher.take(2.0);
  EXPECT_SCORE(matcher.score(20.0, 0.0), 5, 1, 1, 4, 0);
  for (const double t : {6.0, 10.0, 14.0, 18.0}) matcher.take(t);
  EXPECT_SCORE(matcher.score(20.0, 0.0), 5, 5, 5, 0, 0);
}

TEST(ImpactMatcher, AMotionWithoutImpactsFindsAllExtra) {
  EXPECT_SCORE(match({3.0, 4.0}, 0.01, 20.0, {30.0}), 0, 2, 0, 0, 2);
}

// Five impacts in 20 s: 4 s between them, so a relative displacement of 1e-12 is 4e-12 / pi s.
TEST(ImpactMatcher, TurnsRoundingOfTheDisplacementIntoOneOfTime) {
  EXPECT_NEAR(match({2.0}).rounding_floor, 4e-12 / std::numbers::pi, 1e-26);
}

TEST(ImpactMatcher, AtRandomTheSumsAlwaysClose) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> time(0.0, 20.0);
    std::vector<double> impacts(1 + seed % 9), reports(seed % 13);
    for (double& t : impacts) t = time(random);
    for (double& t : reports) t = time(random);
    std::ranges::sort(impacts);
    std::ranges::sort(reports);
    const auto score = match(reports, 1e-9, 20.0, impacts);
    EXPECT_EQ(score.expected, score.matched + score.missed) << "seed " << seed;
    EXPECT_EQ(score.found, score.matched + score.extra) << "seed " << seed;
    EXPECT_EQ(score.expected, std::ssize(impacts)) << "seed " << seed;
    EXPECT_EQ(score.found, std::ssize(reports)) << "seed " << seed;
  }
}

TEST(ImpactMatcher, NamesItsPairsByTrueImpactAndReport) {
  const ToyMotion reference(20.0, regular);
  ImpactMatcher matcher(reference, 0.1);
  matcher.keep_pairs();
  // Two reports of one impact, an extra one, the better of two, one missed (14), one last.
  for (const double t : {2.05, 2.15, 4.0, 5.5, 6.1, 10.0, 18.2}) matcher.take(t);
  const auto pairs = matcher.pairs(20.0);
  ASSERT_EQ(pairs.size(), 4u);
  const long long indices[] = {1, 2, 3, 5};
  const std::size_t reports[] = {0, 4, 5, 6};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(pairs[i].reference, indices[i]);
    EXPECT_EQ(pairs[i].report, reports[i]);
  }
  EXPECT_EQ(matcher.pairs(20.0).size(), 4u);
  EXPECT_SCORE(matcher.score(20.0, 0.0), 5, 6, 4, 1, 2);
}

TEST(ImpactMatcher, KeepsNoPairsUnlessAskedTo) {
  const ToyMotion reference(20.0, regular);
  ImpactMatcher matcher(reference, 0.1);
  matcher.take(2.0);
  EXPECT_TRUE(matcher.pairs(20.0).empty());
}

TEST(ImpactMatcher, ARunThatStartsLateOwesNothingBefore) {
  const ToyMotion reference(20.0, regular);
  for (const double start : {6.0, 6.5, 9.9}) {
    ImpactMatcher matcher(reference, 0.1, start);
    for (const double t : {10.0, 14.0, 18.0}) matcher.take(t);
    EXPECT_SCORE(matcher.score(20.0, 0.0), 3, 3, 3, 0, 0);
  }
  // What is late itself still finds its impact.
  ImpactMatcher matcher(reference, 0.1, 6.5);
  for (const double t : {6.6, 10.0, 14.0, 18.0}) matcher.take(t);
  EXPECT_SCORE(matcher.score(20.0, 0.0), 4, 4, 4, 0, 0);
}

// Impacts of two contacts in turn.
class TwoContacts : public ToyMotion {
 public:
  TwoContacts() : ToyMotion(20.0, {2.0, 2.1, 4.0, 4.1, 6.0, 6.1}) {}
  model::MotionImpact impact(long long index) const override {
    auto impact = ToyMotion::impact(index);
    impact.contact = int((index + 1) % 2);
    return impact;
  }
};

TEST(ImpactMatcher, ReportsMatchImpactsOfTheirOwnContact) {
  const TwoContacts reference;
  ImpactMatcher matcher(reference, 0.06, 0.0, 2);
  matcher.keep_pairs();
  // 0.2 s late: within a quarter of the 2 s to the next impact of the same contact.
  matcher.take(2.2, false, 0);
  matcher.take(2.3, false, 1);
  matcher.take(4.1, false, 1);
  const auto score = matcher.score(5.0, 0.0);
  EXPECT_EQ(score.expected, 4);
  EXPECT_EQ(score.matched, 3);
  EXPECT_EQ(score.missed, 1);  // contact 0 at 4
  EXPECT_EQ(score.extra, 0);
  EXPECT_NEAR(score.worst_time_error, 0.2, 1e-14);
  const auto pairs = matcher.pairs(5.0);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].reference, 1);
  EXPECT_EQ(pairs[1].reference, 2);
  EXPECT_EQ(pairs[2].reference, 4);
}

// Three contacts that close together, contact 1 once more alone.
class TogetherMotion : public ToyMotion {
 public:
  TogetherMotion() : ToyMotion(20.0, {4.0, 4.0, 4.0, 7.0, 10.0, 10.0, 10.0}) {}
  model::MotionImpact impact(long long index) const override {
    constexpr int contacts[] = {2, 0, 1, 1, 0, 1, 2};
    auto impact = ToyMotion::impact(index);
    impact.contact = contacts[index - 1];
    return impact;
  }
};

TEST(ImpactMatcher, SimultaneousImpactsMatchInWhateverOrderTheyAreReported) {
  const TogetherMotion reference;
  std::vector<int> order{0, 1, 2};
  do {
    ImpactMatcher matcher(reference, 0.01, 0.0, 3);
    matcher.keep_pairs();
    for (const int contact : order) matcher.take(4.0, false, contact);
    matcher.take(7.02, false, 1);
    for (const int contact : order) matcher.take(10.05, false, contact);
    const auto score = matcher.score(20.0, 0.0);
    EXPECT_SCORE(score, 7, 7, 7, 0, 0);
    EXPECT_NEAR(score.worst_time_error, 0.05, 1e-14);
    const auto pairs = matcher.pairs(20.0);
    ASSERT_EQ(pairs.size(), 7u);
    constexpr long long first[] = {2, 3, 1}, last[] = {5, 6, 7};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(pairs[i].reference, first[order[i]]);
      EXPECT_EQ(pairs[i + 4].reference, last[order[i]]);
    }
  } while (std::ranges::next_permutation(order).found);
}

TEST(ImpactMatcher, OneContactLeftOutOfSeveralIsMissedAndReportedTwiceIsOne) {
  const TogetherMotion reference;
  ImpactMatcher matcher(reference, 0.01, 0.0, 3);
  matcher.take(4.0, false, 0);
  matcher.take(4.0, false, 2);
  matcher.take(4.0, false, 0);
  matcher.take(7.0, false, 0);  // of contact 1 in truth
  EXPECT_SCORE(matcher.score(9.0, 0.0), 4, 3, 2, 2, 1);
}

TEST(ImpactMatcher, EachContactMayFindItsLastImpactBeforeALateStart) {
  const TogetherMotion reference;
  ImpactMatcher matcher(reference, 0.01, 4.1, 3);
  for (const int contact : {1, 2, 0}) matcher.take(4.2, false, contact);
  EXPECT_SCORE(matcher.score(6.0, 0.0), 3, 3, 3, 0, 0);
}

TEST(ImpactMatcher, TimeFloorIsTheUncertaintyOfTheTrueInstantWhereThatIsLarger) {
  struct Vague : ToyMotion {
    model::MotionImpact impact(long long index) const override {
      auto impact = ToyMotion::impact(index);
      impact.when = {impact.t - 1e-6, impact.t + 1e-6};
      return impact;
    }
  };
  const Vague reference;
  ImpactMatcher matcher(reference, 0.01);
  matcher.take(1.57);
  EXPECT_NEAR(matcher.score(3.0, 1e-16).rounding_floor, 2e-6, 1e-12);
}

TEST(ImpactMatcher, RefusesAStepThatIsNotPositive) {
  const ToyMotion reference;
  EXPECT_THROW(ImpactMatcher(reference, 0.0), InputError);
}

}  // namespace
}  // namespace clackers::measure
