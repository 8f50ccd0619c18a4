#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "bindings/c/scoped_motion.hpp"

namespace clackers::c_api {
namespace {

clackers_pair standard_pair() {
  clackers_pair pair{};
  pair.struct_size = sizeof pair;
  EXPECT_EQ(clackers_pair_defaults(&pair), CLACKERS_OK);
  return pair;
}

double constant(const ScopedMotion& motion, const char* name) {
  double value = NAN;
  EXPECT_EQ(clackers_motion_constant(motion.get(), name, &value), CLACKERS_OK)
      << clackers_last_error();
  return value;
}

TEST(CCreate, TheVersionIsThatOfTheProject) { EXPECT_STREQ(clackers_version(), EXPECTED_VERSION); }

TEST(CCreate, DefaultsAreThoseOfTheClass) {
  const auto pair = standard_pair();
  EXPECT_EQ(pair.struct_size, sizeof pair);
  EXPECT_EQ(pair.m1, 1.0);
  EXPECT_EQ(pair.k1, 1.0);
  EXPECT_EQ(pair.xi1, 0.05);
  EXPECT_EQ(pair.A, 1.0);
  EXPECT_EQ(pair.X, 9.0);
  EXPECT_EQ(pair.r, 3.0);
  EXPECT_EQ(pair.eta, 1.0);
  EXPECT_EQ(pair.t_end, 20.0);
}

TEST(CCreate, EveryMemberOfAPairReachesItsParameter) {
  auto pair = standard_pair();
  pair.m1 = 2.0;
  pair.k1 = 5.0;
  pair.xi1 = 0.125;
  pair.A = 0.75;
  pair.X = 5.0;
  pair.r = 0.5;
  pair.eta = 0.875;
  pair.t_end = 30.0;
  clackers_motion* made = nullptr;
  ASSERT_EQ(clackers_pair_create(&pair, &made), CLACKERS_OK) << clackers_last_error();
  const ScopedMotion motion(made);
  EXPECT_EQ(constant(motion, "m1"), 2.0);
  EXPECT_EQ(constant(motion, "k1"), 5.0);
  EXPECT_EQ(constant(motion, "xi1"), 0.125);
  EXPECT_EQ(constant(motion, "u1(0)"), 0.75);
  EXPECT_EQ(constant(motion, "X"), 5.0);
  EXPECT_EQ(constant(motion, "r"), 0.5);
  EXPECT_EQ(constant(motion, "eta"), 0.875);
  EXPECT_EQ(constant(motion, "t_end"), 30.0);
}

TEST(CCreate, ANamedCaseTakesSettings) {
  const auto motion = make_case("three-parameter", {{"N", 3.0}, {"a_t", 2.0}});
  ASSERT_TRUE(motion);
  EXPECT_EQ(constant(motion, "X"), 13.0);
  EXPECT_EQ(constant(motion, "t_end"), 40.0);
  EXPECT_EQ(constant(motion, "xi1"), 0.05);
}

TEST(CCreate, ANamedCaseTakesWords) {
  const clackers_setting pairs{"pairs", 3.0};
  const clackers_word dense{"coupling", "dense"}, wrong{"coupling", "dens"},
      empty{"coupling", nullptr};
  clackers_motion* made = nullptr;
  ASSERT_EQ(clackers_case_create_with_words("assembly", &pairs, 1, &dense, 1, &made), CLACKERS_OK)
      << clackers_last_error();
  const ScopedMotion motion(made);
  std::int32_t dof = 0;
  EXPECT_EQ(clackers_motion_dof(motion.get(), &dof), CLACKERS_OK);
  EXPECT_EQ(dof, 6);
  // The masses of a chain that starts the same way are coupled otherwise.
  const auto chain = make_case("assembly", {{"pairs", 3.0}});
  const auto bound_at = [](const ScopedMotion& of) {
    std::vector<double> u(6), v(6);
    const clackers_buffers out{sizeof out, 6, u.data(), v.data(), nullptr};
    EXPECT_EQ(clackers_motion_envelope(of.get(), 0.0, &out), CLACKERS_OK);
    return u;
  };
  EXPECT_NE(bound_at(motion), bound_at(chain));
  EXPECT_EQ(clackers_case_create_with_words("assembly", nullptr, 0, &wrong, 1, &made),
            CLACKERS_REFUSED);
  EXPECT_NE(std::string(clackers_last_error()).find("Did you mean \"dense\"?"), std::string::npos);
  EXPECT_EQ(clackers_case_create_with_words("assembly", nullptr, 0, &empty, 1, &made),
            CLACKERS_REFUSED);
  EXPECT_STREQ(clackers_last_error_code(), "null-pointer");
  EXPECT_EQ(clackers_case_create_with_words("assembly", nullptr, 0, nullptr, 1, &made),
            CLACKERS_REFUSED);
}

TEST(CCreate, CasesAreListedUntilNull) {
  std::size_t count = 0;
  bool seen = false;
  for (; clackers_case_name(count) != nullptr; ++count)
    seen = seen || std::string(clackers_case_name(count)) == "three-parameter";
  EXPECT_GE(count, 8u);
  EXPECT_TRUE(seen);
  EXPECT_EQ(clackers_case_name(count + 1000), nullptr);
}

TEST(CCreate, EveryListedCaseCanBeMade) {
  for (std::size_t i = 0; clackers_case_name(i) != nullptr; ++i)
    EXPECT_TRUE(make_case(clackers_case_name(i))) << clackers_last_error();
}

void expect_refused(clackers_status status, const std::string& text, const std::string& code) {
  EXPECT_EQ(status, CLACKERS_REFUSED);
  EXPECT_EQ(clackers_last_error(), text);
  EXPECT_EQ(clackers_last_error_code(), code);
}

TEST(CCreate, RefusalsSpeakAsTheLibraryDoesAndLeaveTheHandleAlone) {
  auto* const untouched = reinterpret_cast<clackers_motion*>(8);
  clackers_motion* motion = untouched;
  expect_refused(clackers_case_create("three-parametre", nullptr, 0, &motion),
                 "clackers: no case \"three-parametre\". Did you mean \"three-parameter\"? All "
                 "names: clackers list cases",
                 "unknown-name");
  auto pair = standard_pair();
  pair.eta = 1.5;
  EXPECT_EQ(clackers_pair_create(&pair, &motion), CLACKERS_REFUSED);
  EXPECT_STREQ(clackers_last_error_code(), "out-of-range");
  EXPECT_NE(std::string(clackers_last_error()).find("eta = 1.5; allowed: 0 <= eta <= 1"),
            std::string::npos)
      << clackers_last_error();
  pair = standard_pair();
  pair.r = 5.0;
  EXPECT_EQ(clackers_pair_create(&pair, &motion), CLACKERS_REFUSED);
  EXPECT_STREQ(clackers_last_error_code(), "not-admissible");
  EXPECT_EQ(motion, untouched);
}

TEST(CCreate, NotANumberIsRefusedInEveryMember) {
  for (double clackers_pair::*member :
       {&clackers_pair::m1, &clackers_pair::k1, &clackers_pair::xi1, &clackers_pair::A,
        &clackers_pair::X, &clackers_pair::r, &clackers_pair::eta, &clackers_pair::t_end}) {
    auto pair = standard_pair();
    pair.*member = NAN;
    clackers_motion* motion = nullptr;
    EXPECT_EQ(clackers_pair_create(&pair, &motion), CLACKERS_REFUSED);
    EXPECT_EQ(motion, nullptr);
    EXPECT_NE(std::string(clackers_last_error()).find("nan"), std::string::npos)
        << clackers_last_error();
  }
}

TEST(CCreate, NullPointersAreNamed) {
  clackers_motion* motion = nullptr;
  const auto pair = standard_pair();
  const clackers_setting unnamed{nullptr, 1.0};
  const auto null = [](const std::string& who, const std::string& name) {
    return who + ": " + name + " = NULL; allowed: a valid pointer.";
  };
  const std::string code = "null-pointer";
  expect_refused(clackers_pair_defaults(nullptr), null("clackers_pair_defaults", "pair"), code);
  expect_refused(clackers_pair_create(nullptr, &motion), null("clackers_pair_create", "pair"),
                 code);
  expect_refused(clackers_pair_create(&pair, nullptr), null("clackers_pair_create", "motion"),
                 code);
  const std::string create = "clackers_case_create";
  expect_refused(clackers_case_create(nullptr, nullptr, 0, &motion), null(create, "name"), code);
  expect_refused(clackers_case_create("sdof", nullptr, 0, nullptr), null(create, "motion"), code);
  expect_refused(clackers_case_create("sdof", nullptr, 1, &motion), null(create, "settings"), code);
  expect_refused(clackers_case_create("sdof", &unnamed, 1, &motion),
                 null(create, "settings[0].name"), code);
  EXPECT_EQ(motion, nullptr);
  clackers_motion_destroy(nullptr);
}

TEST(CCreate, ErrorsBelongToTheirThread) {
  EXPECT_FALSE(make_case("sdof", {{"xi1", 2.0}}));
  const std::string mine = clackers_last_error();
  EXPECT_FALSE(mine.empty());
  std::thread([] {
    EXPECT_STREQ(clackers_last_error(), "");
    EXPECT_STREQ(clackers_last_error_code(), "");
    EXPECT_FALSE(make_case("nonsense"));
    EXPECT_STREQ(clackers_last_error_code(), "unknown-name");
  }).join();
  EXPECT_EQ(clackers_last_error(), mine);
  EXPECT_STREQ(clackers_last_error_code(), "out-of-range");
}

TEST(CCreate, SuccessLeavesNoError) {
  EXPECT_FALSE(make_case("nonsense"));
  EXPECT_TRUE(make_case("sdof"));
  EXPECT_STREQ(clackers_last_error(), "");
  EXPECT_STREQ(clackers_last_error_code(), "");
}

}  // namespace
}  // namespace clackers::c_api
