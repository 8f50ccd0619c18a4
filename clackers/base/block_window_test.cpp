#include "clackers/base/block_window.hpp"

#include <gtest/gtest.h>

#include <random>

namespace clackers {
namespace {

constexpr std::size_t size = 20 * BlockWindow<double>::block_size + 7, width = 3;

BlockWindow<double> window(std::size_t& made) {
  return {size, width, [&made](std::size_t first, std::size_t count, double* to) {
            made += count;
            EXPECT_LE(first + count, size);
            for (std::size_t i = 0; i < count * width; ++i) to[i] = double(first * width + i);
          }};
}

TEST(BlockWindow, MakesEachRowOnceForReadersThatGoOn) {
  std::size_t made = 0;
  auto rows = window(made);
  for (std::size_t i = 0; i < size; ++i)
    for (const auto row : {i, i >= 700 ? i - 700 : 0, std::min(i + 900, size - 1)})
      for (std::size_t j = 0; j < width; ++j) ASSERT_EQ(rows[row][j], double(row * width + j));
  EXPECT_EQ(made, size);
}

TEST(BlockWindow, ARowStaysWhileOneOfAnotherBlockIsAskedFor) {
  std::size_t made = 0;
  auto rows = window(made);
  std::mt19937 random(3);  // NOLINT: the same numbers in every run
  std::uniform_int_distribution<std::size_t> any(0, size - 1);
  for (int i = 0; i < 10000; ++i) {
    const auto first = any(random), other = any(random);
    const double* const here = rows[first];
    const double* const there = rows[other];
    ASSERT_EQ(*here, double(first * width));
    ASSERT_EQ(*there, double(other * width));
  }
}

}  // namespace
}  // namespace clackers
