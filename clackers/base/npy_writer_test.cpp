#include "clackers/base/npy_writer.hpp"

#include <gtest/gtest.h>

namespace clackers {
namespace {

TEST(NpyHeader, IsThatOfNumPy) {
  const auto header = npy_header({"t", "v1-"}, 12);
  EXPECT_EQ(header.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(header.size(), 128u);
  EXPECT_EQ(header.substr(8, 2), std::string("\x76\x00", 2));  // 118 bytes follow
  EXPECT_TRUE(header.substr(10).starts_with(
      "{'descr': [('t', '<f8'), ('v1-', '<f8'), ], 'fortran_order': False, 'shape': (12,), } "));
  EXPECT_EQ(header.back(), '\n');
}

TEST(NpyHeader, CanBeReplacedByThatOfMoreRows) {
  for (const int columns : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const std::vector<std::string> names(std::size_t(columns), "name");
    const auto size = npy_header(names, 0, 123456789012).size();
    EXPECT_EQ(npy_header(names, 9, 123456789012).size(), size);
    EXPECT_EQ(npy_header(names, 123456789012, 123456789012).size(), size);
    EXPECT_EQ(size % 64, 0u);
  }
}

TEST(NpyHeader, OfManyColumnsHasALongerLength) {
  const auto header = npy_header(std::vector<std::string>(10000, "u"), 1);
  EXPECT_EQ(header[6], '\x02');
  EXPECT_EQ(header.size() % 64, 0u);
  const auto byte = [&](std::size_t i) {
    return std::size_t(static_cast<unsigned char>(header[i]));
  };
  EXPECT_EQ(byte(8) + 256 * byte(9) + 65536 * byte(10), header.size() - 12);
}

}  // namespace
}  // namespace clackers
