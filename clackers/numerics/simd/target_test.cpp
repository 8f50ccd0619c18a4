#include "clackers/numerics/simd/target.hpp"

#include <gtest/gtest.h>

#include <set>

#include "clackers/base/error.hpp"

namespace clackers::numerics::simd {
namespace {

TEST(Target, ThoseOfTheProcessorAreDistinctAndEndWithoutFma) {
  const auto targets = available_targets();
  ASSERT_FALSE(targets.empty());
  std::set<std::string_view> names;
  for (const auto& each : targets) EXPECT_TRUE(names.insert(each.name()).second) << each.name();
    // The last is what every processor of the kind can run.
#if defined(__x86_64__)
  EXPECT_FALSE(targets.back().has_fma());
#endif
}

TEST(Target, HasFmaFromAvx2OnAndNotBefore) {
#if defined(__x86_64__)
  for (const auto& each : available_targets())
    EXPECT_EQ(each.has_fma(), each.name().starts_with("AVX")) << each.name();
#endif
}

TEST(Target, OneThatTheProcessorLacksIsRefusedByName) {
  try {
    const ForcedTarget forced({0});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(available_targets().front().name()), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace clackers::numerics::simd
