#include <fmt/format.h>

#include <bit>
#include <ostream>
#include <string>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/report/writers.hpp"

namespace clackers::report {
namespace {

// Magic, version, length of the rest, then a Python literal and spaces, so that the numbers start at a
// multiple of 64 bytes. Version 2 has four bytes for the length instead of two.
std::string npy_header(const std::vector<std::string>& names, long long rows) {
  std::string fields;
  for (const auto& name : names) fields += fmt::format("('{}', '<f8'), ", name);
  auto text =
      fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({},), }}", fields, rows);
  constexpr std::size_t unit = 64, longest = 0xffff;
  std::size_t prefix = 10;
  if (text.size() + unit > longest) prefix = 12;
  text.append(unit - (prefix + text.size() + 1) % unit, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  if (prefix == 12) header[6] = '\x02';
  for (std::size_t i = 8; i < prefix; ++i)
    header += static_cast<char>((text.size() >> (8 * (i - 8))) & 0xff);
  return header + text;
}

}  // namespace

void write_npy(record::RowSource& rows, std::ostream& out) {
  static_assert(std::endian::native == std::endian::little);
  auto* const numbers = rows.numbers();
  if (numbers == nullptr)
    throw InputError("format npy: these rows hold text; allowed: rows of numbers. Use csv or json.",
                     "bad-syntax");
  std::vector<std::string> names;
  for (const auto& column : rows.columns()) names.push_back(column.name);
  out << npy_header(names, numbers->count());
  std::vector<double> values;
  while (out && numbers->next_block(values))
    out.write(reinterpret_cast<const char*>(values.data()),
              std::streamsize(values.size() * sizeof(double)));
}

}  // namespace clackers::report
