#include "clackers/measure/metrics/definitions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;

class FilledGraph : public testing::Test {
 protected:
  ToyMotion reference_;
  model::ImpactProblem<> problem_ = toy_problem();

  MetricValue measure(const ToyFlaws& flaws,
                      MetricValue (*metric)(const Comparison&) = measure_filled_graph) {
    const auto history = toy_history(flaws);
    return metric(Comparison(history, reference_, problem_));
  }
};

TEST_F(FilledGraph, IsZeroForTheReferenceAtItsOwnRowsHoweverFewThereAre) {
  // Times are formed in two ways, t and t/T, and rounded.
  EXPECT_LT(measure({.h = 0.01}).value, 1e-15);
  EXPECT_LT(measure({.h = 0.5}).value, 1e-15);
}

TEST_F(FilledGraph, OfImpactsThatComeLateIsTheirDelayOverThePeriod) {
  for (const double delay : {0.1, 0.01, 0.001}) {
    const auto found = measure({.delay = delay});
    // Up to the delayed jump the velocity turns by delay^2/2 of its envelope, and h^2/8 is cut off.
    EXPECT_NEAR(found.value, delay / pi, delay * delay + 1e-5) << delay;
    ASSERT_EQ(found.masses.size(), 2u);
    EXPECT_NEAR(found.masses[1], found.value, 1e-12);
    EXPECT_EQ(found.reason, "");
  }
}

TEST_F(FilledGraph, TendsToZeroForJumpsThatAreSmearedOverAContactTime) {
  // A ramp of length w and height 2: (w/pi)/(1 + (w/pi)/2) at most, see the lines' own test.
  for (const double w : {0.4, 0.04, 0.004}) {
    const auto found = measure({.h = w / 40, .smear = w, .reports = false});
    const double exact = w / pi / (1.0 + 0.5 * w / pi);
    EXPECT_NEAR(found.value, exact, 0.03 * exact + w * w / 4) << w;
  }
}

TEST_F(FilledGraph, OfUnreportedImpactsIsAtMostTheStep) {
  for (const double h : {0.1, 0.01}) {
    const auto found = measure({.h = h, .reports = false});
    EXPECT_LT(found.value, h / pi);
    EXPECT_GT(found.value, 0.4 * h / pi);
  }
}

TEST_F(FilledGraph, UsesReportedLimitsAndNotTheRampBetweenRows) {
  EXPECT_LT(measure({.h = 0.1}).value, 1e-15);
  EXPECT_GT(measure({.h = 0.1, .knows_limits = false}).value, 0.01);
}

TEST_F(FilledGraph, ARowAtTheInstantOfAnImpactMayBeEitherLimit) {
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
    EXPECT_LT(measure_filled_graph(Comparison(history, reference_, problem_)).value, 1e-15);
  }
}

TEST_F(FilledGraph, DoesNotCountAJumpThatOnlyOneOfBothHasWithinTheLastTwoSteps) {
  // The true impact is at 4.7124; one of both comes after the end.
  EXPECT_LT(measure({.end = 4.72, .h = 0.01, .delay = 0.015}).value, 0.01);
  EXPECT_LT(measure({.end = 4.705, .h = 0.01, .delay = -0.01}).value, 0.01);
  // Further back it does.
  EXPECT_GT(measure({.end = 4.75, .h = 0.01, .delay = 0.06}).value, 0.1);
}

TEST_F(FilledGraph, TellsWhichSideHasWhatTheOtherHasNot) {
  auto history = toy_history({.h = 0.01});
  history.v[2 * 20] += 5.0;  // a spike of mass 1 at t = 0.2
  const Comparison comparison(history, reference_, problem_);
  const auto has = measure_filled_graph_of_history(comparison);
  // At -sin(0.2) + 5; the reference comes up to 1, less than a period away.
  EXPECT_NEAR(has.value, 5.0 - std::sin(0.2) - 1.0, 1e-12);
  EXPECT_LT(has.masses[1], 1e-15);
  // The foot of the spike is one step away in time.
  EXPECT_LT(measure_filled_graph_of_reference(comparison).value, 0.02);
  EXPECT_EQ(measure_filled_graph(comparison).value, has.value);
}

TEST_F(FilledGraph, IsNotMeasuredWithoutWhatItNeeds) {
  auto history = toy_history({});
  history.v.clear();
  for (auto* metric :
       {measure_filled_graph, measure_filled_graph_of_history, measure_filled_graph_of_reference}) {
    const auto found = metric(Comparison(history, reference_, problem_));
    EXPECT_EQ(found.reason, "The history has no velocities.");
    EXPECT_TRUE(std::isnan(found.value));
  }
}

TEST_F(FilledGraph, IsNotMeasuredWhereRowsAreFarFewerThanTrueImpacts) {
  const ToyMotion long_one(1e4);
  const auto problem = toy_problem(1e4);
  model::Trajectory history;
  history.dof = 2;
  history.t = {0.0, 1e4};
  history.u = {1, 1, 1, 1};
  history.v = {0, 0, 0, 0};
  const auto found = measure_filled_graph(Comparison(history, long_one, problem));
  EXPECT_EQ(found.reason, "The history has 2 rows for 3183 true impacts.");
}

}  // namespace
}  // namespace clackers::measure
