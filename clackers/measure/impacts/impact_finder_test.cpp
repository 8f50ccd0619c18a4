#include "clackers/measure/impacts/impact_finder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/measure/testing/sampled_motion.hpp"
#include "clackers/measure/testing/shifted_history.hpp"

namespace clackers::measure {
namespace {

// How far the found impacts are from the true ones, which must be as many.
double worst_time_error(const std::vector<FoundImpact>& found, const model::Motion& reference) {
  EXPECT_EQ(std::ssize(found), reference.impact_count(reference.end()));
  double worst = 0.0;
  for (std::size_t k = 0;
       k < found.size() && std::ssize(found) <= reference.impact_count(reference.end()); ++k)
    worst = std::max(worst, std::abs(found[k].impact.t - reference.impact(std::int64_t(k) + 1).t));
  return worst;
}

struct Pair {
  double X, r, eta;
};

class ImpactsOfAPair : public testing::TestWithParam<Pair> {
 protected:
  exact::SynchronizedPair motion_{{.X = GetParam().X, .r = GetParam().r, .eta = GetParam().eta}};
  model::ImpactProblem<> problem_ = motion_.problem();
  double fast_ =
      2.0 * std::numbers::pi / std::max(motion_.constants().omega_D1, motion_.constants().omega_D2);

  model::Trajectory sampled(double a_period, bool velocities, bool limits = false) const {
    return shifted(
        motion_,
        {.step = fast_ / a_period, .limits = limits, .reports = false, .velocities = velocities});
  }
};

TEST_P(ImpactsOfAPair, AreFoundBetweenRowsWithVelocities) {
  for (const double a_period : {10.5, 20.3, 100.0, 1000.0}) {
    const auto found = find_impacts(sampled(a_period, true), problem_);
    const double turn = 2.0 * std::numbers::pi / a_period;  // of the phase in one step
    // Runge and Kutta's local error, (omega h)^5 / 120, of a velocity that the gap is left with.
    EXPECT_LE(worst_time_error(found, motion_), std::pow(turn, 5) / 120.0 * fast_ + 1e-13)
        << a_period;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const auto reference = motion_.impact(std::int64_t(k) + 1);
      const double allowed = std::pow(turn, 4) / 24.0 + 1e-12;
      for (int i = 0; i < 2; ++i) {
        const double size = std::abs(reference.before.v[i]);
        EXPECT_NEAR(found[k].impact.v_before[std::size_t(i)], reference.before.v[i],
                    allowed * size);
        EXPECT_NEAR(found[k].impact.v_after[std::size_t(i)], reference.after.v[i], allowed * size);
      }
      EXPECT_NEAR(found[k].impact.impulse, reference.impulse, 2.0 * allowed * reference.impulse);
      EXPECT_EQ(found[k].end, found[k].impact.t);
    }
  }
}

TEST_P(ImpactsOfAPair, AreFoundBetweenRowsWithoutVelocities) {
  for (const double a_period : {10.5, 20.3, 100.0, 1000.0}) {
    const auto found = find_impacts(sampled(a_period, false), problem_);
    const double turn = 2.0 * std::numbers::pi / a_period;
    EXPECT_LE(worst_time_error(found, motion_), std::pow(turn, 3) / 24.0 * fast_ + 1e-9)
        << a_period;
  }
}

TEST_P(ImpactsOfAPair, AreExactWhereTheHistoryHasBothLimits) {
  const auto found = find_impacts(sampled(20.3, true, true), problem_);
  EXPECT_EQ(worst_time_error(found, motion_), 0.0);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto reference = motion_.impact(std::int64_t(k) + 1);
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(found[k].impact.v_before[std::size_t(i)], reference.before.v[i]);
      EXPECT_EQ(found[k].impact.v_after[std::size_t(i)], reference.after.v[i]);
    }
    EXPECT_NEAR(found[k].impact.impulse, reference.impulse, 1e-14 * reference.impulse);
  }
}

TEST_P(ImpactsOfAPair, AreFoundInSixDigits) {
  for (const double a_period : {10.5, 100.0, 2000.0})
    for (const bool velocities : {true, false}) {
      const auto history = printed(sampled(a_period, velocities), 6);
      const auto found = find_impacts(history, problem_);
      EXPECT_LE(worst_time_error(found, motion_), fast_ / a_period)
          << a_period << (velocities ? " with" : " without") << " velocities";
    }
}

INSTANTIATE_TEST_SUITE_P(Members, ImpactsOfAPair,
                         testing::Values(Pair{1.0, 1.0, 1.0}, Pair{3.0, 0.5, 1.0},
                                         Pair{9.0, 3.0, 1.0}, Pair{9.0, 3.0, 0.5},
                                         Pair{5.0, 2.0, 0.8}, Pair{1.0 / 3.0, 2.0, 0.5}));

}  // namespace
}  // namespace clackers::measure
