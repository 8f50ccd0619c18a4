#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/sampling.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/numerics/testing/forced_target.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using namespace testing_oracle;
using Numbers = std::vector<double>;

// u, v and a, one after another.
Numbers sampled(const ClosedForm& motion, std::span<const double> times, Side side) {
  const auto size = times.size() * std::size_t(motion.dof());
  Numbers all(3 * size);
  const std::span<double> part(all);
  motion.sample(times, side, {part.first(size), part.subspan(size, size), part.subspan(2 * size)});
  return all;
}

Numbers one_by_one(const ClosedForm& motion, std::span<const double> times, Side side) {
  const auto n = std::size_t(motion.dof()), size = times.size() * n;
  Numbers all(3 * size);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto now = sampled(motion, times.subspan(i, 1), side);
    for (std::size_t part = 0; part < 3; ++part)
      std::copy_n(&now[part * n], n, &all[part * size + i * n]);
  }
  return all;
}

bool same_numbers(const Numbers& x, const Numbers& y) {
  return std::ranges::equal(
      x, y, {}, [](double a) { return std::bit_cast<std::uint64_t>(a); },
      [](double b) { return std::bit_cast<std::uint64_t>(b); });
}

// start + k step, as they are rounded.
Numbers grid(double start, double step, std::size_t count) {
  Numbers t(count);
  for (std::size_t k = 0; k < count; ++k) t[k] = start + double(k) * step;
  return t;
}

// From steps of a hundredth of the fast mass' period to such of several flights; some without rounding.
Numbers random_grid(Box& box, const ClosedForm& motion) {
  const auto& masses = motion.flight().masses;
  const std::size_t count = least_equidistant + std::size_t(box.uniform(0.0, 300.0));
  const double flight = motion.flight().period.hi;
  double fastest = 1.0;
  for (const auto& mass : masses) fastest = std::max(fastest, mass.multiple);
  double step =
      box.one_in(4) ? flight * box.uniform(0.01, 4.0) : flight / fastest * box.decades(-2.0, 1.0);
  step = std::min(step, 0.999 * motion.end() / double(count));
  const double last = motion.end() - double(count) * step;
  double start =
      box.one_in(3) ? 0.0 : last * (box.one_in(2) ? box.decades(-9.0, 0.0) : box.uniform(0.0, 1.0));
  if (box.one_in(3)) {
    step = std::exp2(std::floor(std::log2(step)));
    start = std::floor(start / step) * step;
  }
  return grid(start, step, count);
}

struct Tried {
  int grids = 0, states = 0, taken = 0;
};

// How many states the steps of a table gave; all against the oracle, within the bound.
void expect_true(const ClosedForm& motion, const Oracle& oracle, const Numbers& times,
                 Tried& tried) {
  const auto n = std::size_t(motion.dof()), size = times.size() * n;
  const auto found = sampled(motion, times, Side::right);
  StepTable table;
  if (tabulate_steps(motion.flight(), times, table)) {
    ++tried.grids;
    Numbers u(size), v(size);
    std::uint64_t left_out[most_anchors];
    sample_steps(motion.flight(), table, times.data(), 5, u.data(), v.data(), nullptr, left_out);
    for (const auto bits : std::span(left_out).first(5)) tried.taken += std::popcount(~bits);
    tried.states += 320;
  }
  EXPECT_TRUE(std::ranges::none_of(found, [](double x) { return x == 0.0 && std::signbit(x); }));
  for (std::size_t i = 0; i < times.size(); i += times.size() / 61) {
    const auto expected = oracle.state(times[i], Side::right);
    const auto bound = motion.error_bound(times[i]);
    for (std::size_t m = 0; m < n; ++m) {
      const auto at = Eigen::Index(m);
      const auto* x = &found[i * n + m];
      EXPECT_LE(abs(expected.u[m] - Real(x[0])), Real(bound.u[at])) << times[i];
      EXPECT_LE(abs(expected.v[m] - Real(x[size])), Real(bound.v[at])) << times[i];
      EXPECT_LE(abs(expected.a[m] - Real(x[2 * size])), Real(bound.a[at])) << times[i];
    }
  }
}

class StepSampling : public testing::TestWithParam<numerics::simd::Target> {
 protected:
  numerics::simd::ForcedTarget forced_{GetParam()};
};

TEST_P(StepSampling, IsTrueToTheBoundOverTheWholeBox) {
  constexpr unsigned seed = 20261130;
  Box box(seed);
  Tried tried;
  for (int i = 0; i < trials(60) && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i);
    const auto p = box.pair();
    const SynchronizedPair motion(p);
    expect_true(motion, oracle_of(p), random_grid(box, motion), tried);
    const FreeMassParameters q{box.damping_ratio(), box.decades(1.0, 8.0)};
    const FreeMass free(q);
    expect_true(free, oracle_of(q), random_grid(box, free), tried);
    const RigidStopParameters s{box.damping_ratio(), box.restitution(), box.decades(1.0, 8.0)};
    const RigidStop stop(s);
    expect_true(stop, oracle_of(s), random_grid(box, stop), tried);
  }
  // Others decay too fast, come to rest, or have times that are rounded too far.
  EXPECT_GT(tried.grids, trials(60));
  EXPECT_GT(tried.taken, tried.states / 2);
}

TEST_P(StepSampling, HoldsForLargeRatiosAndLongTimes) {
  Tried tried;
  for (const double X : {1.0, 401.0, 400001.0, 999999999.0, 1.0 / 3.0, 1.0 / 400001.0})
    for (const double xi1 : {0.0, 1e-9, 0.05})
      for (const double step : {0x1p-33, 0x1p-20, 0x1p-7, 0.3, 1.0, 4.0})
        for (const double start : {0.0, 3.0, 0x1p29}) {
          const PairParameters p{
              .xi1 = xi1, .X = X, .r = X < 1.0 ? 1.0 : 0.5, .eta = 0.99, .t_end = 1e9};
          expect_true(SynchronizedPair(p), oracle_of(p), grid(start, step, 321), tried);
        }
  EXPECT_GT(tried.grids, 150);
  EXPECT_GT(tried.taken, tried.states / 2);
}

// E falls below all normal numbers and then to 0.
TEST_P(StepSampling, HoldsUntilTheMotionHasDecayed) {
  const PairParameters p{.xi1 = 0.05, .A = 1e-60, .X = 3.0, .r = 0.5, .t_end = 20000.0};
  Tried tried;
  expect_true(SynchronizedPair(p), oracle_of(p), grid(0.0, 0.25, 80000), tried);
  EXPECT_EQ(tried.grids, 1);
}

TEST_P(StepSampling, GivesTheSameBitsOnEveryProcessor) {
  Box box(20261201);
  for (int i = 0; i < trials(30); ++i) {
    const SynchronizedPair motion(box.pair());
    const auto times = random_grid(box, motion);
    const auto found = sampled(motion, times, Side::left);
    Numbers expected;
    {
      const numerics::simd::ForcedTarget slowest(numerics::simd::available_targets().back());
      expected = sampled(motion, times, Side::left);
    }
    const numerics::simd::ForcedTarget again(GetParam());
    ASSERT_TRUE(same_numbers(found, expected)) << i;
    Numbers u(2 * times.size()), v(u);
    motion.sample(times, Side::left, {u, v, {}});
    ASSERT_TRUE(std::ranges::equal(u, std::span(found).first(u.size()))) << "without accelerations";
    ASSERT_TRUE(std::ranges::equal(v, std::span(found).subspan(u.size(), v.size())));
  }
}

TEST_P(StepSampling, LeavesTimesBesideImpactsToBeEvaluatedAlone) {
  const SynchronizedPair motion({.xi1 = 0.01, .eta = 0.9, .t_end = 4000.0});
  int hits = 0;
  for (int parts = 64; parts < 200; ++parts) {
    const double hit = motion.impact(40).t;
    const auto times = grid(0.0, hit / parts, 400);
    StepTable table;
    ASSERT_TRUE(tabulate_steps(motion.flight(), times, table));
    for (const auto side : {Side::left, Side::right}) {
      const auto found = sampled(motion, times, side), alone = one_by_one(motion, times, side);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const auto t = motion.impact(std::max(1LL, motion.impact_count(times[i]))).t;
        const bool is_beside = std::abs(times[i] - t) <= 4e-16 * t;
        hits += times[i] == t;
        for (std::size_t m = 2 * i; m < 2 * i + 2; ++m)
          for (std::size_t x = m; x < found.size(); x += 2 * times.size()) {
            EXPECT_TRUE(!is_beside || found[x] == alone[x]) << parts << " " << i;
            EXPECT_EQ(std::signbit(found[x]), std::signbit(alone[x])) << parts << " " << i;
          }
      }
    }
  }
  EXPECT_GT(hits, 100);
}

TEST_P(StepSampling, TakesNoOtherTimes) {
  const SynchronizedPair motion({.t_end = 1e3});
  const auto& c = motion.flight();
  StepTable table;
  auto times = grid(0.0, 0.01, least_equidistant);
  EXPECT_TRUE(tabulate_steps(c, times, table));
  EXPECT_FALSE(tabulate_steps(c, std::span(times).first(least_equidistant - 1), table));
  EXPECT_FALSE(tabulate_steps(c, grid(0.0, 3.0, 400), table)) << "decays too fast";
  EXPECT_FALSE(tabulate_steps(c, grid(1.0, -1e-3, 400), table));
  EXPECT_FALSE(tabulate_steps(c, grid(0.0, 0.0, 400), table));
  EXPECT_FALSE(tabulate_steps(SynchronizedPair({.eta = 0.0}).flight(), times, table));
  for (const auto k : {64u, 257u, 319u}) {
    auto moved = times;
    moved[k] += 1e-6;
    EXPECT_FALSE(tabulate_steps(c, moved, table)) << k;
  }
  ASSERT_TRUE(tabulate_steps(c, times, table));
  times[70] += 2e-10;
  times[80] += 1e-12;  // corrected
  times[90] = NAN;
  Numbers u(640), v(640);
  std::uint64_t left_out[most_anchors];
  sample_steps(c, table, times.data(), 2, u.data(), v.data(), nullptr, left_out);
  EXPECT_EQ(left_out[0], 0u);
  EXPECT_EQ(left_out[1], std::uint64_t(1) << 6 | std::uint64_t(1) << 26);
  times[90] = 0.9;
  EXPECT_TRUE(same_numbers(sampled(motion, std::span(times).subspan(70, 11), Side::left),
                           one_by_one(motion, std::span(times).subspan(70, 11), Side::left)));
}

TEST_P(StepSampling, RefusesATimeOutsideWhereverItStands) {
  const SynchronizedPair motion({.t_end = 20.0});
  for (const double bad : {-1e-300, 20.000001, double(NAN), double(INFINITY)})
    for (const std::size_t at : {0u, 3u, 64u, 399u}) {
      auto times = grid(0.0, 0.05, 400);
      times[at] = bad;
      EXPECT_THROW(sampled(motion, times, Side::left), InputError) << bad << " " << at;
    }
  auto times = grid(0.0, 1e-15, 400);
  times[5] = -1e-16;
  EXPECT_THROW(sampled(motion, times, Side::left), InputError);
  // In its place, but a little too late.
  EXPECT_THROW(sampled(motion, grid(0.0, 20.0 * (1.0 + 0x1p-45) / 447.0, 448), Side::left),
               InputError);
}

INSTANTIATE_TEST_SUITE_P(, StepSampling, testing::ValuesIn(numerics::simd::available_targets()),
                         [](const auto& target) { return std::string(target.param.name()); });

}  // namespace
}  // namespace clackers::exact
