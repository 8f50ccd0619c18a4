#include "clackers/input/numbers/npy_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "clackers/base/error.hpp"

namespace clackers::input {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20;

// Numbers of one type from anywhere in memory.
template <class Number>
void convert(const char* bytes, std::size_t stride, bool swapped, std::span<double> numbers) {
  std::array<char, sizeof(Number)> raw;
  for (double& number : numbers) {
    std::memcpy(raw.data(), bytes, raw.size());
    if (swapped) std::ranges::reverse(raw);
    number = static_cast<double>(std::bit_cast<Number>(raw));
    bytes += stride;
  }
}

using Conversion = void (*)(const char*, std::size_t, bool, std::span<double>);

Conversion conversion(const NpyNumber& type) {
  if (type.kind == 'f') return type.size == 4 ? convert<float> : convert<double>;
  if (type.kind == 'i')
    return type.size == 1   ? convert<std::int8_t>
           : type.size == 2 ? convert<std::int16_t>
           : type.size == 4 ? convert<std::int32_t>
                            : convert<std::int64_t>;
  return type.size == 1   ? convert<std::uint8_t>
         : type.size == 2 ? convert<std::uint16_t>
         : type.size == 4 ? convert<std::uint32_t>
                          : convert<std::uint64_t>;
}

}  // namespace

NpyFile::NpyFile(InputFile file) : file_(std::move(file)) {
  read_header();
  if (size_is_known()) {
    const auto size = static_cast<std::size_t>(file_.size()) - data_;
    if (size < header_.size()) fail_short();
    if (size > header_.size()) fail_long();
  } else if (header_.by_columns) {
    read_whole();
  }
  for (const auto& column : header_.columns) block_.columns.push_back({column.name, nullptr, 1});
  block_.name = name();
}

void NpyFile::fail_short() const {
  throw InputError(fmt::format("{} ends before the last of its {} rows: it may have been cut here, "
                               "or is still being written. Save it again with numpy.save.",
                               name(), header_.rows),
                   "not-an-array");
}

void NpyFile::fail_long() const {
  throw InputError(fmt::format("{} continues after the {} rows of its array; allowed: one array. "
                               "Save each to a file of its own.",
                               name(), header_.rows),
                   "not-an-array");
}

void NpyFile::read_header() {
  std::array<unsigned char, 12> start;
  const auto read = [this](unsigned char* bytes, std::size_t count) {
    if (file_.read_all(reinterpret_cast<char*>(bytes), count) == count) return;
    throw InputError(name() +
                         " ends within its header: it may have been cut here, or is still being "
                         "written. Save it again with numpy.save.",
                     "not-an-array");
  };
  read(start.data(), 10);
  const int version = start[6];
  if (version < 1 || version > 3)
    throw InputError(fmt::format("{} has version {}.{} of NumPy's format; allowed: 1 to 3. Save it "
                                 "again with numpy.save.",
                                 name(), version, int(start[7])),
                     "not-an-array");
  std::size_t length = start[8] + 256u * start[9];
  data_ = 10;
  if (version > 1) {
    read(start.data() + 10, 2);
    length += 65536u * start[10] + (std::size_t{start[11]} << 24u);
    data_ = 12;
  }
  data_ += length;
  std::string text;
  // A bent length cannot fill the memory: the bytes must be there.
  while (text.size() < length) {
    const auto size = text.size();
    text.resize(std::min(length, size + block_bytes));
    read(reinterpret_cast<unsigned char*>(text.data() + size), text.size() - size);
  }
  header_ = read_npy_header(name(), text);
}

void NpyFile::read_whole() {
  const auto size = header_.size();
  while (whole_.size() < size) {
    const auto have = whole_.size();
    whole_.resize(std::min(size, have + block_bytes));
    if (file_.read_all(whole_.data() + have, whole_.size() - have) != whole_.size() - have)
      fail_short();
  }
}

// Bytes of the data from `offset`; of an array by rows each after the ones before.
void NpyFile::read_data(std::size_t offset, std::size_t count) {
  bytes_.resize(count);
  if (!whole_.empty())
    std::copy_n(whole_.data() + offset, count, bytes_.data());
  else if (count != (header_.by_columns ? file_.read_all_at(data_ + offset, bytes_.data(), count)
                                        : file_.read_all(bytes_.data(), count)))
    fail_short();
}

void NpyFile::next_block() {
  const auto row_bytes = header_.size() / header_.rows;
  const auto rows = std::min(std::max<std::size_t>(1, block_bytes / row_bytes), rows_left());
  numbers_.resize(rows * header_.columns.size());
  if (!header_.by_columns) read_data(end_ * header_.stride, rows * header_.stride);
  for (std::size_t c = 0; c < header_.columns.size(); ++c) {
    const auto& [column_name, type, offset] = header_.columns[c];
    if (type.kind == 'V') continue;
    if (header_.by_columns) read_data(offset + end_ * header_.stride, rows * header_.stride);
    const auto numbers = std::span(numbers_).subspan(c * rows, rows);
    conversion(type)(bytes_.data() + (header_.by_columns ? 0 : offset), header_.stride,
                     type.swapped, numbers);
    block_.columns[c].first = numbers.data();
  }
  block_.rows = rows;
  end_ += rows;
  if (rows_left() == 0 && !size_is_known() && file_.read(bytes_.data(), 1) > 0) fail_long();
}

}  // namespace clackers::input
