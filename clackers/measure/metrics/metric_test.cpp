#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/measure/testing/shifted_history.hpp"

namespace clackers::measure {
namespace {

using Values = std::vector<double>;  // one a level, the first with the longest delay

struct Scenario {
  const char* name;
  std::shared_ptr<const exact::ClosedForm> motion;
  std::vector<ShiftedHistory> levels;
  std::vector<std::string_view> excepted = {};  // metrics that need not vanish here
};

// Delays from 2e-2 s down by 4 while the grid stays, so that a metric that counts a jump over half
// a step does not converge.
std::vector<ShiftedHistory> falling_delays() {
  std::vector<ShiftedHistory> levels;
  for (double delay = 2e-2; delay > 1e-5; delay /= 4.0)
    levels.push_back({.step = 0.01, .delay = delay, .accelerations = true});
  return levels;
}

// A method that reports each impact one and a half steps late.
std::vector<ShiftedHistory> falling_steps() {
  std::vector<ShiftedHistory> levels;
  for (double step = 2e-2; step > 5e-4; step /= 2.0)
    levels.push_back({.step = step, .delay = 1.5 * step, .accelerations = true});
  return levels;
}

std::vector<Scenario> scenarios() {
  const exact::PairParameters lossy{.X = 3.0, .r = 2.0, .eta = 0.5, .t_end = 9.0};
  auto elastic = lossy, at_impact = lossy;
  elastic.eta = 1.0;
  at_impact.t_end = std::nextafter(exact::SynchronizedPair(lossy).impact(2).t, 10.0);
  const auto pair = [](const exact::PairParameters& p) {
    return std::make_shared<const exact::SynchronizedPair>(p);
  };
  return {{"lossy", pair(lossy), falling_delays()},
          {"elastic", pair(elastic), falling_delays()},
          // A graph that ends before a jump lacks all of it, however short the time to it.
          {"ends at an impact",
           pair(at_impact),
           falling_steps(),
           {"v-filled-graph", "v-filled-graph-deficit"}},
          {"late by steps", pair(elastic), falling_steps()},
          {"rigid stop",
           std::make_shared<const exact::RigidStop>(
               exact::RigidStopParameters{.eta = 0.5, .t_end = 9.0}),
           falling_delays()},
          {"rigid stop, late by steps",
           std::make_shared<const exact::RigidStop>(
               exact::RigidStopParameters{.eta = 0.5, .t_end = 9.0}),
           falling_steps()}};
}

// The metrics that are errors; causes of errors follow them in the table.
std::span<const Metric> errors() {
  return metrics().first(std::size_t(&metric("synchrony-loss-index") - metrics().data()));
}

// The value of each metric at each level; empty where it is not measured.
std::vector<Values> measured_values(const Scenario& scenario) {
  const auto problem = scenario.motion->problem();
  std::vector<Values> values(errors().size());
  for (const auto& level : scenario.levels) {
    const auto history = shifted(*scenario.motion, level);
    const Comparison comparison(history, *scenario.motion, problem);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto found = errors()[i].measure(comparison);
      EXPECT_EQ(found.reason.empty(), !std::isnan(found.value)) << errors()[i].name;
      if (found.reason.empty()) values[i].push_back(found.value);
    }
  }
  return values;
}

// At worst like the root of the delay, as an L2 norm of a jump does. Where rows meet jumps another
// way at each level a value may rise once, not twice.
bool vanishes(const Values& values, const Scenario& scenario) {
  const double root = std::sqrt(scenario.levels.back().delay / scenario.levels.front().delay);
  for (std::size_t i = 2; i < values.size(); ++i)
    if (values[i] > 1.05 * values[i - 2] + 1e-14) return false;
  return values.back() <= 1.5 * root * values.front() + 1e-12;
}

bool stays(const Values& values) {
  return values.back() > 0.5 * values.front() && values.front() > 1e-3;
}

TEST(Metrics, ConvergeThroughShiftedJumpsExactlyWhenTheyClaimTo) {
  const auto all = scenarios();
  std::vector<bool> is_measured(errors().size()), floors(errors().size());
  for (const auto& scenario : all) {
    const auto values = measured_values(scenario);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i].empty()) continue;
      ASSERT_EQ(values[i].size(), scenario.levels.size()) << errors()[i].name;
      is_measured[i] = true;
      if (std::ranges::count(scenario.excepted, errors()[i].name)) continue;
      floors[i] = floors[i] || stays(values[i]);
      if (errors()[i].across_jumps) {
        EXPECT_TRUE(vanishes(values[i], scenario)) << errors()[i].name << ", " << scenario.name
                                                   << ": " << testing::PrintToString(values[i]);
      }
    }
  }
  for (std::size_t i = 0; i < errors().size(); ++i) {
    if (errors()[i].name.starts_with("rest-"))
      continue;  // no contact of these motions stays closed
    EXPECT_TRUE(is_measured[i]) << errors()[i].name;
    EXPECT_EQ(floors[i], !errors()[i].across_jumps) << errors()[i].name;
  }
}

TEST(Metrics, AreAllAtRoundingForTheReferenceItself) {
  for (const auto& scenario : scenarios()) {
    const auto problem = scenario.motion->problem();
    const auto history = shifted(*scenario.motion, {.accelerations = true});
    const Comparison comparison(history, *scenario.motion, problem);
    for (const auto& metric : errors()) {
      const auto found = metric.measure(comparison);
      if (found.reason.empty()) {
        EXPECT_LE(found.value, 1e-13) << metric.name << ", " << scenario.name;
      }
    }
  }
}

TEST(Metrics, SayWhyTheyCannotMeasure) {
  const exact::SynchronizedPair motion({.t_end = 9.0});
  const auto problem = motion.problem();
  const auto history = shifted(motion, {.reports = false, .velocities = false});
  const Comparison comparison(history, motion, problem);
  for (const auto& metric : metrics()) {
    const auto found = metric.measure(comparison);
    EXPECT_EQ(std::isnan(found.value), !found.reason.empty()) << metric.name;
    if (found.reason.empty()) continue;
    EXPECT_EQ(found.reason.back(), '.') << metric.name;
    EXPECT_TRUE(found.masses.empty()) << metric.name;
  }
}

TEST(Metrics, HaveNamesUnitsAndDefinitions) {
  std::set<std::string_view> names;
  for (const auto& row : metrics()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.unit.empty() || row.definition.empty() || row.source.empty()) << row.name;
    EXPECT_EQ(&metric(row.name), &row);
    EXPECT_EQ(row.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz12-"), std::string::npos)
        << row.name;
    EXPECT_LE(row.definition.size(), 100u) << row.name;
    if (row.name.ends_with("-relative")) {
      EXPECT_EQ(row.unit, "1") << row.name;
    }
  }
}

TEST(Metrics, AFewAreShownInReports) {
  EXPECT_TRUE(metric("u-max-relative").in_reports);
  EXPECT_FALSE(metric("a-end").in_reports);
  const auto shown = std::ranges::count(metrics(), true, &Metric::in_reports);
  EXPECT_GE(shown, 5);
  EXPECT_LE(shown, 15);
}

TEST(Metrics, SuggestANameForAMisspelledOne) {
  try {
    metric("u-mux");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.code().name(), "unknown-name");
    EXPECT_NE(std::string(error.what()).find("\"u-max\""), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace clackers::measure
