#include <gtest/gtest.h>

#include <string>

#include "bindings/c/scoped_motion.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/model/forces.hpp"

namespace clackers::c_api {
namespace {

TEST(CForces, AreThoseOfTheLibrary) {
  for (const char* name : {"plastic-pair", "penalized-pair", "belt", "stop"}) {
    const auto test_case = cases::make(name);
    const auto motion = make_case(name);
    const auto counts = model::force_counts(test_case.problem);
    size_t contacts = 7, springs = 7, frictions = 7;
    ASSERT_EQ(clackers_motion_force_count(motion.get(), &contacts, &springs, &frictions),
              CLACKERS_OK);
    EXPECT_EQ(contacts, size_t(counts.contacts)) << name;
    EXPECT_EQ(springs, size_t(counts.springs)) << name;
    EXPECT_EQ(frictions, size_t(counts.frictions)) << name;
    double largest = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const double t = test_case.motion->end() * i / 1000.0;
      double force = 7.0;
      ASSERT_EQ(clackers_motion_forces(motion.get(), t, CLACKERS_LEFT, 1, &force), CLACKERS_OK)
          << clackers_last_error();
      EXPECT_EQ(force,
                model::forces(test_case.problem, *test_case.motion, t, model::Side::left)[0]);
      largest = std::max(largest, force);
    }
    EXPECT_EQ(largest > 0.0, std::string(name) != "stop") << name;
  }
}

TEST(CForces, AreRefusedWithTheReason) {
  const auto motion = make_case("stop");
  double force = 7.0;
  size_t count = 7;
  const auto says = [](const char* words) {
    return std::string(clackers_last_error()).find(words) != std::string::npos;
  };
  EXPECT_NE(clackers_motion_forces(motion.get(), 1.0, CLACKERS_LEFT, 0, &force), CLACKERS_OK);
  EXPECT_TRUE(says("capacity = 0; allowed: at least 1")) << clackers_last_error();
  EXPECT_NE(clackers_motion_forces(motion.get(), 1.0, CLACKERS_LEFT, 1, nullptr), CLACKERS_OK);
  EXPECT_TRUE(says("forces")) << clackers_last_error();
  EXPECT_NE(clackers_motion_forces(motion.get(), -1.0, CLACKERS_LEFT, 1, &force), CLACKERS_OK);
  EXPECT_TRUE(says("t = -1")) << clackers_last_error();
  EXPECT_NE(clackers_motion_forces(motion.get(), 1.0, 5, 1, &force), CLACKERS_OK);
  EXPECT_NE(clackers_motion_forces(nullptr, 1.0, CLACKERS_LEFT, 1, &force), CLACKERS_OK);
  EXPECT_NE(clackers_motion_force_count(motion.get(), &count, nullptr, &count), CLACKERS_OK);
  EXPECT_EQ(force, 7.0);
}

}  // namespace
}  // namespace clackers::c_api
