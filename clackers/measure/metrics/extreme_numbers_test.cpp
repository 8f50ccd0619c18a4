#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/measure/testing/shifted_history.hpp"

// No input of a kilobyte, about 20 rows, takes a second, whatever its numbers are.
namespace clackers::measure {
namespace {

const exact::SynchronizedPair& pair() {
  static const exact::SynchronizedPair motion({.xi1 = 0.5, .t_end = 1450.0});
  return motion;
}

void measure_all(const model::Trajectory& history, const model::Motion& motion,
                 const model::ImpactProblem<>& problem) {
  const auto start = std::chrono::steady_clock::now();
  const Comparison comparison(history, motion, problem);
  for (const auto& metric : metrics()) {
    const auto found = metric.measure(comparison);
    EXPECT_EQ(std::isnan(found.value), !found.reason.empty())
        << metric.name << " is " << found.value << ": " << found.reason;
  }
  const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start;
  EXPECT_LT(used.count(), 1.0);
}

TEST(ExtremeNumbers, SubnormalVelocitiesAreMeasured) {
  const model::Trajectory history{
      .dof = 2,
      .t = {1428.140703517588, 1435.427135678392},
      .u = {4.247828255331e-311, 2.1131854479866e-311, 1.15612563548e-312, 4.46960530917e-313},
      .v = {3.3772635613396e-311, -1.21417890628846e-310, 8.3492489201e-313, -4.07767070261e-312},
      .a = {},
      .impacts = {}};
  measure_all(history, pair(), pair().problem());
}

TEST(ExtremeNumbers, SubnormalVelocitiesOfAReportedImpactAreMeasured) {
  const exact::SynchronizedPair motion({.t_end = 9.0});
  auto history = shifted(motion, {.step = 0.5, .limits = false});
  history.impacts->insert(history.impacts->begin(),
                          {0.1, 0, {0.0, 0.0}, {-0.0, -5e-324}, {0.0, 5e-324}, 0.0});
  measure_all(history, motion, motion.problem());
}

TEST(ExtremeNumbers, OfEverySizeAreMeasured) {
  constexpr double sizes[] = {0.0,  5e-324, 1e-310, 2.2e-308, 1e-300, 1e-155,
                              1e-9, 1.0,    1e9,    1e155,    1e300,  1.7e308};
  std::mt19937 generator(5);
  const auto any = [&](double largest) {
    const auto size = sizes[std::uniform_int_distribution<std::size_t>(0, 11)(generator)];
    return std::min(size, largest) * (generator() % 2 == 0 ? 1.0 : -1.0);
  };
  const auto problem = pair().problem();
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    // Numbers of one size, or of any.
    const double largest = trial % 2 == 0 ? sizes[trial / 2 % 12] : 1.7e308;
    model::Trajectory history{.dof = 2, .t = {0.0}, .u = {}, .v = {}, .a = {}, .impacts = {}};
    for (int row = 1; row < 20; ++row) {
      const double rest = pair().end() - history.t.back();
      history.t.push_back(history.t.back() + std::min(std::abs(any(1e9)), rest / 20.0));
    }
    if (history.t.back() == 0.0) history.t.back() = 1.0;
    history.t.erase(std::unique(history.t.begin(), history.t.end()), history.t.end());
    for (std::size_t i = 0; i < 2 * history.t.size(); ++i) {
      history.u.push_back(any(largest));
      history.v.push_back(any(largest));
    }
    if (trial % 3 == 0) {
      history.impacts.emplace();
      for (const double t : {history.t[1], history.t.back()})
        history.impacts->push_back({t,
                                    0,
                                    {any(largest), any(largest)},
                                    {any(largest), any(largest)},
                                    {any(largest), any(largest)},
                                    any(largest)});
    }
    measure_all(history, pair(), problem);
  }
}

TEST(ExtremeNumbers, TwoRowsOfAMotionWithManyImpactsAreMeasured) {
  const exact::SynchronizedPair motion({.t_end = 1e8});
  const model::Trajectory history{
      .dof = 2, .t = {0.0, 1e8}, .u = {1, 1, 1, 1}, .v = {0, 0, 0, 0}, .a = {}, .impacts = {}};
  measure_all(history, motion, motion.problem());
  auto reported = history;
  reported.impacts = {{0.1, 0, {}, {}, {}, 1.0}, {0.9e8, 0, {}, {}, {}, 1.0}};
  measure_all(reported, motion, motion.problem());
}

}  // namespace
}  // namespace clackers::measure
