#include <gtest/gtest.h>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_batch.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using numerics::simd::available_targets;
using namespace testing_batch;
using testing_oracle::Box;
using testing_oracle::oracle_of;
using testing_oracle::Real;
using testing_oracle::trials;

// The largest error of a grid, every `stride`-th sample and the first and last ones.
double worst_units(const PairBatch& batch, const UniformGrid& grid, Arrays& found,
                   const Target& target, std::size_t stride = 1) {
  const ForcedTarget forced(target);
  EXPECT_EQ(batch.sample(grid, found.buffers()), target);
  double worst = 0.0;
  for (std::size_t i = 0; i < grid.count; ++i) {
    if (i % stride != 0 && i > 200 && i + 200 < grid.count) continue;
    const auto t = instant(grid, double(i));
    const auto reference = unrounded_state(batch.flight(), t, flight_phase(batch.flight(), t));
    worst = std::max(worst, units(found.at(i), reference));
  }
  return worst;
}

double worst_units(const PairBatch& batch, const UniformGrid& grid, const Target& target) {
  Arrays found(grid.count);
  return worst_units(batch, grid, found, target);
}

// A grid whose last instant is before `end`.
UniformGrid grid_to(double start, double end, std::size_t count) {
  return {start, (end - start) / (double(count) * (1.0 + 0x1p-40)), count};
}

TEST(Grid, IsWithinItsBoundOverTheWholeBoxOnEveryTarget) {
  Box box(17);
  for (int i = 0; i < trials(100); ++i) {
    const auto p = box.pair(i % 2 == 0 ? 8.0 : 50.0);
    SCOPED_TRACE(testing::Message() << "seed 17, member " << i << ", X " << p.X << ", xi1 " << p.xi1
                                    << ", eta " << p.eta << ", t_end " << p.t_end);
    const SynchronizedPair reference(p);
    const PairBatch batch(reference.flight());
    const double visible = std::min(1200.0 / (reference.flight().decay.hi + 1e-300), p.t_end);
    const double start = box.one_in(3) ? 0.0 : box.uniform(0.0, 0.5 * visible);
    // Steps from a thousandth of a period to thousands of periods.
    const double length =
        box.one_in(2)
            ? visible - start
            : std::min(visible - start, reference.flight().period.hi * box.decades(-1.0, 3.0));
    const auto grid =
        grid_to(start, start + length, static_cast<std::size_t>(box.uniform(1.0, 400.0)));
    for (const auto& target : available_targets())
      EXPECT_LE(worst_units(batch, grid, target), bound_on_grids)
          << target.name() << ", start " << grid.start << ", step " << grid.step;
  }
}

TEST(Grid, StaysWithinItsBoundOverManyAnchors) {
  for (const double eta : {1.0, 0.999}) {
    const SynchronizedPair reference({.xi1 = 1e-5, .X = 81.0, .eta = eta, .t_end = 1e6});
    const PairBatch batch(reference.flight());
    for (const auto& target : available_targets()) {
      EXPECT_LE(worst_units(batch, {0.0, 0.01234567, 9001}, target), bound_on_grids)
          << target.name();
      EXPECT_LE(worst_units(batch, {3.0, 97.123, 9001}, target), bound_on_grids) << target.name();
    }
  }
}

TEST(Grid, TakesTheTrueFlightAtInstantsBesideCollisions) {
  const SynchronizedPair reference({.xi1 = 1e-3, .X = 9.0, .t_end = 4000.0});
  const PairBatch batch(reference.flight());
  const double hit = reference.impact(1).t, period = reference.flight().period.hi;
  for (const auto& target : available_targets())
    for (const double step : {period, std::nextafter(period, 0.0), std::nextafter(period, 9.0),
                              0.5 * period, period / 64.0, std::nextafter(period / 64.0, 1.0)})
      for (const double start : {hit, std::nextafter(hit, 0.0), std::nextafter(hit, 9.0)})
        EXPECT_LE(worst_units(batch, {start, step, 1000}, target), bound_on_grids)
            << target.name() << ", step " << step << ", start " << start;
}

TEST(Grid, TakesTheTrueFlightWhereCollisionsLieWithinBlocks) {
  // There a displacement is the sum of two that are not small, and its sign may be wrong.
  Box box(18);
  for (int i = 0; i < trials(300); ++i) {
    const SynchronizedPair reference({.k1 = box.decades(-0.1, 0.1), .xi1 = 0.0, .t_end = 30.0});
    const PairBatch batch(reference.flight());
    const double step = reference.flight().period.hi / 64.0;
    const UniformGrid grid{reference.impact(1).t - 17.0 * step, step, 256};
    for (const auto& target : available_targets()) {
      const ForcedTarget forced(target);
      Arrays found(grid.count);
      batch.sample(grid, found.buffers());
      for (std::size_t k = 17; k < grid.count; k += 64) {
        const auto t = instant(grid, double(k));
        const auto state = unrounded_state(batch.flight(), t, flight_phase(batch.flight(), t));
        EXPECT_LE(units(found.at(k), state), bound_on_grids)
            << target.name() << ", seed 18, member " << i << ", sample " << k;
      }
    }
  }
}

TEST(Grid, AgreesWithTheOracleWhereItsInstantsAreDoubles) {
  Box box(19);
  for (int i = 0; i < trials(6); ++i) {
    auto p = box.pair(0.5);
    p.t_end = 1e5;
    SCOPED_TRACE(testing::Message() << "seed 19, member " << i << ", X " << p.X);
    const SynchronizedPair reference(p);
    const auto oracle = oracle_of(p);
    const PairBatch batch(reference.flight());
    const UniformGrid grid{0x1p-3, i % 2 == 0 ? 0x1.8p-5 : 0x1.68p4, 200};
    for (const auto& target : available_targets()) {
      const ForcedTarget forced(target);
      Arrays found(grid.count);
      batch.sample(grid, found.buffers());
      for (std::size_t k = 0; k < grid.count; k += 13) {
        const auto s = oracle.state(grid.start + double(k) * grid.step, Side::right);
        const Real value[4] = {s.u[0], s.u[1], s.v[0], s.v[1]};
        const Real envelope[4] = {s.u_env[0], s.u_env[1], s.v_env[0], s.v_env[1]};
        for (std::size_t c = 0; c < 4; ++c)
          EXPECT_TRUE(abs(value[c] - Real(found.at(k)[c])) <=
                      ldexp(Real(bound_on_grids) * envelope[c], -52) + Real(0x1p-1073))
              << target.name() << ", sample " << k << ", component " << c;
      }
    }
  }
}

TEST(Grid, DecaysThroughTheSubnormalNumbersToZero) {
  // The second pair has subnormal displacements and ordinary velocities.
  const PairParameters slow{.xi1 = 0.5, .X = 9.0, .t_end = 4000.0};
  const PairParameters fast{.k1 = 1e60, .xi1 = 0.5, .A = 1e-55, .X = 9.0, .t_end = 4e-27};
  for (const auto& p : {slow, fast})
    for (const double eta : {1.0, 0.99, 0.0})
      for (const auto& target : available_targets()) {
        auto q = p;
        q.eta = eta;
        const PairBatch batch(SynchronizedPair(q).flight());
        EXPECT_LE(worst_units(batch, grid_to(0.0, p.t_end, 4500), target), bound_on_grids)
            << target.name() << ", k1 " << p.k1 << ", eta " << eta;
      }
}

TEST(Grid, WritesWhatIsAskedForAndNothingElseForEverySizeAndPlace) {
  for (const double r : {0.5, 2.0}) {
    const SynchronizedPair reference(
        {.xi1 = 0.01, .X = r < 1.0 ? 81.0 : 1.0 / 81.0, .r = r, .t_end = 100.0});
    const PairBatch batch(reference.flight());
    for (const auto& target : available_targets())
      for (std::size_t size = 0; size <= 140; ++size) {
        Arrays some(size, 8 + size % 8);
        EXPECT_LE(worst_units(batch, {0.7, 0.3, size}, some, target), bound_on_grids)
            << target.name() << ", size " << size;
        EXPECT_TRUE(some.margins_are_untouched()) << target.name() << ", size " << size;
      }
  }
}

TEST(Grid, StreamsLargeOutputsWhateverTheirPlaces) {
  const SynchronizedPair reference({.xi1 = 1e-5, .X = 81.0, .t_end = 4000.0});
  const PairBatch batch(reference.flight());
  // 8 MiB, and a few samples that fill no block.
  constexpr std::size_t count = (std::size_t(1) << 18) + 67;
  const UniformGrid grid{0.5, 0.015, count};
  std::vector<double> memory(4 * (count + 64), Arrays::untouched);
  auto* base = memory.data();
  while (reinterpret_cast<std::uintptr_t>(base) % 64 != 0) ++base;
  const std::size_t apart = (count + 31) / 8 * 8;
  for (const auto& target : available_targets())
    for (const std::size_t odd : {0u, 3u, 11u}) {  // the last: one array out of line
      const ForcedTarget forced(target);
      double* to[4];
      for (std::size_t i = 0; i < 4; ++i)
        to[i] = base + i * apart + (odd < 8 ? odd : i == 2 ? 1 : 0);
      EXPECT_EQ(
          batch.sample(grid, {{to[0], count}, {to[1], count}, {to[2], count}, {to[3], count}}),
          target);
      double worst = 0.0;
      for (std::size_t i = 0; i < count; i += i < 200 || i + 300 > count ? 1 : 101) {
        const auto t = instant(grid, double(i));
        worst = std::max(
            worst, units({to[0][i], to[1][i], to[2][i], to[3][i]},
                         unrounded_state(batch.flight(), t, flight_phase(batch.flight(), t))));
      }
      EXPECT_LE(worst, bound_on_grids) << target.name() << ", place " << odd;
    }
}

TEST(Grid, RefusesWhatReachesOutsideTheMotion) {
  const PairBatch batch(SynchronizedPair({.t_end = 20.0}).flight());
  Arrays out(5);
  const auto refused = [&](const UniformGrid& grid) {
    try {
      batch.sample(grid, out.buffers());
      return std::string("taken");
    } catch (const InputError& e) {
      return std::string(e.code().name());
    }
  };
  EXPECT_EQ(refused({-0x1p-1074, 1.0, 5}), "time-outside");
  EXPECT_EQ(refused({21.0, 1.0, 5}), "time-outside");
  EXPECT_EQ(refused({NAN, 1.0, 5}), "not-a-number");
  EXPECT_EQ(refused({0.0, std::nextafter(5.0, 6.0), 5}), "time-outside");
  EXPECT_EQ(refused({0.0, 5.0, 5}), "taken");
  // 20 + 2^-60, which is 20 as a double.
  EXPECT_EQ(refused({0x1p-60, 5.0, 5}), "time-outside");
  for (const double step : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_NE(refused({0.0, step, 5}), "taken") << step;
  EXPECT_THROW(batch.norms({0.0, 6.0, 5}), InputError);
  EXPECT_THROW(batch.errors({0.0, 6.0, 5}, out.values()), InputError);
  EXPECT_THROW(batch.errors({0.0, 5.0, 4}, out.values()), InputError);
}

}  // namespace
}  // namespace clackers::exact
