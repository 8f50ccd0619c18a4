// No batch allocates: operator new is replaced for this program and counts while it is asked to.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "clackers/exact/testing/test_batch.hpp"

namespace {

thread_local bool is_counting = false;
thread_local long count = 0;

}  // namespace

// Not inlined: GCC would take the free() below for one that does not match this new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (is_counting) ++count;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace clackers::exact {
namespace {

using namespace testing_batch;

TEST(PairBatch, AllocatesNothingOnceItStands) {
  for (const double eta : {1.0, 0.9, 0.0}) {
    const PairBatch batch(SynchronizedPair({.xi1 = 0.1, .eta = eta, .t_end = 9000.0}).flight());
    std::vector<double> times(1000);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = 9.0 * double(i);
    times[7] = 1.5707963267948966;
    const UniformGrid grid{0.1, 8.9, 1000};
    Arrays out(1000);
    const auto buffers = out.buffers();
    const auto values = out.values();
    for (const auto& target : numerics::simd::available_targets()) {
      const ForcedTarget forced(target);
      is_counting = true;
      count = 0;
      batch.sample(times, model::Side::left, buffers);
      batch.sample(grid, buffers);
      batch.errors(grid, values);
      batch.norms(grid);
      is_counting = false;
      EXPECT_EQ(count, 0) << target.name() << ", eta " << eta;
    }
  }
  is_counting = true;
  count = 0;
  void* const one = ::operator new(8);  // a new-expression might be left out
  is_counting = false;
  ::operator delete(one);
  EXPECT_EQ(count, 1) << "the counter itself";
}

}  // namespace
}  // namespace clackers::exact
