#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <regex>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"
#include "clackers/input/results/result_reader.hpp"

namespace clackers::input {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 31;

// A matrix of a MATLAB file of version 4, by columns.
struct Matrix {
  std::string name;
  std::size_t rows, columns;
  std::string_view bytes;
  int precision;  // 0 double, 1 float, 2 int32, 3 int16, 4 uint16, 5 uint8

  static constexpr std::array<std::size_t, 6> sizes{8, 4, 4, 2, 2, 1};

  double at(std::size_t row, std::size_t column) const {
    const auto* from = bytes.data() + (column * rows + row) * sizes[std::size_t(precision)];
    const auto as = [&](auto value) {
      std::memcpy(&value, from, sizeof value);
      return double(value);
    };
    switch (precision) {
      case 0:
        return as(double{});
      case 1:
        return as(float{});
      case 2:
        return as(std::int32_t{});
      case 3:
        return as(std::int16_t{});
      case 4:
        return as(std::uint16_t{});
      default:
        return as(std::uint8_t{});
    }
  }
  // Of a text matrix of Modelica, which has a name a column.
  std::string text(std::size_t column) const {
    std::string text;
    for (std::size_t i = 0; i < rows; ++i) text += char(int(at(i, column)));
    return text.substr(0, text.find_last_not_of(" \0", text.npos, 2) + 1);
  }
};

class File {
 public:
  File(InputFile file) : name_(file.name()), bytes_(file.rest(most_bytes)) {
    static_assert(std::endian::native == std::endian::little);
    for (std::size_t at = 0; at < bytes_.size();) at = take(at);
  }
  const Matrix* find(std::string_view name) const {
    const auto found = std::ranges::find(matrices_, name, &Matrix::name);
    return found == matrices_.end() ? nullptr : &*found;
  }
  const std::vector<Matrix>& matrices() const { return matrices_; }
  const std::string& name() const { return name_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: no whole MATLAB file of version 4: {}.", name_, what),
                     "not-an-array");
  }

 private:
  // The header is five numbers: kind, rows, columns, whether there are imaginary parts, length of the name.
  std::size_t take(std::size_t at) {
    std::array<std::int32_t, 5> head{};
    if (bytes_.size() - at < sizeof head) fail("it ends within a header");
    std::memcpy(head.data(), bytes_.data() + at, sizeof head);
    at += sizeof head;
    const auto [kind, rows, columns, imaginary, length] = head;
    const int precision = kind / 10 % 10;
    if (kind < 0 || kind >= 1000 || precision > 5 || kind % 10 > 1 || rows < 0 || columns < 0 ||
        imaginary != 0 || length < 1)
      fail(fmt::format(
          "a matrix of kind {}, {} by {}; allowed: real numbers and texts, little-endian", kind,
          rows, columns));
    const auto left = bytes_.size() - at;
    const auto size = Matrix::sizes[std::size_t(precision)];
    if (std::size_t(length) > left ||
        (columns > 0 &&
         std::size_t(rows) > (left - std::size_t(length)) / size / std::size_t(columns)))
      fail("it ends within a matrix");
    const std::string_view all = bytes_;
    const auto name = all.substr(at, std::size_t(length));
    at += std::size_t(length);
    const auto count = std::size_t(rows) * std::size_t(columns) * size;
    matrices_.push_back({std::string(name.substr(0, name.find('\0'))), std::size_t(rows),
                         std::size_t(columns), all.substr(at, count), precision});
    return at + count;
  }

  std::string name_, bytes_;
  std::vector<Matrix> matrices_;
};

Number real(double value) { return {value, value == 0.0 ? 0 : 17}; }

// "u[2]" and "u2" are u2, "time" is t; empty for others.
std::string column_name(const std::string& name) {
  static const std::regex pattern(R"(([uva])\[?([0-9]{1,4})\]?)");
  if (std::smatch parts; std::regex_match(name, parts, pattern))
    return parts[1].str() + parts[2].str();
  return name == "time" || name == "t" ? "t" : "";
}

struct Column {
  std::string name;
  const Matrix* matrix;
  std::size_t index;
  bool by_rows;  // a variable is a row, a time a column
  double sign = 1.0;
};

// Of Modelica: name and dataInfo have a column a variable; dataInfo says matrix, row (signed) in it.
std::vector<Column> modelica_columns(const File& file, const Matrix& names, const Matrix& info) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < std::min(names.columns, info.columns); ++i) {
    const auto name = i == 0 ? "t" : column_name(names.text(i));
    const double row = info.rows < 2 ? 0.0 : info.at(1, i);
    const auto* data = file.find("data_2");
    if (name.empty() || (i > 0 && info.at(0, i) != 2.0)) continue;
    if (data == nullptr || !(std::abs(row) >= 1.0 && std::abs(row) <= double(data->rows)))
      file.fail("dataInfo names a row that data_2 does not have");
    columns.push_back({name, data, std::size_t(std::abs(row)) - 1, true, row < 0.0 ? -1.0 : 1.0});
  }
  return columns;
}

// Of others: t with a row or column of numbers, u with a column a mass or u1, u2, ...
std::vector<Column> plain_columns(const File& file) {
  std::vector<Column> columns;
  for (const auto& matrix : file.matrices()) {
    const bool by_rows = matrix.rows == 1;
    if (const auto name = column_name(matrix.name);
        !name.empty() && (by_rows || matrix.columns == 1))
      columns.push_back({name, &matrix, 0, by_rows});
    else if (matrix.name == "u" || matrix.name == "v" || matrix.name == "a")
      for (std::size_t j = 0; j < matrix.columns; ++j)
        columns.push_back({fmt::format("{}{}", matrix.name, j + 1), &matrix, j, false});
  }
  return columns;
}

}  // namespace

ResultRows read_mat4(InputFile input, const ResultChoice&) {
  const File file(std::move(input));
  const auto *names = file.find("name"), *info = file.find("dataInfo");
  const auto columns = names != nullptr && info != nullptr ? modelica_columns(file, *names, *info)
                                                           : plain_columns(file);
  if (columns.empty()) file.fail("it has no variables t, u[1], u[2], ... or t, u");
  ResultRows rows;
  const auto count_of = [](const Column& c) {
    return c.by_rows ? c.matrix->columns : c.matrix->rows;
  };
  for (const auto& column : columns) {
    if (count_of(column) != count_of(columns[0]))
      file.fail(fmt::format("{} and {} have different lengths", columns[0].name, column.name));
    rows.names.push_back(column.name);
  }
  for (std::size_t i = 0; i < count_of(columns[0]); ++i)
    for (const auto& column : columns)
      rows.numbers.push_back(
          real(column.sign * (column.by_rows ? column.matrix->at(column.index, i)
                                             : column.matrix->at(i, column.index))));
  return rows;
}

}  // namespace clackers::input
