#include "clackers/measure/metrics/definitions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;

class HybridCloseness : public testing::Test {
 protected:
  ToyMotion reference_;
  model::ImpactProblem<> problem_ = toy_problem();

  MetricValue measure(const model::Trajectory& history) {
    return measure_hybrid_closeness(Comparison(history, reference_, problem_));
  }
  MetricValue measure(const ToyFlaws& flaws) { return measure(toy_history(flaws)); }
};

TEST_F(HybridCloseness, IsZeroForTheReference) {
  EXPECT_LT(measure({.h = 0.01}).value, 1e-15);
  EXPECT_LT(measure({.h = 0.5}).value, 1e-15);
}

TEST_F(HybridCloseness, FlightsEndAndStartWithTheLimitsOfImpacts) {
  const auto history = toy_history({.end = 3.0, .h = 0.1, .delay = 0.02});
  const Comparison comparison(history, reference_, problem_);
  auto found_arc = HybridArc::of_history(comparison);
  auto reference_arc = HybridArc::of_reference(comparison);
  ASSERT_EQ(found_arc.flights(), 2u);
  ASSERT_EQ(reference_arc.flights(), 2u);
  const Polyline found[] = {*found_arc.next(), *found_arc.next()};
  const Polyline reference[] = {*reference_arc.next(), *reference_arc.next()};
  ASSERT_EQ(found[0].dimension(), 5u);
  const auto last = found[0].point(found[0].size() - 1), next = found[1].point(0);
  EXPECT_NEAR(last[0], (0.5 * pi + 0.02) / pi, 1e-15);
  EXPECT_NEAR(last[1], std::cos(0.5 * pi + 0.02), 1e-15);
  EXPECT_NEAR(last[2], -std::sin(0.5 * pi + 0.02), 1e-15);
  EXPECT_NEAR(last[3], -std::cos(0.5 * pi + 0.02), 1e-15);  // -u1/2 over 1/2
  EXPECT_EQ(next[0], last[0]);
  EXPECT_NEAR(next[2], std::sin(0.5 * pi + 0.02), 1e-15);
  EXPECT_NEAR(reference[0].point(reference[0].size() - 1)[0], 0.5, 1e-15);
  EXPECT_NEAR(reference[1].point(0)[2], 1.0, 1e-15);
  // Rows at 0 ... 1.5 and 1.6 ... 3.0, and a limit at the impact; those that the comparison adds
  // to the history as limits stand on both sides of it.
  EXPECT_GE(found[0].size(), 17u);
  EXPECT_GE(found[1].size(), 16u);
}

TEST_F(HybridCloseness, OfImpactsThatComeLateIsTheirDelay) {
  for (const double delay : {0.1, 0.01, 0.001}) {
    // The end of the delayed flight is delay after that of the true one, and as far below 0: the
    // displacement is the farther coordinate. The start of the next flight likewise.
    EXPECT_NEAR(measure({.delay = delay}).value, std::sin(delay), 0.01 * delay) << delay;
  }
}

TEST_F(HybridCloseness, OfTooLongPeriodsIsTheErrorAtTheEndWhereNothingLaterCanBeCompared) {
  // Impact k comes 1e-3 (k - 1/2) pi late, at most 2.5e-3 T; at the end the reference is ahead by
  // 1e-3 t.
  for (const double end : {6.0, 9.0}) {
    const double error = std::abs(std::sin(end / 1.001) / 1.001 - std::sin(end));
    const auto found = measure({.end = end, .h = 0.01, .stretch = 1.001});
    EXPECT_NEAR(found.value, error, 1e-5 * error) << end;
    EXPECT_TRUE(found.masses.empty());
  }
}

TEST_F(HybridCloseness, ASmearedJumpIsNotClose) {
  EXPECT_GT(measure({.h = 0.001, .smear = 0.02}).value, 0.4);
}

TEST_F(HybridCloseness, ARowAtTheInstantOfAnImpactMayBeEitherLimit) {
  for (const bool left : {true, false}) {
    auto history = toy_history({.end = 3.0, .h = 0.1});
    const auto& impact = history.impacts->at(0);
    const auto row = std::ranges::upper_bound(history.t, impact.t) - history.t.begin();
    const auto& v = left ? impact.v_before : impact.v_after;
    history.t.insert(history.t.begin() + row, impact.t);
    history.u.insert(history.u.begin() + 2 * row, impact.u.begin(), impact.u.end());
    history.v.insert(history.v.begin() + 2 * row, v.begin(), v.end());
    // With accelerations, which an impact does not carry, the row stays alone.
    history.a.assign(history.u.size(), 0.0);
    EXPECT_LT(measure(history).value, 1e-15);
  }
}

TEST_F(HybridCloseness, RowsInsideAnImpactOfTwoStepsBelongToNoFlight) {
  const double h = 0.01;
  auto history = toy_history({.end = 3.0, .h = h});
  auto& first = history.impacts->at(0);
  auto second = first;
  second.t += h;
  first.v_after = second.v_before = {0.0, 0.0};
  for (std::size_t row = 0; row < history.t.size(); ++row)
    if (history.t[row] > first.t && history.t[row] < second.t)
      history.v[2 * row] = history.v[2 * row + 1] = 0.0;
  history.impacts->push_back(second);
  EXPECT_NEAR(measure(history).value, h / pi, 1e-4);
}

TEST_F(HybridCloseness, AnImpactDuringOneOfAnotherContactFollowsIt) {
  problem_.contacts.push_back(problem_.contacts[0]);
  const double h = 0.01;
  auto history = toy_history({.end = 3.0, .h = h});
  auto later = history.impacts->at(0), other = later;
  later.t += h;
  other.t += 0.5 * h;
  other.contact = 1;
  history.impacts->push_back(other);
  history.impacts->push_back(later);
  const Comparison comparison(history, reference_, problem_);
  auto arc = HybridArc::of_history(comparison);
  ASSERT_EQ(arc.flights(), 3u);
  double t = 0.0;
  for (std::size_t flight = 0; flight < 3; ++flight) {
    const auto line = *arc.next();
    for (std::size_t i = 0; i < line.size(); ++i) {
      EXPECT_GE(line.point(i)[0], t) << flight << ", " << i;
      t = line.point(i)[0];
    }
  }
}

TEST_F(HybridCloseness, TellsWhenTheNumbersOfImpactsDiffer) {
  auto history = toy_history({.end = 6.0});
  history.impacts->pop_back();
  EXPECT_EQ(
      measure(history).reason,
      "The history has 1 impacts and the reference 2, so no epsilon makes their flights close "
      "one by one.");
  history.impacts.emplace();
  EXPECT_NE(measure(history).reason, "");
  history = toy_history({.end = 6.0});
  history.impacts->push_back(history.impacts->back());
  history.impacts->back().t = 5.0;
  EXPECT_NE(measure(history).reason, "");
}

TEST_F(HybridCloseness, AnImpactThatCameTooLateToBeSeenDoesNotCount) {
  // The true impact is at 4.712, the delayed one after the end.
  const auto found = measure({.end = 4.72, .h = 0.01, .delay = 0.015});
  EXPECT_EQ(found.reason, "");
  EXPECT_LT(found.value, 0.02);
}

TEST_F(HybridCloseness, IsNotMeasuredWithoutVelocities) {
  auto history = toy_history({});
  history.v.clear();
  history.impacts.reset();
  EXPECT_EQ(measure(history).reason, "The history has no velocities.");
}

TEST_F(HybridCloseness, WithoutKnownLimitsFlightsEndAtRows) {
  for (const double h : {0.1, 0.01})
    EXPECT_LT(measure({.h = h, .knows_limits = false}).value, h)
        << "less than the flight in a step";
}

}  // namespace
}  // namespace clackers::measure
