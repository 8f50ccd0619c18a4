#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "clackers/judge/convergence/ladder_fit.hpp"
#include "clackers/judge/testing/random_ladder.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;

constexpr int intervals = 1000, most_ladders = 5000;

struct Coverage {
  int ladders = 0, given = 0, covered = 0;
  double share() const { return double(covered) / given; }
};

/// Draws ladders until a thousand of them were given an order with its interval, or five thousand
/// were drawn.
Coverage coverage(const RandomKind& kind) {
  Random random(20251122);
  Coverage found;
  while (found.given < intervals && found.ladders < most_ladders) {
    const auto drawn = kind.draw(random);
    const auto fit = fit_ladder(drawn.levels, {});
    ++found.ladders;
    if (!fit.has_line) continue;
    ++found.given;
    found.covered += std::abs(fit.order - drawn.order) <= fit.spread;
  }
  return found;
}

class IntervalCoverage : public testing::TestWithParam<RandomKind> {};

// n intervals of which 5 in 100 miss leave the share a deviation of sqrt(0.05 * 0.95 / n); three of
// them are allowed.
TEST_P(IntervalCoverage, NinetyFiveInAHundredIntervalsHoldTheOrder) {
  const auto found = coverage(GetParam());
  RecordProperty("coverage", std::to_string(found.share()));
  std::printf("%-34s %5d ladders, %5d with an order, coverage %.3f\n", GetParam().name.data(),
              found.ladders, found.given, found.share());
  if (10 * found.given < found.ladders) {
    // One run a level cannot tell scatter from order: the few that lie on a line do so by chance.
    EXPECT_LE(found.given - found.covered, 0.01 * found.ladders);
    return;
  }
  EXPECT_GE(found.share(), 0.95 - 3.0 * std::sqrt(0.05 * 0.95 / found.given));
}

INSTANTIATE_TEST_SUITE_P(Slow, IntervalCoverage, testing::ValuesIn(random_kinds()),
                         [](const testing::TestParamInfo<RandomKind>& row) {
                           std::string name;
                           for (const char c : row.param.name)
                             if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
                           return name;
                         });

TEST(IntervalCoverage, ACleanLineOfOrderTwoIsKnownToATwentieth) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const auto fit = fit_ladder(
        ladder([&](double h) { return h * h * std::pow(1.03, uniform(random, -1.0, 1.0)); }), {});
    EXPECT_LE(fit.spread, 0.05) << i;
    EXPECT_NEAR(fit.order, 2.0, fit.spread + 0.01) << i;
  }
}

}  // namespace
}  // namespace clackers::judge
