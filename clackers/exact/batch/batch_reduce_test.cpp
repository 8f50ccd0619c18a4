#include <gtest/gtest.h>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_batch.hpp"

namespace clackers::exact {
namespace {

using numerics::simd::available_targets;
using namespace testing_batch;

std::array<double, 4> list(const PairState& s) { return {s.u1, s.u2, s.v1, s.v2}; }

struct Problem {
  PairParameters pair;
  UniformGrid grid;
};

// Blocks alone; a part of one; collisions on the grid; eta < 1; exchanged masses; decay past zero.
std::vector<Problem> problems() {
  return {{{.xi1 = 0.01, .X = 81.0, .t_end = 400.0}, {0.0, 0.05, 6400}},
          {{.xi1 = 0.01, .X = 81.0, .t_end = 400.0}, {1.0, 0.05, 1037}},
          {{.xi1 = 0.0, .X = 9.0, .t_end = 4000.0}, {1.5707963267948966, 3.141592653589793, 1000}},
          {{.xi1 = 0.01, .X = 9.0, .eta = 0.8, .t_end = 400.0}, {0.0, 0.05, 777}},
          {{.xi1 = 0.01, .X = 1.0 / 9.0, .r = 0.5, .t_end = 400.0}, {0.0, 0.05, 777}},
          {{.xi1 = 0.5, .X = 9.0, .t_end = 4000.0}, {0.0, 1.0, 3999}}};
}

// A block of 64 squares, sums over blocks and lanes, and the squares themselves are rounded.
double sum_tolerance(std::size_t count) { return (double(count) / 64.0 + 100.0) * 0x1p-53; }

TEST(Reduction, IsTheLargestAndTheSumOfSquaresOfWhatSamplingStores) {
  for (const auto& [pair, grid] : problems())
    for (const auto& target : available_targets()) {
      SCOPED_TRACE(testing::Message() << target.name() << ", X " << pair.X << ", eta " << pair.eta
                                      << ", count " << grid.count);
      const ForcedTarget forced(target);
      const PairBatch batch(SynchronizedPair(pair).flight());
      Arrays stored(grid.count);
      batch.sample(grid, stored.buffers());
      const auto found = batch.norms(grid);
      EXPECT_EQ(found.ran, target);
      for (std::size_t c = 0; c < 4; ++c) {
        double largest = 0.0;
        long double squares = 0.0L;
        for (std::size_t i = 0; i < grid.count; ++i) {
          const double x = stored.at(i)[c];
          largest = std::max(largest, std::abs(x));
          squares += static_cast<long double>(x) * x;
        }
        EXPECT_EQ(list(found.largest)[c], largest) << "component " << c;
        EXPECT_NEAR(list(found.squares)[c], double(squares),
                    sum_tolerance(grid.count) * double(squares));
      }
    }
}

TEST(Reduction, OfErrorsSeesEachPlaceAndComponent) {
  for (const auto& [pair, grid] : problems())
    for (const auto& target : available_targets()) {
      SCOPED_TRACE(testing::Message() << target.name() << ", X " << pair.X << ", eta " << pair.eta
                                      << ", count " << grid.count);
      const ForcedTarget forced(target);
      const PairBatch batch(SynchronizedPair(pair).flight());
      Arrays given(grid.count);
      batch.sample(grid, given.buffers());
      const auto nothing = batch.errors(grid, given.values());
      EXPECT_EQ(nothing.ran, target);
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(list(nothing.largest)[c], 0.0);
        EXPECT_EQ(list(nothing.squares)[c], 0.0);
      }
      for (const std::size_t at :
           {std::size_t(0), std::size_t(1), std::size_t(63), grid.count / 2, grid.count - 1})
        for (std::size_t c = 0; c < 4; ++c) {
          const auto b = given.buffers();
          double& place = (c == 0 ? b.u1 : c == 1 ? b.u2 : c == 2 ? b.v1 : b.v2)[at];
          const double right = place;
          place = right + 512.0;
          const auto one = batch.errors(grid, given.values());
          place = NAN;
          const auto nan = batch.errors(grid, given.values());
          place = right;
          for (std::size_t k = 0; k < 4; ++k) {
            // The sum of 512 and a value below 512 is rounded to 2^-44.
            EXPECT_NEAR(list(one.largest)[k], k == c ? 512.0 : 0.0, 0x1p-43);
            EXPECT_NEAR(list(one.squares)[k], k == c ? 512.0 * 512.0 : 0.0, 0x1p-32);
            EXPECT_EQ(std::isnan(list(nan.largest)[k]), k == c);
            EXPECT_EQ(std::isnan(list(nan.squares)[k]), k == c);
          }
        }
    }
}

TEST(Reduction, OfNothingIsZero) {
  const PairBatch batch(SynchronizedPair({}).flight());
  const auto found = batch.norms({0.0, 1.0, 0});
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(list(found.largest)[c], 0.0);
    EXPECT_EQ(list(found.squares)[c], 0.0);
  }
}

}  // namespace
}  // namespace clackers::exact
