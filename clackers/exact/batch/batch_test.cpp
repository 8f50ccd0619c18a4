#include "clackers/exact/batch/batch.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/frequency_ratio.hpp"
#include "clackers/exact/pair/single_mass.hpp"
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

// The largest error of a batch at these times.
double worst_units(const PairBatch& batch, const std::vector<double>& times, Side side,
                   const Target& target) {
  const ForcedTarget forced(target);
  Arrays found(times.size());
  EXPECT_EQ(batch.sample(times, side, found.buffers()), target);
  double worst = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto phase = flight_phase(batch.flight(), times[i], side);
    const auto reference = unrounded_state(batch.flight(), {times[i], 0.0}, phase);
    worst = std::max(worst, units(found.at(i), reference));
  }
  return worst;
}

std::vector<double> some_times(Box& box, double end) {
  std::vector<double> times{0.0, end, 0x1p-1074, end * 0x1p-60};
  for (int i = 0; i < 40; ++i) times.push_back(box.uniform(0.0, end));
  for (int i = 0; i < 20; ++i) times.push_back(end * box.decades(-9.0, 0.0));
  return times;
}

// The doubles from 4 below to 4 above collision k.
std::vector<double> around(const ClosedForm& motion, long long k) {
  const double t = motion.impact(k).t;
  std::vector<double> times{t};
  double below = t, above = t;
  for (int i = 0; i < 4; ++i) {
    times.push_back(below = std::nextafter(below, 0.0));
    times.push_back(above = std::nextafter(above, INFINITY));
  }
  std::erase_if(times, [&](double x) { return x > motion.end(); });
  return times;
}

TEST(PairBatch, IsWithinItsBoundOverTheWholeBoxOnEveryTarget) {
  Box box(7);
  for (int i = 0; i < trials(120); ++i) {
    const auto p = box.pair(i % 2 == 0 ? 8.0 : 50.0);
    SCOPED_TRACE(testing::Message() << "seed 7, member " << i << ", X " << p.X << ", xi1 " << p.xi1
                                    << ", eta " << p.eta << ", t_end " << p.t_end);
    const SynchronizedPair reference(p);
    const PairBatch batch(reference.flight());
    // In a damped motion most of [0, end] has decayed to zero.
    const double visible = 1500.0 / (reference.flight().decay.hi + 1e-300);
    auto times = some_times(box, p.t_end);
    for (const double t : some_times(box, std::min(visible, p.t_end))) times.push_back(t);
    for (const auto& target : available_targets())
      EXPECT_LE(worst_units(batch, times, Side::right, target), bound_at_times(p.eta))
          << target.name();
  }
}

TEST(PairBatch, KeepsItsBoundUpToTheLargestRatio) {
  // A whole number of 30 bits: halves of 26 bits, of which a product consists without FMA, are not
  // enough for it. Phases need the long sums from the second end on.
  Box box(10);
  for (const double end : {1e4, 1e7})
    for (const double X : {largest_ratio - 1.0, 1.0 / (largest_ratio - 1.0)}) {
      const SynchronizedPair reference(
          {.xi1 = 1e-8, .X = X, .r = X > 1.0 ? 0.5 : 2.0, .t_end = X > 1.0 ? end : end * 1e9});
      const PairBatch batch(reference.flight());
      const auto times = some_times(box, reference.end());
      const UniformGrid grid{0.0, reference.end() / 1000.0, 1000};
      for (const auto& target : available_targets()) {
        EXPECT_LE(worst_units(batch, times, Side::right, target), bound_at_times(1.0))
            << target.name() << ", X " << X << ", end " << end;
        const ForcedTarget forced(target);
        Arrays found(grid.count);
        batch.sample(grid, found.buffers());
        for (std::size_t i = 0; i < grid.count; ++i) {
          const auto t = instant(grid, double(i));
          const auto phase = flight_phase(batch.flight(), t);
          ASSERT_LE(units(found.at(i), unrounded_state(batch.flight(), t, phase)), bound_on_grids)
              << target.name() << ", X " << X << ", sample " << i;
        }
      }
    }
}

TEST(PairBatch, TakesTheTrueFlightAtTheDoublesNextToCollisions) {
  Box box(8);
  for (int i = 0; i < trials(120); ++i) {
    const auto p = box.pair(4.0);
    SCOPED_TRACE(testing::Message() << "seed 8, member " << i << ", X " << p.X << ", xi1 " << p.xi1
                                    << ", eta " << p.eta << ", t_end " << p.t_end);
    const SynchronizedPair reference(p);
    const PairBatch batch(reference.flight());
    const auto count = reference.impact_count(reference.end());
    if (count == 0) continue;
    std::vector<double> times;
    for (const double share : {0.0, 1e-7, box.uniform(0.0, 1.0), 1.0})
      for (const double t :
           around(reference, 1 + static_cast<long long>(share * double(count - 1))))
        times.push_back(t);
    for (const long long k : {2, 3, 50})
      if (k <= count)
        for (const double t : around(reference, k)) times.push_back(t);
    for (const auto& target : available_targets())
      for (const auto side : {Side::left, Side::right})
        EXPECT_LE(worst_units(batch, times, side, target), bound_at_times(p.eta)) << target.name();
  }
}

TEST(PairBatch, AgreesWithTheOracleOfManyDigits) {
  Box box(9);
  for (int i = 0; i < trials(12); ++i) {
    const auto p = box.pair(4.0);
    SCOPED_TRACE(testing::Message() << "seed 9, member " << i);
    const SynchronizedPair reference(p);
    const auto oracle = oracle_of(p);
    const PairBatch batch(reference.flight());
    std::vector<double> times{0.0, box.uniform(0.0, p.t_end), box.uniform(0.0, 1e-6 * p.t_end)};
    if (reference.impact_count(reference.end()) > 0)
      for (const double t : around(reference, 1)) times.push_back(t);
    for (const auto& target : available_targets()) {
      const ForcedTarget forced(target);
      Arrays found(times.size());
      batch.sample(times, Side::left, found.buffers());
      for (std::size_t k = 0; k < times.size(); ++k) {
        const auto s = oracle.state(times[k], Side::left);
        const Real value[4] = {s.u[0], s.u[1], s.v[0], s.v[1]};
        const Real envelope[4] = {s.u_env[0], s.u_env[1], s.v_env[0], s.v_env[1]};
        for (std::size_t c = 0; c < 4; ++c)
          EXPECT_TRUE(abs(value[c] - Real(found.at(k)[c])) <=
                      ldexp(Real(bound_at_times(p.eta)) * envelope[c], -52) + Real(0x1p-1073))
              << target.name() << ", t " << times[k] << ", component " << c;
      }
    }
  }
}

TEST(PairBatch, FallsToTheSubnormalNumbersAndZeroBeyondXiTOf708) {
  // The second pair decays to subnormal displacements while its velocities are ordinary numbers:
  // a flight must not be read off the displacement.
  const PairParameters slow{.xi1 = 0.5, .X = 9.0, .t_end = 8000.0};
  const PairParameters fast{.k1 = 1e60, .xi1 = 0.5, .A = 1e-55, .X = 9.0, .t_end = 8e-27};
  for (const auto& p : {slow, fast})
    for (const double eta : {1.0, 0.99}) {
      auto q = p;
      q.eta = eta;
      const SynchronizedPair reference(q);
      const PairBatch batch(reference.flight());
      const double rate = reference.flight().decay.hi * 0.6931471805599453;
      std::vector<double> times;
      for (int i = 0; i < 3000; ++i) times.push_back((500.0 + 0.1 * i) / rate);
      for (const double x : {800.0, 1000.0, 2000.0, 2828.0, 2829.0, 3999.0})
        times.push_back(x / rate);
      for (const auto& target : available_targets()) {
        EXPECT_LE(worst_units(batch, times, Side::right, target), bound_at_times(eta))
            << target.name() << ", k1 " << p.k1;
        const ForcedTarget forced(target);
        Arrays last(1);
        batch.sample(std::vector{reference.end()}, Side::right, last.buffers());
        for (const double x : last.at(0)) EXPECT_EQ(std::abs(x), 0.0);
      }
    }
}

TEST(PairBatch, WritesWhatIsAskedForAndNothingElseForEverySizeAndPlace) {
  const SynchronizedPair reference({.X = 81.0, .r = 0.5, .eta = 0.9, .t_end = 100.0});
  const PairBatch batch(reference.flight());
  std::vector<double> times(80);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 100.0 - 1.2345 * double(i);
  for (const auto& target : available_targets()) {
    const ForcedTarget forced(target);
    Arrays all(80);
    for (std::size_t i = 0; i < 80; ++i) {
      const auto b = all.buffers();
      batch.sample(
          {&times[i], 1}, Side::right,
          {b.u1.subspan(i, 1), b.u2.subspan(i, 1), b.v1.subspan(i, 1), b.v2.subspan(i, 1)});
    }
    for (std::size_t size = 0; size <= 70; ++size) {
      const std::size_t from = size % 9;
      Arrays some(size, 8 + size % 8);
      EXPECT_EQ(batch.sample({times.data() + from, size}, Side::right, some.buffers()), target);
      EXPECT_TRUE(some.margins_are_untouched()) << target.name() << ", size " << size;
      for (std::size_t i = 0; i < size; ++i)
        ASSERT_EQ(some.at(i), all.at(from + i)) << target.name() << ", size " << size;
    }
  }
}

TEST(PairBatch, RefusesTimesOutsideTheMotionWhereverTheyStand) {
  const SynchronizedPair reference({.t_end = 20.0});
  const PairBatch batch(reference.flight());
  for (const auto& target : available_targets()) {
    const ForcedTarget forced(target);
    for (const double bad :
         {-0x1p-1074, -1.0, std::nextafter(20.0, 21.0), 1e300, double(INFINITY), double(NAN)})
      for (std::size_t at = 0; at < 19; ++at) {
        std::vector<double> times(19, 3.0);
        times[at] = bad;
        Arrays out(19);
        try {
          batch.sample(times, Side::right, out.buffers());
          FAIL() << target.name() << " took " << bad << " at " << at;
        } catch (const InputError& e) {
          EXPECT_EQ(e.code().name(), std::isnan(bad)   ? "not-a-number"
                                     : std::isinf(bad) ? "not-finite"
                                                       : "time-outside");
        }
      }
  }
}

TEST(PairBatch, RefusesArraysOfUnequalSizeAndMotionsOfOneMass) {
  const PairBatch batch(SynchronizedPair({}).flight());
  const std::vector<double> times(5, 1.0);
  for (int wrong = 0; wrong < 4; ++wrong) {
    Arrays out(5);
    auto b = out.buffers();
    auto& part = wrong == 0 ? b.u1 : wrong == 1 ? b.u2 : wrong == 2 ? b.v1 : b.v2;
    part = part.first(4);
    EXPECT_THROW(batch.sample(times, Side::right, b), InputError) << wrong;
    EXPECT_THROW(batch.sample(UniformGrid{0.0, 1.0, 5}, b), InputError) << wrong;
  }
  EXPECT_THROW(PairBatch(RigidStop({}).flight()), InputError);
  EXPECT_THROW(PairBatch(FreeMass({}).flight()), InputError);
}

TEST(PairBatch, IsSharedByThreads) {
  const SynchronizedPair reference({.xi1 = 1e-4, .X = 401.0, .t_end = 1000.0});
  const PairBatch batch(reference.flight());
  constexpr std::size_t count = 3000;
  const UniformGrid grid{1.0, 0.3, count};
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = 0.31 * double(i);
  Arrays alone(count), alone_grid(count);
  batch.sample(times, Side::right, alone.buffers());
  batch.sample(grid, alone_grid.buffers());
  std::vector<std::thread> threads;
  std::array<bool, 4> equal{};
  for (std::size_t n = 0; n < equal.size(); ++n)
    threads.emplace_back([&, n] {
      Arrays own(count), own_grid(count);
      batch.sample(times, Side::right, own.buffers());
      batch.sample(grid, own_grid.buffers());
      equal[n] = true;
      for (std::size_t i = 0; i < count; ++i)
        if (own.at(i) != alone.at(i) || own_grid.at(i) != alone_grid.at(i)) equal[n] = false;
    });
  for (auto& each : threads) each.join();
  for (const bool each : equal) EXPECT_TRUE(each);
}

}  // namespace
}  // namespace clackers::exact
