#include "clackers/measure/errors/meter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clackers/cases/case.hpp"
#include "clackers/measure/errors/comparison.hpp"

namespace clackers::measure {
namespace {

cases::Case pair_case() { return cases::make("three-parameter"); }

// The exact motion every `step`, and both limits at each impact if asked.
model::Trajectory exact_history(const cases::Case& problem, double step, bool with_limits) {
  const auto& motion = *problem.motion;
  model::Trajectory h;
  h.dof = motion.dof();
  const auto add = [&](double t, model::Side side) {
    const auto now = motion.at(t, side);
    h.t.push_back(t);
    for (const double u : now.u) h.u.push_back(u);
    for (const double v : now.v) h.v.push_back(v);
  };
  long long next = 1;
  for (long long i = 0; double(i) * step <= motion.end(); ++i) {
    const double t = double(i) * step;
    for (; with_limits && next <= motion.impact_count(t); ++next)
      for (const auto side : {model::Side::left, model::Side::right})
        add(motion.impact(next).t, side);
    add(t, model::Side::right);
  }
  return h;
}

RunScore score(const model::Trajectory& h, const cases::Case& problem) {
  return Comparison(h, *problem.motion, problem.problem).score(0.01);
}

TEST(MeterOfRows, OfTheReferenceIsRounding) {
  const auto problem = pair_case();
  const auto found = score(exact_history(problem, 0.01, true), problem);
  // The sixth impact's time is off by half of 3.6e-15 s, and mass 2 moves nine envelopes a second.
  EXPECT_LT(found.u_error, 2e-14);
  EXPECT_LT(found.v_error, 1e-15);
  EXPECT_LT(found.energy_error, 1e-14);
}

TEST(MeterOfRows, TakesLimitsThatComeALittleEarlyOrLate) {
  const auto problem = pair_case();
  for (const double shift : {-1e-9, 1e-9}) {
    auto h = exact_history(problem, 0.01, true);
    for (std::size_t i = 0; i + 1 < h.t.size(); ++i)
      if (h.t[i] == h.t[i + 1]) h.t[i] = h.t[i + 1] = h.t[i] + shift;
    const auto found = score(h, problem);
    // Velocities that reverse 1e-9 s early or late: 6 times 2 v 1e-9 / (20 s of envelope v).
    EXPECT_LT(found.v_error, 1e-9) << shift;
    EXPECT_LT(found.u_error, 1e-8) << shift;
    EXPECT_GT(found.u_error, 1e-10) << "the rows at the jumps count, too";
  }
}

TEST(MeterOfRows, TakesReportedImpactsForTheLimitsOfJumps) {
  const auto problem = pair_case();
  auto h = exact_history(problem, 0.01, false);
  const double without = score(h, problem).v_error;
  h.impacts.emplace();
  for (int k = 1; k <= 6; ++k) {
    const auto impact = problem.motion->impact(k);
    h.impacts->push_back({.t = impact.t,
                          .contact = 0,
                          .u = {0.0, 0.0},
                          .v_before = {impact.before.v[0], impact.before.v[1]},
                          .v_after = {impact.after.v[0], impact.after.v[1]},
                          .impulse = impact.impulse});
  }
  EXPECT_LT(score(h, problem).v_error, 1e-15);
  EXPECT_LT(without, 1e-14) << "rows alone compare with the flight that holds";
  h.impacts->front().v_after[0] += 1.0;
  EXPECT_GT(score(h, problem).v_error, 1e-5);
  h.impacts->front().v_after[0] = std::nan("");
  EXPECT_LT(score(h, problem).v_error, 1e-15) << "what is not known is not used";
}

TEST(MeterOfRows, OfALaterStartIsOverItsOwnLength) {
  const auto problem = pair_case();
  auto h = exact_history(problem, 0.01, true);
  const auto late = std::lower_bound(h.t.begin(), h.t.end(), 1.2) - h.t.begin();
  h.t.erase(h.t.begin(), h.t.begin() + late);
  for (auto* part : {&h.u, &h.v}) part->erase(part->begin(), part->begin() + 2 * late);
  for (std::size_t i = 0; i < h.t.size(); ++i) h.v[2 * i] += 1e-3;
  EXPECT_NEAR(score(h, problem).v_error, 1e-3 / problem.motion->peak().v[0], 1e-14);
}

TEST(MeterOfRows, KnowsNothingOfWhatTheHistoryLacks) {
  const auto problem = pair_case();
  auto h = exact_history(problem, 0.01, false);
  for (std::size_t i = 0; i < h.t.size(); ++i) h.u[2 * i] += 1e-3;
  EXPECT_NEAR(score(h, problem).u_error, 1e-3, 1e-15);
  h.v.clear();
  const auto no_v = score(h, problem);
  EXPECT_NEAR(no_v.u_error, 1e-3, 1e-15);
  EXPECT_TRUE(std::isnan(no_v.v_error) && std::isnan(no_v.energy_error));
  EXPECT_TRUE(std::isnan(no_v.energy_ratio));
}

// Impacts take energy: limits and what is between them and the other motion's jump are no states.
TEST(MeterOfRows, LimitsAreNoStatesForTheEnergy) {
  const auto problem = cases::make("stop", {{"eta", 0.5}});
  const auto plain = exact_history(problem, 0.01, false);
  auto limits = exact_history(problem, 0.01, true);
  for (std::size_t i = 0; i + 1 < limits.t.size(); ++i)
    if (limits.t[i] == limits.t[i + 1]) limits.t[i] = limits.t[i + 1] = limits.t[i] + 1e-9;
  EXPECT_LT(score(plain, problem).energy_error, 1e-14);
  EXPECT_EQ(score(limits, problem).energy_error, score(plain, problem).energy_error);
}

// A motion that starts at rest in equilibrium has no energy at t = 0.
TEST(MeterOfRows, EnergyErrorsAreRelativeToTheLargestEnergyOfTheRun) {
  const auto problem = cases::make("forced-pair");
  auto h = exact_history(problem, problem.problem.end / 1000.0, false);
  const MechanicalEnergy energy(problem.problem.system);
  double largest = 0.0;
  for (std::size_t i = 0; i < h.t.size(); ++i)
    largest = std::max(largest, energy.total(&h.u[2 * i], &h.v[2 * i]));
  const auto last = 2 * (h.t.size() - 1);
  const double before = energy.kinetic(&h.v[last]);
  h.v[last] += 1.0;
  const Comparison comparison(h, *problem.motion, problem.problem);
  // Energy changes by at most 5 % of its largest within a part of 1/1024.
  EXPECT_NEAR(comparison.meter().scales().energy, largest, 0.05 * largest);
  EXPECT_NEAR(comparison.score(0.01).energy_error * comparison.meter().scales().energy,
              std::abs(energy.kinetic(&h.v[last]) - before), 1e-9 * largest);
}

}  // namespace
}  // namespace clackers::measure
