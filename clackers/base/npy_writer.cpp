#include "clackers/base/npy_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clackers {

// Magic, version, length of the rest, then a Python literal and spaces, so that the numbers start at a
// multiple of 64 bytes. Version 2 has four bytes for the length instead of two.
std::string npy_header(const std::vector<std::string>& names, long long rows, long long most_rows) {
  std::string fields;
  for (const auto& name : names) fields += fmt::format("('{}', '<f8'), ", name);
  auto text =
      fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({},), }}", fields, rows);
  const auto digits = fmt::to_string(rows).size();
  text.append(std::max(digits, fmt::to_string(most_rows).size()) - digits, ' ');
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

}  // namespace clackers
