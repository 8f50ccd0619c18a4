#include "clackers/measure/metrics/definitions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/measure/testing/shifted_history.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

constexpr double half_pi = 0.5 * std::numbers::pi;
const ToyMotion reference;
const auto problem = toy_problem();

std::vector<double>& column(model::Trajectory& history, Component quantity) {
  return quantity == Component::u ? history.u : quantity == Component::v ? history.v : history.a;
}

void expect(const MetricValue& found, double first, double second) {
  ASSERT_EQ(found.reason, "");
  ASSERT_EQ(found.masses.size(), 2u);
  EXPECT_NEAR(found.masses[0], first, 1e-14);
  EXPECT_NEAR(found.masses[1], second, 1e-14);
  EXPECT_EQ(found.value, std::max(found.masses[0], found.masses[1]));
}

// Errors 0.1, -0.2, 0.4 of mass 1 and 0, 0, 0.3 of mass 2 at 0, 0.5 and 1.5; envelopes 1 and 0.5.
TEST(NormError, IsWhatAHandComputes) {
  for (const auto quantity : {Component::u, Component::v, Component::a}) {
    auto history = history_of(reference, {0.0, 0.5, 1.5});
    auto& x = column(history, quantity);
    x[0] += 0.1;
    x[2] -= 0.2;
    x[4] += 0.4;
    x[5] += 0.3;
    const Comparison comparison(history, reference, problem);
    expect(norm_error(comparison, quantity, Norm::max), 0.4, 0.3);
    expect(relative_norm_error(comparison, quantity, Norm::max), 0.4, 0.6);
    expect(norm_error(comparison, quantity, Norm::l1), (0.075 + 0.3) / 1.5, 0.15 / 1.5);
    expect(norm_error(comparison, quantity, Norm::l2), std::sqrt((0.0125 + 0.1) / 1.5),
           std::sqrt(0.045 / 1.5));
    expect(relative_norm_error(comparison, quantity, Norm::l2), std::sqrt((0.0125 + 0.1) / 1.5),
           2.0 * std::sqrt(0.045 / 1.5));
    expect(norm_error(comparison, quantity, Norm::end), 0.4, 0.3);
    for (const auto other : {Component::u, Component::v, Component::a}) {
      if (other == quantity) continue;
      for (const auto norm : {Norm::max, Norm::l1, Norm::l2, Norm::end})
        expect(norm_error(comparison, other, norm), 0.0, 0.0);
    }
  }
}

TEST(NormError, IsAMeanOverTheHistoryAlone) {
  auto history = history_of(reference, {0.5, 1.5});
  history.u[2] += 0.2;
  expect(norm_error({history, reference, problem}, Component::u, Norm::l1), 0.1, 0.0);
}

// The velocities of mass 1 differ by 2 from pi/2 to the history's jump 0.1 s later, those of mass
// 2 by 1; the accelerations by twice the displacement, which is small there.
TEST(NormError, CountsAShiftedJumpForTheTimeBetween) {
  auto history = history_of(reference, {1.0, half_pi, half_pi, 2.2});
  history.t[1] = history.t[2] = half_pi + 0.1;
  const Comparison comparison(history, reference, problem);
  expect(norm_error(comparison, Component::v, Norm::l1), 0.2 / 1.2, 0.1 / 1.2);
  expect(norm_error(comparison, Component::v, Norm::l2), std::sqrt(0.4 / 1.2),
         std::sqrt(0.1 / 1.2));
  expect(norm_error(comparison, Component::v, Norm::max), 1.0 + std::cos(0.1),
         0.5 + 0.5 * std::cos(0.1));
  expect(norm_error(comparison, Component::v, Norm::end), 0.0, 0.0);
}

TEST(NormError, OfAccelerationsLooksAtTheirOwnJumps) {
  auto history = history_of(reference, {1.0, half_pi, half_pi, 2.2});
  for (std::size_t i = 2; i < 4; ++i) history.a[i] += 0.5;  // left limits
  for (std::size_t i = 4; i < 6; ++i) history.a[i] -= 0.25;
  const double first = 0.5 * (half_pi - 1.0) * 0.5, second = 0.5 * (2.2 - half_pi) * 0.25;
  expect(norm_error({history, reference, problem}, Component::a, Norm::l1), (first + second) / 1.2,
         (first + second) / 1.2);
}

// Jumps in the first and last rows: what lies before the one and behind the other has no length.
TEST(NormError, TakesJumpsAtTheEndsOfAHistory) {
  const double last = 3.0 * half_pi;
  auto history = history_of(reference, {half_pi, half_pi, 2.5, last, last});
  expect(norm_error({history, reference, problem}, Component::v, Norm::l1), 0.0, 0.0);
  history.v[0] += 5.0;
  history.v[8] += 9.0;
  expect(norm_error({history, reference, problem}, Component::v, Norm::l1), 0.0, 0.0);
  history.v[2] += 0.2;
  history.v[6] += 0.4;
  expect(norm_error({history, reference, problem}, Component::v, Norm::l1),
         (0.1 * (2.5 - half_pi) + 0.2 * (last - 2.5)) / (last - half_pi), 0.0);
}

// A run that a method streams and the same run stored are measured alike.
TEST(NormError, IsThatOfARunJudgedWhileItHappens) {
  const auto history =
      shifted(reference, {.step = 0.05, .delay = 0.013, .limits = false, .reports = true});
  const Comparison comparison(history, reference, problem);
  ErrorSink sink(reference, problem, 0.05);
  auto impact = history.impacts->begin();
  for (std::size_t i = 0; i < history.t.size(); ++i) {
    for (; impact != history.impacts->end() && impact->t < history.t[i]; ++impact)
      sink.take(model::ReportedImpact{impact->t, 0, impact->u, impact->v_before, impact->v_after,
                                      impact->impulse});
    sink.take(
        model::SampleBlock{2, {&history.t[i], 1}, {&history.u[2 * i], 2}, {&history.v[2 * i], 2}});
  }
  const auto score = sink.score({});
  EXPECT_GT(score.v_error, 1e-3);
  EXPECT_NEAR(relative_norm_error(comparison, Component::v, Norm::l1).value, score.v_error, 1e-14);
  EXPECT_EQ(score.impacts->matched, comparison.impact_score().matched);
}

TEST(NormError, SaysWhatTheHistoryLacks) {
  auto history = history_of(reference, {0.0, 1.0});
  history.v.clear();
  history.a.clear();
  const Comparison comparison(history, reference, problem);
  EXPECT_EQ(norm_error(comparison, Component::v, Norm::l1).reason,
            "The history has no velocities.");
  EXPECT_EQ(relative_norm_error(comparison, Component::a, Norm::max).reason,
            "The history has no accelerations.");
}

class StillMass : public ToyMotion {
 public:
  model::Kinematics envelope(double) const override {
    const Eigen::Vector2d none(1.0, 0.0);
    return {none, none, none};
  }
};

TEST(NormError, IsRelativeToNothingWhereAMassDoesNotMove) {
  const StillMass still;
  const auto history = history_of(still, {0.0, 1.0});
  const auto found = relative_norm_error({history, still, problem}, Component::u, Norm::max);
  EXPECT_TRUE(std::isnan(found.value));
  EXPECT_NE(found.reason.find("mass 2"), std::string::npos) << found.reason;
}

}  // namespace
}  // namespace clackers::measure
