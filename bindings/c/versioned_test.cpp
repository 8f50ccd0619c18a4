#include "bindings/c/versioned.hpp"

#include <gtest/gtest.h>

#include <string>

#include "bindings/c/scoped_motion.hpp"

namespace clackers::c_api {
namespace {

// The structure of a header to come: one member more.
struct LaterPair {
  clackers_pair pair;
  double member;
};

LaterPair later_pair(double member) {
  LaterPair later{};
  later.pair.struct_size = sizeof later;
  later.member = 7.0;
  EXPECT_EQ(clackers_pair_defaults(&later.pair), CLACKERS_OK) << clackers_last_error();
  EXPECT_EQ(later.member, 0.0) << "what the library does not know is set to zero";
  later.member = member;
  return later;
}

TEST(CVersions, ALaterStructureIsTakenWhereItsNewMembersAreZero) {
  const auto later = later_pair(0.0);
  EXPECT_EQ(later.pair.struct_size, sizeof later);
  clackers_motion* motion = nullptr;
  EXPECT_EQ(clackers_pair_create(&later.pair, &motion), CLACKERS_OK) << clackers_last_error();
  clackers_motion_destroy(motion);
}

TEST(CVersions, ALaterStructureThatAsksForMoreIsRefused) {
  const auto later = later_pair(1.0);
  clackers_motion* motion = nullptr;
  EXPECT_EQ(clackers_pair_create(&later.pair, &motion), CLACKERS_REFUSED);
  EXPECT_STREQ(clackers_last_error_code(), "wrong-struct-size");
  EXPECT_STREQ(clackers_last_error(),
               "clackers_pair_create: struct_size = 80; allowed: 72, unless every member beyond is "
               "zero. The caller was compiled with a newer clackers.h and uses what this library "
               "does not know; install the library of that version.");
}

TEST(CVersions, SizesThatNoVersionHadAreRefusedEverywhere) {
  const auto motion = make_case("three-parameter");
  for (const std::size_t size : {std::size_t{0}, sizeof(std::size_t), std::size_t{16},
                                 longest_struct + 1, std::size_t(-1)}) {
    clackers_pair pair{};
    clackers_impact impact{};
    clackers_constant constant{};
    Arrays arrays(2);
    pair.struct_size = impact.struct_size = constant.struct_size = arrays.out.struct_size = size;
    clackers_motion* made = nullptr;
    const double t = 1.0;
    const auto refused = [size](clackers_status status) {
      EXPECT_EQ(status, CLACKERS_REFUSED);
      EXPECT_STREQ(clackers_last_error_code(), "wrong-struct-size");
      const auto given = "struct_size = " + std::to_string(size) + "; allowed: sizeof";
      EXPECT_NE(std::string(clackers_last_error()).find(given), std::string::npos)
          << clackers_last_error();
    };
    refused(clackers_pair_defaults(&pair));
    refused(clackers_pair_create(&pair, &made));
    refused(clackers_motion_sample(motion.get(), &t, 1, CLACKERS_LEFT, &arrays.out));
    refused(clackers_motion_envelope(motion.get(), t, &arrays.out));
    refused(clackers_motion_error_bound(motion.get(), t, &arrays.out));
    refused(clackers_motion_impact(motion.get(), 1, &impact, nullptr, nullptr));
    refused(clackers_motion_constant_at(motion.get(), 0, &constant));
    EXPECT_EQ(made, nullptr);
    EXPECT_EQ(arrays.u[0], 7.0);
    EXPECT_EQ(impact.index, 0);
    EXPECT_EQ(constant.name, nullptr);
  }
}

// What today's header says is what programs compiled with it rely on.
TEST(CVersions, TheFirstSizesAreThoseOfTheFirstHeader) {
  if (sizeof(void*) != 8) GTEST_SKIP() << "written for pointers of 8 bytes";
  EXPECT_EQ(first_size<clackers_pair>, 72u);
  EXPECT_EQ(first_size<clackers_buffers>, 40u);
  EXPECT_EQ(first_size<clackers_impact>, 72u);
  EXPECT_EQ(first_size<clackers_constant>, 40u);
  EXPECT_EQ(sizeof(clackers_setting), 16u);
}

// A structure of three versions, of which this library is the second.
struct Second {
  std::size_t struct_size;
  double first, second;
};
struct Third {
  Second known;
  double third;
};

TEST(CVersions, AnEarlierStructureIsWrittenAsFarAsItReaches) {
  Third out{{offsetof(Second, second), 1.0, 2.0}, 3.0};
  write_versioned(out.known, Second{0, 10.0, 20.0});
  EXPECT_EQ(out.known.struct_size, offsetof(Second, second));
  EXPECT_EQ(out.known.first, 10.0);
  EXPECT_EQ(out.known.second, 2.0);
  EXPECT_EQ(out.third, 3.0);
}

TEST(CVersions, AnEarlierStructureIsReadWithZerosBeyondIt) {
  const Second given{offsetof(Second, second), 1.0, 2.0};
  const auto read = read_versioned("who", given);
  EXPECT_EQ(read.first, 1.0);
  EXPECT_EQ(read.second, 0.0);
}

}  // namespace
}  // namespace clackers::c_api
