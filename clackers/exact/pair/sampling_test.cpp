#include "clackers/exact/pair/sampling.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <new>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/numerics/testing/forced_target.hpp"

namespace {

thread_local bool is_counting = false;
thread_local long allocations = 0;

}  // namespace

// Not inlined: GCC would take the free() below for one that does not match this new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (is_counting) ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace clackers::exact {
namespace {

using model::Side;
using namespace testing_oracle;

struct States {
  std::vector<double> u, v, a;
  explicit States(std::size_t size) : u(size), v(size), a(size) {}
  model::SampleBuffers buffers() { return {u, v, a}; }
};

bool same_bits(const std::vector<double>& x, const std::vector<double>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  });
}

// Many times at once against one at a time, which closed_form_test.cpp compares with the oracle.
void expect_bits_of_single_times(const ClosedForm& motion, const std::vector<double>& times) {
  const auto n = std::size_t(motion.dof());
  for (const auto side : {Side::left, Side::right}) {
    States many(times.size() * n), one(times.size() * n);
    motion.sample(times, side, many.buffers());
    for (std::size_t i = 0; i < times.size(); ++i)
      motion.sample({&times[i], 1}, side,
                    {{&one.u[i * n], n}, {&one.v[i * n], n}, {&one.a[i * n], n}});
    EXPECT_TRUE(same_bits(many.u, one.u) && same_bits(many.v, one.v) && same_bits(many.a, one.a));
    std::vector<double> u(many.u.size()), v(many.v.size());
    motion.sample(times, side, {u, v, {}});
    EXPECT_TRUE(same_bits(u, one.u) && same_bits(v, one.v)) << "without accelerations";
  }
}

std::vector<double> random_times(Box& box, const ClosedForm& motion, std::size_t count) {
  std::vector<double> times(count);
  const auto impacts = motion.impact_count(motion.end());
  for (auto& t : times) {
    t = box.one_in(3) ? motion.end() * box.decades(-9.0, 0.0) : box.uniform(0.0, motion.end());
    // Beside and at impacts.
    if (impacts > 0 && box.one_in(4)) {
      t = motion.impact(1 + static_cast<long long>(box.uniform(0.0, double(impacts)))).t;
      if (box.one_in(3)) t = std::nextafter(t, 0.0);
      if (box.one_in(3)) t = std::min(motion.end(), std::nextafter(t, INFINITY));
    }
  }
  return times;
}

class Sampling : public testing::TestWithParam<numerics::simd::Target> {
 protected:
  numerics::simd::ForcedTarget forced_{GetParam()};
};

TEST_P(Sampling, OfManyTimesGivesTheBitsOfSingleTimes) {
  constexpr unsigned seed = 20261122;
  Box box(seed);
  for (int i = 0; i < trials(60); ++i) {
    const auto p = box.pair();
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i);
    const SynchronizedPair motion(p);
    // Whole blocks, vectors that are not full, and few.
    for (const std::size_t count : {64u, 67u, 4u, 129u})
      expect_bits_of_single_times(motion, random_times(box, motion, count));
    const FreeMass free({box.damping_ratio(), box.decades(0.0, 8.0)});
    expect_bits_of_single_times(free, random_times(box, free, 70));
    const RigidStop stop({box.damping_ratio(), box.restitution(), box.decades(1.0, 8.0)});
    expect_bits_of_single_times(stop, random_times(box, stop, 70));
    if (HasFailure()) return;
  }
}

TEST_P(Sampling, IsTrueToHalfAnUlpOfTheEnvelope) {
  constexpr unsigned seed = 20261123;
  Box box(seed);
  for (int i = 0; i < trials(20); ++i) {
    const auto p = box.pair();
    const SynchronizedPair motion(p);
    const auto oracle = oracle_of(p);
    const auto times = random_times(box, motion, 64);
    States found(2 * times.size());
    motion.sample(times, Side::right, found.buffers());
    for (std::size_t j = 0; j < times.size(); ++j) {
      const auto expected = oracle.state(times[j], Side::right);
      const auto bound = motion.error_bound(times[j]);
      for (std::size_t m = 0; m < 2; ++m) {
        const auto at = Eigen::Index(m);
        EXPECT_LE(abs(expected.u[m] - Real(found.u[2 * j + m])), Real(bound.u[at]));
        EXPECT_LE(abs(expected.v[m] - Real(found.v[2 * j + m])), Real(bound.v[at]));
        EXPECT_LE(abs(expected.a[m] - Real(found.a[2 * j + m])), Real(bound.a[at]));
      }
    }
    if (HasFailure()) return;
  }
}

TEST_P(Sampling, LeavesOutOnlyWhatIsToBeEvaluatedAlone) {
  const SynchronizedPair motion({.eta = 0.9, .t_end = 1e5});
  const double hit = motion.impact(3).t;
  const std::vector<double> times{0.0, 1.0, hit, 5.0, -1.0, 13000.0, NAN, 2e5, 19.0, 90000.0};
  double u[20], v[20];
  const auto left_out = sample_block(motion.flight(), times.data(), times.size(), u, v, nullptr);
  // The impact, the times outside, and those at which E is below 2^-1000.
  EXPECT_EQ(left_out, 0b1011110100u);
  const SynchronizedPair plastic({.eta = 0.0});
  EXPECT_EQ(sample_block(plastic.flight(), times.data(), 2, u, v, nullptr), 0u);
  EXPECT_EQ(sample_block(plastic.flight(), &times[3], 1, u, v, nullptr), 1u);
}

TEST_P(Sampling, RefusesATimeOutsideWhereverItStands) {
  const SynchronizedPair motion({});
  for (const double bad : {-1e-300, 20.5, double(NAN), double(INFINITY)})
    for (const std::size_t at : {0u, 3u, 70u, 99u}) {
      std::vector<double> times(100, 1.0);
      times[at] = bad;
      States out(200);
      EXPECT_THROW(motion.sample(times, Side::left, out.buffers()), InputError) << bad << " " << at;
    }
}

TEST_P(Sampling, WritesOnlyIntoItsBuffersAndAllocatesNothing) {
  const SynchronizedPair motion({.eta = 0.9, .t_end = 9000.0});
  for (const auto& [count, step] : {std::pair{67u, 130.0}, {67u + least_equidistant, 0.1}}) {
    std::vector<double> times(count);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = step * double(i);
    times[7] = motion.impact(1).t;
    constexpr double untouched = 12345.0;
    States out(2 * count + 20);
    for (auto* part : {&out.u, &out.v, &out.a}) part->assign(part->size(), untouched);
    const auto inner = [](std::vector<double>& x) {
      return std::span(x).subspan(10, x.size() - 20);
    };
    allocations = 0;
    is_counting = true;
    motion.sample(times, Side::right, {inner(out.u), inner(out.v), inner(out.a)});
    is_counting = false;
    EXPECT_EQ(allocations, 0);
    for (const auto* part : {&out.u, &out.v, &out.a})
      for (std::size_t i = 0; i < part->size(); ++i)
        EXPECT_EQ((*part)[i] == untouched, i < 10 || i >= part->size() - 10) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(, Sampling, testing::ValuesIn(numerics::simd::available_targets()),
                         [](const auto& target) { return std::string(target.param.name()); });

}  // namespace
}  // namespace clackers::exact
