#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "clackers/base/error.hpp"
#include "clackers/input/results/arrays.hpp"

namespace clackers::input {
namespace {

/// What a number of a file is.
enum class NumberType { none, f64, f32, i64, u64, i32, u32, i16, u16, i8, u8 };

std::size_t size_of(NumberType type) {
  static constexpr std::array<std::size_t, 11> sizes{1, 8, 4, 8, 8, 4, 4, 2, 2, 1, 1};
  return sizes[std::size_t(type)];
}

template <class Value>
void append(std::string_view bytes, std::vector<double>& values) {
  for (std::size_t at = 0; at + sizeof(Value) <= bytes.size(); at += sizeof(Value)) {
    Value value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    values.push_back(double(value));
  }
}

std::vector<double> values_of(std::string_view bytes, NumberType type) {
  static constexpr std::array<void (*)(std::string_view, std::vector<double>&), 10> readers{
      append<double>,       append<float>,         append<std::int64_t>, append<std::uint64_t>,
      append<std::int32_t>, append<std::uint32_t>, append<std::int16_t>, append<std::uint16_t>,
      append<std::int8_t>,  append<std::uint8_t>};
  std::vector<double> values;
  values.reserve(bytes.size() / size_of(type));
  if (type != NumberType::none) readers[std::size_t(type) - 1](bytes, values);
  return values;
}

/// The bytes of a file from its front.
class MatlabReader {
 public:
  MatlabReader(const std::string& file, int version, std::string_view bytes)
      : file_(file), version_(version), bytes_(bytes) {
    static_assert(std::endian::native == std::endian::little);
  }
  bool at_end() const { return bytes_.empty(); }
  std::string_view take(std::size_t count, std::string_view from) {
    if (count > bytes_.size()) fail(fmt::format("it ends within {}", from));
    const auto taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  template <class Value>
  Value number(std::string_view from) {
    Value value;
    std::memcpy(&value, take(sizeof value, from).data(), sizeof value);
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(
        fmt::format("{}: no whole MATLAB file of version {}: {}.", file_, version_, what),
        "not-an-array");
  }

 private:
  const std::string& file_;
  int version_;
  std::string_view bytes_;
};

// Matrices stand by columns, so their shapes are turned.

// A header of five numbers: kind, rows, columns, whether there are imaginary parts, length of the name.
NamedArray matrix_4(MatlabReader& reader) {
  static constexpr std::array types{NumberType::f64, NumberType::f32, NumberType::i32,
                                    NumberType::i16, NumberType::u16, NumberType::u8};
  const auto [kind, rows, columns, imaginary, length] =
      reader.number<std::array<std::int32_t, 5>>("a header");
  const int precision = kind / 10 % 10;
  if (kind < 0 || kind >= 1000 || precision >= int(types.size()) || kind % 10 > 1 || rows < 0 ||
      columns < 0 || imaginary != 0 || length < 1)
    reader.fail(
        fmt::format("a matrix of kind {}, {} by {}; allowed: real numbers and texts, little-endian",
                    kind, rows, columns));
  const auto type = types[std::size_t(precision)];
  const auto name = reader.take(std::size_t(length), "a matrix");
  // Below 2^62 of 8 bytes each: no product overflows.
  const auto count = std::size_t(rows) * std::size_t(columns);
  if (count > most_array_bytes) reader.fail("it ends within a matrix");
  return {std::string(name.substr(0, name.find('\0'))),
          {std::size_t(columns), std::size_t(rows)},
          values_of(reader.take(count * size_of(type), "a matrix"), type)};
}

struct Element {
  unsigned type;
  std::string_view bytes;
};

// NumberType and size, four bytes each, or two and at most four bytes of data behind them.
Element element_5(MatlabReader& reader) {
  constexpr unsigned compressed = 15;
  const auto type = reader.number<std::uint32_t>("a tag");
  if (const auto size = type >> 16; size != 0) {
    if (size > 4) reader.fail("a small element of more than four bytes");
    return {type & 0xffff, reader.take(4, "an element").substr(0, size)};
  }
  const std::size_t size = reader.number<std::uint32_t>("a tag");
  const auto bytes = reader.take(size, "an element");
  if (type != compressed && !reader.at_end()) reader.take((8 - size % 8) % 8, "an element");
  return {type, bytes};
}

// A matrix of real numbers; empty for what else there is, as texts, cells and structures.
NamedArray matrix_5(const std::string& file, std::string_view bytes) {
  static constexpr std::array types{
      NumberType::none, NumberType::i8,   NumberType::u8,  NumberType::i16,  NumberType::u16,
      NumberType::i32,  NumberType::u32,  NumberType::f32, NumberType::none, NumberType::f64,
      NumberType::none, NumberType::none, NumberType::i64, NumberType::u64};
  constexpr double first_class = 6, last_class = 15, is_complex = 0x800;
  MatlabReader reader(file, 5, bytes);
  const auto flags = values_of(element_5(reader).bytes, NumberType::u32);
  const auto shape = values_of(element_5(reader).bytes, NumberType::i32);
  const std::string name(element_5(reader).bytes);
  if (flags.empty() || shape.size() != 2 || !is_history_array(name)) return {};
  const double kind = std::fmod(flags[0], 256.0);
  if (kind < first_class || kind > last_class || std::fmod(flags[0], 2 * is_complex) >= is_complex)
    return {};
  const auto real = element_5(reader);
  if (real.type >= types.size()) reader.fail("numbers of an unknown type");
  NamedArray array{name, {}, values_of(real.bytes, types[real.type])};
  if (shape[0] < 0.0 || shape[1] < 0.0 || shape[0] * shape[1] != double(array.values.size()))
    reader.fail(fmt::format("{} has not the numbers of its shape", name));
  array.shape = {std::size_t(shape[1]), std::size_t(shape[0])};
  return array;
}

// What zlib made smaller.
std::string inflated(const std::string& file, MatlabReader& reader, std::string_view bytes) {
  constexpr int too_small = -5;  // Z_BUF_ERROR, which a cut stream gives as well
  constexpr std::size_t most_ratio = 1100;
  const auto uncompress =
      reinterpret_cast<int (*)(char*, unsigned long*, const char*, unsigned long)>(
          library_function(file, {"libz.so.1"}, "zlib1g", "uncompress"));
  const auto most = std::min(most_array_bytes, most_ratio * bytes.size() + 64);
  for (std::size_t room = std::min(most, 8 * bytes.size() + 64);; room = std::min(most, 4 * room)) {
    std::string text(room, '\0');
    unsigned long size = room;
    const int error = uncompress(text.data(), &size, bytes.data(), bytes.size());
    text.resize(size);
    if (error == 0) return text;
    if (error != too_small || room == most) reader.fail("a compressed matrix is damaged");
  }
}

std::vector<NamedArray> matrices_5(const std::string& file, std::string_view bytes) {
  constexpr std::size_t header = 128;
  constexpr unsigned matrix = 14, compressed = 15;
  MatlabReader reader(file, 5, bytes);
  if (reader.take(header, "its header").substr(126) != "IM")
    reader.fail("it was written on a big-endian machine");
  std::vector<NamedArray> arrays;
  while (!reader.at_end()) {
    auto element = element_5(reader);
    std::string whole;
    if (element.type == compressed) {
      whole = inflated(file, reader, element.bytes);
      MatlabReader inner(file, 5, whole);
      element = element_5(inner);
    }
    if (element.type != matrix) continue;
    if (auto array = matrix_5(file, element.bytes); !array.name.empty())
      arrays.push_back(std::move(array));
  }
  return arrays;
}

// Of Modelica: name and dataInfo have a column a variable; dataInfo says matrix, row (signed) in it.
std::vector<NamedArray> modelica_arrays(const MatlabReader& reader, const NamedArray& names,
                                        const NamedArray& info, const NamedArray* data) {
  std::vector<NamedArray> arrays;
  const auto letters = names.shape[1], facts = info.shape[1];
  for (std::size_t i = 0; i < std::min(names.shape[0], facts < 2 ? 0 : info.shape[0]); ++i) {
    std::string name;
    for (std::size_t k = 0; k < letters; ++k) name += char(int(names.values[i * letters + k]));
    name.resize(name.find_last_not_of(" \0", name.npos, 2) + 1);
    const double row = info.values[i * facts + 1];
    if (i == 0) name = "t";
    if (!is_history_array(name) || (i > 0 && info.values[i * facts] != 2.0)) continue;
    if (data == nullptr || !(std::abs(row) >= 1.0 && std::abs(row) <= double(data->shape[1])))
      reader.fail("dataInfo names a row that data_2 does not have");
    auto& array = arrays.emplace_back(NamedArray{name, {data->shape[0]}, {}});
    for (std::size_t k = 0; k < data->shape[0]; ++k)
      array.values.push_back(std::copysign(1.0, row) *
                             data->values[k * data->shape[1] + std::size_t(std::abs(row)) - 1]);
  }
  return arrays;
}

}  // namespace

ResultRows read_mat4(InputFile input, const ResultChoice& choice) {
  const auto file = input.name(), bytes = input.rest(most_array_bytes);
  MatlabReader reader(file, 4, bytes);
  std::vector<NamedArray> arrays;
  while (!reader.at_end()) arrays.push_back(matrix_4(reader));
  const auto find = [&](std::string_view name) {
    const auto found = std::ranges::find(arrays, name, &NamedArray::name);
    return found == arrays.end() ? nullptr : &*found;
  };
  const auto *names = find("name"), *info = find("dataInfo");
  return rows_of(file,
                 names != nullptr && info != nullptr
                     ? modelica_arrays(reader, *names, *info, find("data_2"))
                     : arrays,
                 choice);
}

ResultRows read_mat5(InputFile input, const ResultChoice& choice) {
  const auto file = input.name(), bytes = input.rest(most_array_bytes);
  return rows_of(file, matrices_5(file, bytes), choice);
}

}  // namespace clackers::input
