#include "clackers/input/numbers/npy_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"
#include "clackers/input/numbers/npy_file.hpp"
#include "clackers/input/numbers/python_literal.hpp"

namespace clackers::input {
namespace {

using List = PythonLiteral::List;

// So that the bytes of all rows are a std::size_t, and that a short header cannot fill the memory.
constexpr std::size_t most_rows = std::size_t{1} << 39, most_columns = std::size_t{1} << 17;

class HeaderReader {
 public:
  HeaderReader(const std::string& name, std::string_view text)
      : name_(name), literal_(read_python_literal(name, text)) {}

  NpyHeader run() {
    const auto* by_columns = member("fortran_order").as<bool>();
    if (by_columns == nullptr) fail("its fortran_order is neither True nor False");
    const auto shape = numbers(member("shape"));
    const auto& type = member("descr");
    const auto* fields = type.as<List>();
    const std::size_t dimensions = fields != nullptr ? 1 : 2;
    if (shape.empty() || shape.size() > dimensions)
      fail(fmt::format("its shape is ({}); allowed: {}", fmt::join(shape, ", "),
                       fields != nullptr ? "(rows,) of a structured array"
                                         : "(rows, columns), or (rows,) of one column"));
    header_.rows = shape[0];
    if (header_.rows > most_rows) fail(fmt::format("it has {} rows", header_.rows));
    if (fields != nullptr)
      for (const auto& field : *fields) take_field(field);
    else
      take_plain(type, shape.size() == 2 ? shape[1] : 1, *by_columns);
    if (header_.columns.empty() || header_.stride == 0) fail("it has no columns");
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{} is no NumPy file that can be read: {}. Save numbers with "
                                 "numpy.save, such as a structured array with fields t, u1, v1.",
                                 name_, what),
                     "not-an-array");
  }

  const PythonLiteral& member(std::string_view key) const {
    if (const auto* members = literal_.as<PythonLiteral::Dictionary>())
      for (std::size_t i = 0; i < members->keys.size(); ++i)
        if (members->keys[i] == key) return members->values[i];
    fail(fmt::format("its header has no {}", key));
  }

  std::vector<std::size_t> numbers(const PythonLiteral& literal) const {
    std::vector<std::size_t> numbers;
    const auto* list = literal.as<List>();
    if (list == nullptr) fail("a shape in its header is no tuple");
    for (const auto& item : *list) {
      const auto* number = item.as<long long>();
      if (number == nullptr) fail("a shape in its header holds more than whole numbers");
      numbers.push_back(std::size_t(*number));
    }
    return numbers;
  }

  // "<f8" as numpy.dtype.str has it.
  NpyNumber number(const PythonLiteral& literal) const {
    const auto* type = literal.as<std::string>();
    if (type == nullptr || type->size() < 2) fail("a dtype in its header is none");
    NpyNumber number{(*type)[1], 0, false};
    const auto size = std::string_view(*type).substr(2);
    const auto [stop, error] = std::from_chars(size.data(), size.data() + size.size(), number.size);
    const char order = (*type)[0];
    if (number.kind == 'O')
      fail(
          "it holds Python objects (dtype object), which are never unpickled, since that can run "
          "a program; convert them with a.astype(float)");
    if (std::string_view("<>|").find(order) == std::string_view::npos || error != std::errc() ||
        number.size > longest_npy_row)
      fail(fmt::format("its dtype is \"{}\"", printable(*type)));
    // A character of U has four bytes; times name their unit behind the size.
    if (number.kind == 'U') number.size *= 4;
    number.swapped = order == (std::endian::native == std::endian::little ? '>' : '<');
    const bool is_whole = number.kind == 'i' || number.kind == 'u';
    const bool known =
        stop == size.data() + size.size() &&
        (number.kind == 'f' ? number.size == 4 || number.size == 8
                            : is_whole && std::has_single_bit(number.size) && number.size <= 8);
    if (!known) number.kind = 'V';
    return number;
  }

  void take_plain(const PythonLiteral& type, std::size_t columns, bool by_columns) {
    const auto kind = number(type);
    if (kind.kind == 'V')
      fail(fmt::format("its dtype is \"{}\"; allowed: {}", printable(*type.as<std::string>()),
                       NpyFile::allowed_numbers));
    if (columns > most_columns)
      fail(fmt::format("it has {} columns; rows are times, columns are t, u1, v1", columns));
    header_.by_columns = by_columns;
    header_.stride = by_columns ? kind.size : columns * kind.size;
    for (std::size_t i = 0; i < columns; ++i)
      header_.columns.push_back({{}, kind, i * kind.size * (by_columns ? header_.rows : 1)});
  }

  // (name, dtype) or (name, dtype, shape); name may be (title, name).
  void take_field(const PythonLiteral& literal) {
    const auto* field = literal.as<List>();
    if (field == nullptr || field->size() < 2 || field->size() > 3)
      fail("a field in its header is none");
    const auto* titled = field->front().as<List>();
    const auto* name = (titled != nullptr && titled->size() == 2 ? (*titled)[1] : field->front())
                           .as<std::string>();
    if (name == nullptr) fail("a field in its header has no name");
    if ((*field)[1].as<std::string>() == nullptr)
      fail(fmt::format("its field {} has fields of its own", printable(*name)));
    const auto kind = number((*field)[1]);
    const auto shape = field->size() == 3 ? numbers(field->back()) : std::vector<std::size_t>{};
    std::size_t count = 1;
    for (const auto length : shape)
      count = std::min(most_columns + 1, count * std::min(most_columns + 1, length));
    if (count > most_columns || count * kind.size > longest_npy_row - header_.stride ||
        header_.columns.size() + count > most_columns)
      fail(fmt::format("its rows have more than {} bytes or {} numbers", longest_npy_row,
                       most_columns));
    const auto from = header_.stride;
    header_.stride += count * kind.size;
    if (name->empty()) return;  // padding
    if (shape.size() > 1) {
      header_.columns.push_back({*name, {'V', 1, false}, from});
      return;
    }
    for (std::size_t i = 0; i < count; ++i)
      header_.columns.push_back(
          {shape.empty() ? *name : fmt::format("{}{}", *name, i + 1), kind, from + i * kind.size});
  }

  const std::string& name_;
  PythonLiteral literal_;
  NpyHeader header_;
};

}  // namespace

std::size_t NpyHeader::size() const { return rows * stride * (by_columns ? columns.size() : 1); }

NpyHeader read_npy_header(const std::string& name, std::string_view text) {
  return HeaderReader(name, text).run();
}

}  // namespace clackers::input
