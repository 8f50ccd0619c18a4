// Errors that are small but all to one side: a constant without its low part is off by half a unit
// at most, which no bound on the largest error shows.

#include <gtest/gtest.h>

#include "clackers/exact/testing/test_batch.hpp"

namespace clackers::exact {
namespace {

using namespace testing_batch;

// How much too large each of u1, u2, v1, v2 is on the whole, in units of 2^-52 of itself: the factor
// that fits the errors best, E brought to its significand so that all samples weigh alike.
std::array<double, 4> gains(const PairBatch& batch, const std::vector<double>& times,
                            const Arrays& found) {
  std::array<double, 4> error{}, square{};
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto phase = flight_phase(batch.flight(), times[i], model::Side::right);
    const auto reference = unrounded_state(batch.flight(), {times[i], 0.0}, phase);
    for (std::size_t c = 0; c < 4; ++c) {
      const auto [hi, lo] = reference.value[c];
      const double off = (std::ldexp(found.at(i)[c], -reference.exponent) - hi) - lo;
      error[c] += off * 0x1p52 * hi;
      square[c] += hi * hi;
    }
  }
  for (std::size_t c = 0; c < 4; ++c) error[c] /= square[c];
  return error;
}

TEST(PairBatch, IsNotOffToOneSide) {
  // Over 4000 times roundings leave 0.5 / sqrt(4000) = 0.008 units; five times that, and 0.07 for
  // the polynomial of E, which is off to one side at each end.
  constexpr double allowed = 5 * 0.008 + 0.07;
  testing_oracle::Box box(23);
  for (const double xi1 : {0.0, 0.3, 0.99}) {
    for (int i = 0; i < 8; ++i) {
      // The motion over 6 halvings.
      const PairParameters p{.m1 = box.decades(-2.0, 2.0),
                             .k1 = box.decades(-2.0, 2.0),
                             .xi1 = xi1,
                             .A = box.decades(-2.0, 2.0),
                             .X = 9.0,
                             .r = box.uniform(0.5, 3.0),
                             .t_end = 1e5};
      const SynchronizedPair reference(p);
      const PairBatch batch(reference.flight());
      const double end = std::min(1e4, 6.0 / (reference.flight().decay.hi + 1e-300));
      std::vector<double> times(4000);
      for (auto& t : times) t = box.uniform(0.0, end);
      for (const auto& target : numerics::simd::available_targets()) {
        // Otherwise products are rounded before a low part can count.
        if (!target.has_fma()) continue;
        const ForcedTarget forced(target);
        Arrays found(times.size());
        batch.sample(times, model::Side::right, found.buffers());
        const auto off = gains(batch, times, found);
        for (std::size_t c = 0; c < 4; ++c)
          EXPECT_LE(std::abs(off[c]), allowed)
              << target.name() << ", component " << c << ", xi1 " << xi1 << ", member " << i;
      }
    }
  }
}

}  // namespace
}  // namespace clackers::exact
