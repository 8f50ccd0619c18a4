#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bindings/c/scoped_motion.hpp"
#include "clackers/cases/case.hpp"

namespace clackers::c_api {
namespace {

TEST(CConstants, AreAllThoseOfTheCaseThenItsIndicators) {
  const auto motion = make_case("three-parameter");
  const auto test_case = cases::make("three-parameter");
  auto all = test_case.constants;
  all.insert(all.end(), test_case.indicators.begin(), test_case.indicators.end());
  ASSERT_GT(test_case.indicators.size(), 0u);

  std::size_t count = 0;
  ASSERT_EQ(clackers_motion_constant_count(motion.get(), &count), CLACKERS_OK);
  ASSERT_EQ(count, all.size());
  for (std::size_t i = 0; i < count; ++i) {
    clackers_constant constant{};
    constant.struct_size = sizeof constant;
    ASSERT_EQ(clackers_motion_constant_at(motion.get(), i, &constant), CLACKERS_OK);
    EXPECT_EQ(constant.struct_size, sizeof constant);
    EXPECT_EQ(constant.name, all[i].name);
    EXPECT_EQ(constant.unit, all[i].unit);
    EXPECT_EQ(constant.meaning, all[i].meaning);
    EXPECT_EQ(constant.value, all[i].value);
    double value = NAN;
    EXPECT_EQ(clackers_motion_constant(motion.get(), constant.name, &value), CLACKERS_OK);
    EXPECT_EQ(value, all[i].value) << constant.name << " is the only one of its name";
  }
}

TEST(CConstants, BeyondTheLastAreRefused) {
  const auto motion = make_case("sdof");
  std::size_t count = 0;
  clackers_motion_constant_count(motion.get(), &count);
  clackers_constant constant{};
  constant.struct_size = sizeof constant;
  EXPECT_EQ(clackers_motion_constant_at(motion.get(), count, &constant), CLACKERS_REFUSED);
  const auto number = std::to_string(count);
  EXPECT_EQ(clackers_last_error(), "clackers_motion_constant_at: index = " + number +
                                       "; allowed: 0 <= index < " + number + ".");
  EXPECT_EQ(constant.name, nullptr);
}

TEST(CConstants, AMisspelledNameIsToldTheNearest) {
  const auto motion = make_case("three-parameter");
  double value = 7.0;
  EXPECT_EQ(clackers_motion_constant(motion.get(), "omega_D3", &value), CLACKERS_REFUSED);
  EXPECT_EQ(value, 7.0);
  EXPECT_STREQ(clackers_last_error_code(), "unknown-name");
  const std::string text = clackers_last_error();
  EXPECT_NE(text.find("no constant of three-parameter \"omega_D3\". Did you mean \"omega_D"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("I_OC"), std::string::npos) << text;
}

TEST(CConstants, AdmissibilityIsToldOnBothSidesOfTheLimit) {
  double limit = 0.0, margin = 0.0;
  // r*(3) = 3 exactly, docs/manual/explanation/derivations/admissibility.md.
  EXPECT_EQ(clackers_admissibility(3.0, 6.0, &limit, &margin), CLACKERS_OK);
  EXPECT_EQ(limit, 3.0);
  EXPECT_EQ(margin, -1.0);
  EXPECT_EQ(clackers_admissibility(1.0, 6.0, &limit, &margin), CLACKERS_OK);
  EXPECT_EQ(limit, HUGE_VAL);
  EXPECT_EQ(margin, 7.0);
}

TEST(CConstants, AdmissibilityOutsideTheClassIsRefused) {
  double limit = 7.0, margin = 7.0;
  EXPECT_EQ(clackers_admissibility(2.0, 1.0, &limit, &margin), CLACKERS_REFUSED);
  EXPECT_STREQ(clackers_last_error_code(), "not-odd");
  EXPECT_EQ(clackers_admissibility(3.0, NAN, &limit, &margin), CLACKERS_REFUSED);
  EXPECT_EQ(limit, 7.0);
  EXPECT_EQ(margin, 7.0);
}

TEST(CConstants, NullPointersAreNamed) {
  const auto motion = make_case("sdof");
  clackers_constant constant{};
  constant.struct_size = sizeof constant;
  std::size_t count = 0;
  double x = 0.0;
  const auto refused = [](clackers_status status, const std::string& where) {
    EXPECT_EQ(status, CLACKERS_REFUSED);
    EXPECT_EQ(clackers_last_error(), where + " = NULL; allowed: a valid pointer.");
  };
  const auto* const m = motion.get();
  refused(clackers_motion_constant_count(nullptr, &count),
          "clackers_motion_constant_count: motion");
  refused(clackers_motion_constant_count(m, nullptr), "clackers_motion_constant_count: count");
  refused(clackers_motion_constant_at(nullptr, 0, &constant),
          "clackers_motion_constant_at: motion");
  refused(clackers_motion_constant_at(m, 0, nullptr), "clackers_motion_constant_at: constant");
  refused(clackers_motion_constant(nullptr, "T", &x), "clackers_motion_constant: motion");
  refused(clackers_motion_constant(m, nullptr, &x), "clackers_motion_constant: name");
  refused(clackers_motion_constant(m, "T", nullptr), "clackers_motion_constant: value");
  refused(clackers_admissibility(3.0, 1.0, nullptr, &x), "clackers_admissibility: r_star");
  refused(clackers_admissibility(3.0, 1.0, &x, nullptr), "clackers_admissibility: margin");
}

}  // namespace
}  // namespace clackers::c_api
