#include "clackers/measure/errors/shared_states.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

TEST(SharedStates, AreSampledOnceForAllRunsOfAStep) {
  const auto reference = std::make_shared<ToyMotion>();
  SharedStates shared(reference, 0.0);
  reference->samples = 0;
  const GridStates* found[4];
  {
    std::vector<std::thread> threads;
    for (auto& one : found) threads.emplace_back([&] { one = shared.of(0.1, 200); });
    for (auto& thread : threads) thread.join();
  }
  for (const auto* states : found) EXPECT_EQ(states, found[0]);
  EXPECT_EQ(reference->samples, 1);
  ASSERT_EQ(found[0]->t.size(), 201u);
  EXPECT_EQ(found[0]->t[3], 3 * 0.1);
  EXPECT_EQ(found[0]->t.back(), reference->end());
  EXPECT_NE(shared.of(0.05, 400), found[0]);
  EXPECT_EQ(reference->samples, 2);
}

TEST(SharedStates, EndWithTheMotionWhateverTheStepsRoundTo) {
  const auto reference = std::make_shared<ToyMotion>();
  SharedStates shared(reference, 0.0);
  int rounded = 0;
  for (int steps = 1; steps < 200; ++steps) {
    const double h = reference->end() / steps;
    rounded += h * steps != reference->end();
    EXPECT_EQ(shared.of(h, steps)->t.back(), reference->end());
  }
  EXPECT_GT(rounded, 0);
}

TEST(SharedStates, AreKeptUpToABound) {
  SharedStates shared(std::make_shared<ToyMotion>(), 0.0);
  const auto most = static_cast<long long>(SharedStates::most_numbers / 5);
  EXPECT_EQ(shared.of(20.0 / double(most), most), nullptr);
  EXPECT_NE(shared.of(20.0 / double(most - 1000), most - 1000), nullptr);
  EXPECT_EQ(shared.of(0.01, 2000), nullptr);
  EXPECT_NE(shared.of(0.1, 200), nullptr);
}

// What a run of `count` states scores whose last one has an error.
RunScore score(const ToyMotion& reference, const GridStates* states, double h, int count) {
  ErrorSink sink(reference, toy_problem(), 0.1, {.states = states});
  std::vector<double> t, u, v;
  for (int i = 0; i < count; ++i) {
    t.push_back(std::min(i * h, reference.end()));
    const auto now = reference.at(t.back(), model::Side::right);
    u.insert(u.end(), {now.u[0], now.u[1] + 1e-3 * i});
    v.insert(v.end(), {now.v[0] + 1e-3, now.v[1]});
  }
  reference.samples = 0;
  constexpr std::size_t block = 77;
  for (std::size_t from = 0; from < t.size(); from += block) {
    const auto rows = std::min(block, t.size() - from);
    sink.take(model::SampleBlock{
        2, {&t[from], rows}, {&u[2 * from], 2 * rows}, {&v[2 * from], 2 * rows}});
  }
  const int samples = reference.samples;
  const auto score = sink.score({});
  reference.samples = samples;
  return score;
}

TEST(SharedStates, GiveTheScoresThatSamplingGives) {
  const auto reference = std::make_shared<ToyMotion>();
  SharedStates shared(reference, 0.0);
  const auto* states = shared.of(0.1, 200);
  const auto expected = score(*reference, nullptr, 0.1, 201);
  EXPECT_EQ(reference->samples, 3);
  const auto found = score(*reference, states, 0.1, 201);
  EXPECT_EQ(reference->samples, 0);
  EXPECT_EQ(found.u_error, expected.u_error);
  EXPECT_EQ(found.v_error, expected.v_error);
  EXPECT_EQ(found.energy_error, expected.energy_error);
}

TEST(SharedStates, AreLeftOutAtOtherTimes) {
  const auto reference = std::make_shared<ToyMotion>();
  SharedStates shared(reference, 0.0);
  const auto* states = shared.of(0.1, 200);
  const auto expected = score(*reference, nullptr, 0.0999, 201);
  const auto found = score(*reference, states, 0.0999, 201);
  EXPECT_EQ(reference->samples, 3);
  EXPECT_EQ(found.u_error, expected.u_error);
  EXPECT_EQ(found.v_error, expected.v_error);
  score(*reference, states, 0.1, 250);  // more times than there are
  EXPECT_EQ(reference->samples, 2);
}

// Errors of some rounding errors of a run of 9000 steps, so that every last bit of the reference counts, taken in
// blocks of `rows`.
RunScore rounding_score(const exact::SynchronizedPair& motion, ErrorSinkOptions options,
                        std::size_t rows, double stretch = 1.0) {
  constexpr std::size_t steps = 9000;
  const double h = motion.end() / double(steps);
  ErrorSink sink(motion, motion.problem(), stretch * h, options);
  for (std::size_t first = 0; first <= steps; first += rows) {
    std::vector<double> t, u, v;
    for (auto k = first; k < first + rows && k <= steps; ++k) {
      t.push_back(k == steps ? motion.end() : double(k) * h);
      const auto now = motion.at(t.back(), model::Side::right);
      u.insert(u.end(), now.u.begin(), now.u.end());
      v.insert(v.end(), now.v.begin(), now.v.end());
    }
    sink.take(model::SampleBlock{2, t, u, v});
  }
  return sink.score({});
}

TEST(SharedStates, ThatDoNotFitAreTheSameBitsInBlocksOfAnySize) {
  const exact::SynchronizedPair motion({.xi1 = 0.01, .t_end = 90.0});
  SharedStates shared(std::make_shared<exact::SynchronizedPair>(motion), 0.0);
  const auto expected =
      rounding_score(motion, {.states = shared.of(motion.end() / 9000, 9000)}, 264);
  const auto alone = rounding_score(motion, {}, 264);
  EXPECT_EQ(alone.u_error, 0.0);
  EXPECT_GT(expected.u_error, 0.0);
  for (const std::size_t rows : {1u, 77u, 264u}) {
    const auto found = rounding_score(motion, {.steps = 9000}, rows);
    EXPECT_EQ(found.u_error, expected.u_error);
    EXPECT_NEAR(found.v_error, expected.v_error, 1e-14 * expected.v_error) << "summed in blocks";
  }
}

TEST(SharedStates, OfOtherStepsThanExpectedAreSampled) {
  const exact::SynchronizedPair motion({.xi1 = 0.01, .t_end = 90.0});
  EXPECT_EQ(rounding_score(motion, {.steps = 9000}, 264, 1.0 + 1e-15).u_error, 0.0);
  for (const long long steps : {1, 8191, 8999, 9001})
    EXPECT_LT(rounding_score(motion, {.steps = steps}, 77).u_error, 3e-16) << steps;
}

}  // namespace
}  // namespace clackers::measure
