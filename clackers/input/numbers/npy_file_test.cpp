#include "clackers/input/numbers/npy_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <thread>

#include "clackers/base/testing/test_file.hpp"
#include "clackers/input/testing/npy_bytes.hpp"

namespace clackers::input {
namespace {

using Numbers = std::vector<double>;

// The columns with their names; NaN where a column has no numbers.
struct Array {
  std::vector<std::string> names;
  std::vector<Numbers> columns;
  std::size_t blocks = 0;
};

Array all_of(NpyFile file) {
  Array array;
  for (const auto& column : file.block().columns) array.names.push_back(column.name);
  array.columns.resize(array.names.size());
  for (std::size_t rows = 0; rows < file.rows(); rows += file.block().rows, ++array.blocks) {
    file.next_block();
    const auto& block = file.block();
    for (std::size_t c = 0; c < block.columns.size(); ++c)
      for (std::size_t r = 0; r < block.rows; ++r)
        array.columns[c].push_back(block.columns[c].first == nullptr ? NAN
                                                                     : block.columns[c].first[r]);
  }
  return array;
}

Array read_npy(const std::string& bytes) {
  const TestFile file(bytes);
  return all_of(NpyFile(InputFile(file.path(), nullptr)));
}

// Through a pipe, whose size nobody knows.
Array read_pipe(const std::string& bytes) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::thread writer([&] {
    std::size_t at = 0;
    while (at < bytes.size()) {
      const auto count = ::write(ends[1], bytes.data() + at, bytes.size() - at);
      if (count <= 0) break;
      at += std::size_t(count);
    }
    ::close(ends[1]);
  });
  const auto end = [&] {
    std::string rest(1 << 16, '\0');
    while (::read(ends[0], rest.data(), rest.size()) > 0) {
    }
    writer.join();
    ::close(ends[0]);
  };
  try {
    auto array = all_of(NpyFile(InputFile("/proc/self/fd/" + std::to_string(ends[0]), nullptr)));
    end();
    return array;
  } catch (...) {
    end();
    throw;
  }
}

const std::vector<Numbers> two_columns{{0.0, 0.5, 1.0}, {1.0, -2.0, 3.0}};
const Numbers row_values{0.0, 1.0, 0.5, -2.0, 1.0, 3.0}, by_columns{0.0, 0.5, 1.0, 1.0, -2.0, 3.0};

TEST(NpyFile, ReadsPlainArraysInBothOrdersFromFilesAndPipes) {
  for (const char version : {'\1', '\2', '\3'})
    for (const auto& bytes : {npy("'<f8'", "(3, 2)", bytes_of(row_values), false, version),
                              npy("'<f8'", "(3, 2)", bytes_of(by_columns), true, version)}) {
      EXPECT_EQ(read_npy(bytes).columns, two_columns);
      EXPECT_EQ(read_pipe(bytes).columns, two_columns);
      EXPECT_EQ(read_npy(bytes).names, (std::vector<std::string>{"", ""}));
    }
  EXPECT_EQ(read_npy(npy("'<f8'", "(3,)", bytes_of(row_values).substr(0, 24))).columns,
            (std::vector<Numbers>{{0.0, 1.0, 0.5}}));
  EXPECT_TRUE(read_npy(npy("'<f8'", "(0, 2)", "")).columns[0].empty());
}

template <class Number>
void expect_read(const std::string& type) {
  const std::vector<Number> numbers{Number(1), Number(100), Number(-7)};
  for (const bool swapped : {false, true}) {
    SCOPED_TRACE(type);
    const auto array = read_npy(
        npy(fmt::format("'{}{}'", swapped ? '>' : '<', type), "(3,)", bytes_of(numbers, swapped)));
    EXPECT_EQ(array.columns[0], (Numbers{1.0, 100.0, double(numbers[2])}));
  }
}

TEST(NpyFile, ReadsEveryNumberInBothByteOrders) {
  expect_read<double>("f8");
  expect_read<float>("f4");
  expect_read<std::int8_t>("i1");
  expect_read<std::int16_t>("i2");
  expect_read<std::int32_t>("i4");
  expect_read<std::int64_t>("i8");
  expect_read<std::uint8_t>("u1");
  expect_read<std::uint16_t>("u2");
  expect_read<std::uint32_t>("u4");
  expect_read<std::uint64_t>("u8");
  EXPECT_EQ(read_npy(npy("'|i1'", "(1,)", "\x05")).columns[0], Numbers{5.0});
}

TEST(NpyFile, ReadsFieldsOfStructuredArrays) {
  // As numpy.dtype([...], align=True) pads, with a title, a field of two numbers and a text.
  const auto type =
      "[('t', '>f4'), ('', '|V4'), (('displacements', 'u'), '<f8', (2,)), ('label', '<U1'), "
      "('m', '<f8', (2, 2)), ('n', '<i2')]";
  std::string row = bytes_of(std::vector<float>{0.5f}, true) + "????" +
                    bytes_of(Numbers{1.0, 2.0}) + std::string(4 + 32, 'x') +
                    bytes_of(std::vector<std::int16_t>{-3});
  const auto array = read_npy(npy(type, "(2,)", row + row));
  EXPECT_EQ(array.names, (std::vector<std::string>{"t", "u1", "u2", "label", "m", "n"}));
  EXPECT_EQ(array.columns[0], (Numbers{0.5, 0.5}));
  EXPECT_EQ(array.columns[1], (Numbers{1.0, 1.0}));
  EXPECT_EQ(array.columns[2], (Numbers{2.0, 2.0}));
  EXPECT_TRUE(std::isnan(array.columns[3][0]) && std::isnan(array.columns[4][0]));
  EXPECT_EQ(array.columns[5], (Numbers{-3.0, -3.0}));
}

TEST(NpyFile, ReadsManyRowsInBlocks) {
  constexpr std::size_t rows = 140'000;
  Numbers numbers(2 * rows), transposed(2 * rows);
  for (std::size_t i = 0; i < rows; ++i) {
    numbers[2 * i] = transposed[i] = double(i);
    numbers[2 * i + 1] = transposed[rows + i] = -double(i);
  }
  const auto shape = fmt::format("({}, 2)", rows);
  const auto given = npy("'<f8'", shape, bytes_of(numbers)),
             other = npy("'<f8'", shape, bytes_of(transposed), true);
  for (const auto& array : {read_npy(given), read_pipe(given), read_npy(other), read_pipe(other)}) {
    EXPECT_GT(array.blocks, 2u);
    ASSERT_EQ(array.columns[1].size(), rows);
    for (std::size_t i = 0; i < rows; ++i) {
      ASSERT_EQ(array.columns[0][i], double(i));
      ASSERT_EQ(array.columns[1][i], -double(i));
    }
  }
}

TEST(NpyFile, RefusesCutAndLongFilesFromFilesAndPipes) {
  for (const bool order : {false, true}) {
    const auto whole = npy("'<f8'", "(3, 2)", bytes_of(row_values), order);
    for (const auto& cut :
         {whole.substr(0, whole.size() - 1), whole.substr(0, whole.size() - 48)}) {
      EXPECT_REFUSED(read_npy(cut), "not-an-array", "ends before the last of its 3 rows");
      EXPECT_REFUSED(read_pipe(cut), "not-an-array", "ends before the last of its 3 rows");
    }
    EXPECT_REFUSED(read_npy(whole + whole), "not-an-array", "continues after the 3 rows");
    EXPECT_REFUSED(read_pipe(whole + whole), "not-an-array", "continues after the 3 rows");
    for (const std::size_t size : {6u, 8u, 9u, 10u, 40u}) {
      EXPECT_REFUSED(read_npy(whole.substr(0, size)), "not-an-array", "ends within its header");
      EXPECT_REFUSED(read_pipe(whole.substr(0, size)), "not-an-array", "ends within its header");
    }
  }
  // The length says four gigabytes.
  auto large = npy("'<f8'", "(3, 2)", bytes_of(row_values), false, 2);
  large.replace(8, 4, 4, '\xff');
  EXPECT_REFUSED(read_npy(large), "not-an-array", "ends within its header");
}

TEST(NpyFile, ReadsHeadersLongerThanVersion1Holds) {
  const auto header =
      "{'descr': '<f8', 'fortran_order': False, 'shape': (1,)}" + std::string(300'000, ' ') + "\n";
  EXPECT_EQ(read_npy(npy_with_header(header, bytes_of(Numbers{7.0}), 2)).columns[0], Numbers{7.0});
}

TEST(NpyFile, RefusesOtherVersions) {
  EXPECT_REFUSED(read_npy(npy("'<f8'", "(1,)", bytes_of(Numbers{1.0}), false, 4)), "not-an-array",
                 "version 4.0 of NumPy's format; allowed: 1 to 3");
  EXPECT_REFUSED(read_npy(npy("'<f8'", "(1,)", bytes_of(Numbers{1.0}), false, 0)), "not-an-array",
                 "version 0.0");
}

}  // namespace
}  // namespace clackers::input
