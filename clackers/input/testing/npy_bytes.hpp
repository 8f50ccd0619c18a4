#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

// For tests that read NumPy files.
namespace clackers::input {

/// The numbers as they stand in memory, one after the other; `swapped` in the other byte order.
template <class Number>
std::string bytes_of(const std::vector<Number>& numbers, bool swapped = false) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  if (swapped)
    for (auto at = bytes.begin(); at != bytes.end(); at += sizeof(Number))
      std::reverse(at, at + sizeof(Number));
  return bytes;
}

/// A NumPy file with a header of any text.
inline std::string npy_with_header(const std::string& header, const std::string& data,
                                   char version = 1) {
  std::string text("\x93NUMPY");
  text += version;
  text += '\0';
  const int bytes = version == 1 ? 2 : 4;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(header.size() >> (8 * i) & 0xff);
  return text + header + data;
}

/// A NumPy file as numpy.save writes it: `type` is a dtype such as "'<f8'" or "[('t', '<f8')]",
/// `shape` "(3,)".
inline std::string npy(std::string_view type, std::string_view shape, const std::string& data,
                       bool by_columns = false, char version = 1) {
  return npy_with_header(fmt::format("{{'descr': {}, 'fortran_order': {}, 'shape': {}, }}     \n",
                                     type, by_columns ? "True" : "False", shape),
                         data, version);
}

}  // namespace clackers::input
