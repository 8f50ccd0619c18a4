#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "bindings/c/scoped_motion.hpp"
#include "clackers/cases/case.hpp"

namespace clackers::c_api {
namespace {

ScopedMotion pair() { return make_case("synchronized-pair", {{"eta", 0.875}}); }

clackers_impact empty_impact() {
  clackers_impact impact{};
  impact.struct_size = sizeof impact;
  return impact;
}

TEST(CImpacts, AreThoseOfTheLibrary) {
  const auto test_case = cases::make("synchronized-pair", {{"eta", 0.875}});
  const auto hit = test_case.motion->impact(3);
  auto impact = empty_impact();
  Arrays before(2), after(2);
  ASSERT_EQ(clackers_motion_impact(pair().get(), 3, &impact, &before.out, &after.out), CLACKERS_OK)
      << clackers_last_error();
  EXPECT_EQ(impact.struct_size, sizeof impact);
  EXPECT_EQ(impact.index, 3);
  EXPECT_EQ(impact.contact, 0);
  EXPECT_EQ(impact.t, hit.t);
  EXPECT_EQ(impact.t_lo, hit.when.lo);
  EXPECT_EQ(impact.t_hi, hit.when.hi);
  EXPECT_LT(impact.t_lo, impact.t_hi);
  EXPECT_EQ(impact.impulse, hit.impulse);
  EXPECT_EQ(impact.energy_before, hit.energy_before);
  EXPECT_EQ(impact.energy_after, hit.energy_after);
  for (int j = 0; j < 2; ++j) {
    const auto at = std::size_t(j);
    EXPECT_EQ(before.u[at], hit.before.u[j]);
    EXPECT_EQ(before.v[at], hit.before.v[j]);
    EXPECT_EQ(before.a[at], hit.before.a[j]);
    EXPECT_EQ(after.u[at], hit.after.u[j]);
    EXPECT_EQ(after.v[at], hit.after.v[j]);
    EXPECT_EQ(after.a[at], hit.after.a[j]);
  }
}

TEST(CImpacts, KeepNewtonsLaw) {
  auto impact = empty_impact();
  Arrays before(2), after(2);
  ASSERT_EQ(clackers_motion_impact(pair().get(), 1, &impact, &before.out, &after.out), CLACKERS_OK);
  // Each of the four velocities is rounded once, so the law holds to 4 units of 2^-53.
  const double closing = before.v[0] - before.v[1], opening = after.v[0] - after.v[1];
  EXPECT_LT(closing, 0.0);
  EXPECT_NEAR(opening, -0.875 * closing, std::abs(closing) * 4 * 0x1p-53);
}

TEST(CImpacts, StatesMayBeLeftOut) {
  auto impact = empty_impact();
  EXPECT_EQ(clackers_motion_impact(pair().get(), 1, &impact, nullptr, nullptr), CLACKERS_OK);
  EXPECT_EQ(impact.index, 1);
}

TEST(CImpacts, AreCounted) {
  std::int64_t count = -1;
  const auto motion = pair();
  auto impact = empty_impact();
  ASSERT_EQ(clackers_motion_impact(motion.get(), 2, &impact, nullptr, nullptr), CLACKERS_OK);
  ASSERT_EQ(clackers_motion_impact_count(motion.get(), impact.t + 0.1, &count), CLACKERS_OK);
  EXPECT_EQ(count, 2);
  ASSERT_EQ(clackers_motion_impact_count(motion.get(), impact.t - 0.1, &count), CLACKERS_OK);
  EXPECT_EQ(count, 1);
  EXPECT_EQ(clackers_motion_impact_count(make_case("sdof").get(), 20.0, &count), CLACKERS_OK);
  EXPECT_EQ(count, 0);
}

TEST(CImpacts, OutsideTheMotionAreRefusedAndNothingIsWritten) {
  const auto motion = pair();
  std::int64_t count = -1;
  for (const auto& [t, code] : {std::pair(-1.0, "time-outside"), std::pair(21.0, "time-outside"),
                                std::pair(double(NAN), "not-a-number")}) {
    EXPECT_EQ(clackers_motion_impact_count(motion.get(), t, &count), CLACKERS_REFUSED);
    EXPECT_STREQ(clackers_last_error_code(), code);
  }
  EXPECT_EQ(count, -1);
  for (const std::int64_t index : {std::int64_t(0), std::int64_t(-1), std::int64_t(1) << 62}) {
    auto impact = empty_impact();
    Arrays before(2);
    EXPECT_EQ(clackers_motion_impact(motion.get(), index, &impact, &before.out, nullptr),
              CLACKERS_REFUSED);
    EXPECT_STREQ(clackers_last_error_code(), "beyond-last-impact");
    EXPECT_EQ(impact.index, 0);
    EXPECT_EQ(before.u[0], 7.0);
  }
}

TEST(CImpacts, SmallArraysAreRefusedBeforeAnythingIsWritten) {
  for (const bool left : {true, false}) {
    auto impact = empty_impact();
    Arrays good(2), small(1);
    EXPECT_EQ(clackers_motion_impact(pair().get(), 1, &impact, left ? &small.out : &good.out,
                                     left ? &good.out : &small.out),
              CLACKERS_REFUSED);
    EXPECT_STREQ(clackers_last_error_code(), "wrong-size");
    EXPECT_NE(std::string(clackers_last_error()).find(left ? "before->capacity = 1" : "after->"),
              std::string::npos)
        << clackers_last_error();
    EXPECT_EQ(impact.index, 0);
    EXPECT_EQ(good.u[0], 7.0);
  }
}

TEST(CImpacts, NullPointersAreNamed) {
  const auto motion = pair();
  auto impact = empty_impact();
  std::int64_t count = 0;
  const auto refused = [](clackers_status status, const std::string& where) {
    EXPECT_EQ(status, CLACKERS_REFUSED);
    EXPECT_EQ(clackers_last_error(), where + " = NULL; allowed: a valid pointer.");
    EXPECT_STREQ(clackers_last_error_code(), "null-pointer");
  };
  refused(clackers_motion_impact_count(nullptr, 1.0, &count),
          "clackers_motion_impact_count: motion");
  refused(clackers_motion_impact_count(motion.get(), 1.0, nullptr),
          "clackers_motion_impact_count: count");
  refused(clackers_motion_impact(nullptr, 1, &impact, nullptr, nullptr),
          "clackers_motion_impact: motion");
  refused(clackers_motion_impact(motion.get(), 1, nullptr, nullptr, nullptr),
          "clackers_motion_impact: impact");
}

}  // namespace
}  // namespace clackers::c_api
