#include <fmt/format.h>

#include <bit>
#include <ostream>
#include <stdexcept>

#include "clackers/base/error.hpp"
#include "clackers/report/rows/rows.hpp"

namespace clackers::report {
namespace {

// Magic, version 1.0, length of the rest, then a Python literal and spaces, so that the numbers
// start at a multiple of 64 bytes.
std::string header(const std::vector<study::Column>& columns, long long rows) {
  std::string fields;
  for (const auto& column : columns) fields += fmt::format("('{}', '<f8'), ", column.name);
  auto text =
      fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({},), }}", fields, rows);
  constexpr std::size_t prefix = 10, unit = 64;
  text.append(unit - (prefix + text.size() + 1) % unit, ' ');
  text += '\n';
  const auto size = text.size();
  return std::string("\x93NUMPY\x01\x00", 8) + char(size % 256) + char(size / 256) + text;
}

}  // namespace

void write_npy(study::RowSource& rows, std::ostream& out) {
  static_assert(std::endian::native == std::endian::little);
  auto* const numbers = rows.numbers();
  if (numbers == nullptr)
    throw InputError("format npy: these rows hold text; allowed: rows of numbers. Use csv or json.",
                     "bad-syntax");
  out << header(rows.columns(), numbers->count());
  std::vector<double> values;
  while (out && numbers->next_block(values))
    out.write(reinterpret_cast<const char*>(values.data()),
              std::streamsize(values.size() * sizeof(double)));
}

}  // namespace clackers::report
