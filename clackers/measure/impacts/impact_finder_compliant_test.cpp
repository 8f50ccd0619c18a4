#include <gtest/gtest.h>

#include <cmath>

#include "clackers/measure/impacts/impact_finder.hpp"
#include "clackers/measure/testing/sampled_motion.hpp"

namespace clackers::measure {
namespace {

TEST(ImpactFinder, TakesACompliantContactForOneImpactAtItsBeginning) {
  for (const double stiffness : {1e3, 1e5})
    for (const double rows : {0.7, 3.3, 20.0, 150.0})  // a contact
      for (const bool velocities : {true, false}) {
        const Penalty motion{stiffness};
        const double step = motion.contact() / rows;
        const auto found = find_impacts(sampled(motion, 10.0, step, velocities), equal_masses());
        const auto label = testing::Message() << "stiffness " << stiffness << " rows " << rows
                                              << (velocities ? " with" : " without");
        ASSERT_EQ(found.size(), 3u) << label;
        for (int k = 0; k < 3; ++k) {
          const auto& one = found[std::size_t(k)];
          EXPECT_NEAR(one.impact.t, motion.first(k), 1e-4 * motion.contact() + 1e-9) << label;
          if (rows < 2.0) continue;  // both ends lie in neighbouring steps
          EXPECT_NEAR(one.end, motion.first(k) + motion.contact(), 1e-4 * motion.contact() + 1e-9)
              << label;
          EXPECT_NEAR(one.impact.v_before[0], -1.0, 1e-4) << label;
          EXPECT_NEAR(one.impact.v_after[0], 1.0, 1e-4) << label;
          EXPECT_NEAR(one.impact.impulse, 2.0, 2e-2) << label;
        }
      }
}

// Slopes of neighbouring rows are off by more than the speed: longer steps show more.
TEST(ImpactFinder, JoinsRowsWhereDigitsAreFew) {
  const Penalty motion{1e12};
  const auto found = find_impacts(printed(sampled(motion, 10.0, 5e-5, false), 4), equal_masses());
  ASSERT_EQ(found.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[std::size_t(k)].impact.t, motion.first(k), 5e-3);
}

TEST(ImpactFinder, KnowsTheImpulseOfAContactThatLasts) {
  const Penalty motion{1e4};
  const auto found =
      find_impacts(sampled(motion, 3.0, motion.contact() / 100.0, true), equal_masses());
  ASSERT_EQ(found.size(), 1u);
  // The spring's impulse; the masses' own springs give 2 / wc^2 of the change of velocity.
  EXPECT_NEAR(found[0].impact.impulse, 2.0 - 2.0 / std::pow(motion.wc(), 2), 1e-6);
}

TEST(ImpactFinder, SaysWhatIsUnknownOfAContactThatIsStillClosed) {
  const Penalty motion{1e3};
  const double end = motion.first(0) + 0.9 * motion.contact();
  const auto found = find_impacts(sampled(motion, end, 1e-3, true), equal_masses());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].impact.t, motion.first(0), 1e-6);
  EXPECT_TRUE(found[0].impact.v_after.empty());
  EXPECT_TRUE(std::isnan(found[0].impact.impulse));
  EXPECT_NEAR(found[0].end, end, 1e-3);
}

}  // namespace
}  // namespace clackers::measure
