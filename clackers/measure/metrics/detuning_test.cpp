#include "clackers/measure/metrics/causes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/measure/testing/toy_motion.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers::measure {
namespace {

TEST(Detuning, OfAHistoryWithTheTrueFrequenciesIsZero) {
  const ToyMotion reference;
  const auto problem = toy_problem();
  for (const bool knows_limits : {true, false}) {
    const auto history = toy_history({.h = 0.1, .knows_limits = knows_limits});
    const Comparison comparison(history, reference, problem);
    const auto found = flight_frequencies(comparison);
    ASSERT_EQ(found.errors.size(), 2u);
    EXPECT_NEAR(found.errors[0], 0.0, 1e-14);
    EXPECT_NEAR(found.errors[1], 0.0, 1e-14);
  }
}

TEST(Detuning, IsThatOfTheMethodThroughImpacts) {
  // Average acceleration turns a mass by 2 atan(W/2) a step, W = omega h, undamped.
  const exact::SynchronizedPair reference({.xi1 = 0.0, .X = 9.0, .r = 0.5, .t_end = 20.0});
  const auto problem = reference.problem();
  const double h = 20.0 / 1600;
  model::TrajectorySink sink(true);
  methods::method("newmark")->prepare(problem, h)->advance(sink);
  const Comparison comparison(sink.trajectory(), reference, problem);
  const auto found = flight_frequencies(comparison);
  const auto own = [&](double omega) { return 2.0 * std::atan(0.5 * omega * h) / (omega * h) - 1; };
  ASSERT_EQ(found.errors.size(), 2u) << found.reason;
  // The steps that end at an impact and start after it are shorter and turn by a little more.
  EXPECT_NEAR(found.errors[0], own(1.0), 0.05 * std::abs(own(1.0)));
  EXPECT_NEAR(found.errors[1], own(9.0), 0.05 * std::abs(own(9.0)));
  EXPECT_NEAR(detuning(comparison, found), own(9.0) - own(1.0), 0.05 * std::abs(own(9.0)));
}

TEST(Detuning, SaysWhyFrequenciesWereNotMeasured) {
  const ToyMotion reference;
  auto problem = toy_problem();
  const auto reason = [&](const model::Trajectory& history) {
    const auto found = flight_frequencies(Comparison(history, reference, problem));
    EXPECT_TRUE(found.errors.empty());
    return found.reason;
  };
  auto history = toy_history({});
  history.v.clear();
  EXPECT_EQ(reason(history), "The history has no velocities.");
  EXPECT_EQ(reason(toy_history({.h = 1.6})), "Rows are farther apart than a quarter of a period.");
  const auto good = problem;
  problem.system.stiffness(0, 1) = problem.system.stiffness(1, 0) = 0.1;
  EXPECT_EQ(reason(toy_history({})), "The masses are coupled in flight.");
  problem = good;
  problem.system.damping = 2.0 * problem.system.mass;
  EXPECT_EQ(reason(toy_history({})), "A mass is not underdamped.");
  problem = good;
  problem.system.add_load = [](double, std::span<double>) {};
  EXPECT_EQ(reason(toy_history({})), "The system has a load or a nonlinear force.");
  const Comparison comparison(history, reference, good);
  EXPECT_THROW(detuning(comparison, {.errors = {0.1}, .reason = {}}), InputError);
}

TEST(Detuning, IsWhatTheFasterMassTurnsBeyondTheSlowerOne) {
  const ToyMotion reference;
  auto problem = toy_problem();
  problem.system.stiffness(0, 0) = 4.0;
  const auto history = toy_history({});
  EXPECT_NEAR(
      detuning(Comparison(history, reference, problem), {.errors = {0.1, 0.01}, .reason = {}}),
      1.1 / 1.01 - 1.0, 1e-15);
  problem = toy_problem();
  problem.system.stiffness(1, 1) = 8.0;
  EXPECT_NEAR(
      detuning(Comparison(history, reference, problem), {.errors = {0.1, 0.01}, .reason = {}}),
      1.01 / 1.1 - 1.0, 1e-15);
}

}  // namespace
}  // namespace clackers::measure
