#include <gtest/gtest.h>

#include <cstdint>
#include <thread>
#include <vector>

#include "bindings/c/scoped_motion.hpp"

namespace clackers::c_api {
namespace {

constexpr std::size_t rows = 500;

std::vector<double> times() {
  std::vector<double> out(rows);
  for (std::size_t i = 0; i < rows; ++i) out[i] = 20.0 * double(i) / double(rows);
  return out;
}

// Everything that a motion gives, one after the other.
std::vector<double> numbers_of(const clackers_motion* motion) {
  Arrays arrays(2 * rows);
  EXPECT_EQ(clackers_motion_sample(motion, times().data(), rows, CLACKERS_RIGHT, &arrays.out),
            CLACKERS_OK)
      << clackers_last_error();
  auto out = arrays.u;
  out.insert(out.end(), arrays.v.begin(), arrays.v.end());
  out.insert(out.end(), arrays.a.begin(), arrays.a.end());
  std::int64_t count = 0;
  EXPECT_EQ(clackers_motion_impact_count(motion, 20.0, &count), CLACKERS_OK);
  out.push_back(double(count));
  return out;
}

TEST(CLibrary, ThreadsShareOneMotionAndMakeTheirOwn) {
  const auto shared = make_case("three-parameter");
  const auto expected = numbers_of(shared.get());
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&, i] {
      for (int repetition = 0; repetition < 5; ++repetition) {
        EXPECT_EQ(numbers_of(shared.get()), expected);
        EXPECT_EQ(numbers_of(make_case("three-parameter").get()), expected);
        EXPECT_FALSE(make_case("three-parameter", {{"xi1", 2.0 + i}}));
        EXPECT_NE(std::string(clackers_last_error()).find(std::to_string(2 + i)), std::string::npos)
            << clackers_last_error();
      }
    });
  for (auto& thread : threads) thread.join();
}

}  // namespace
}  // namespace clackers::c_api
