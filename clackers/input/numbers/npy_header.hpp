#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clackers::input {

/// How a number stands in a file.
struct NpyNumber {
  char kind = 'f';       ///< f: IEEE floating point, i: signed, u: unsigned; V: no real number
  std::size_t size = 8;  ///< bytes: 4, 8 of f; 1, 2, 4, 8 of i and u
  bool swapped = false;  ///< the byte order is not this machine's
};

struct NpyColumn {
  std::string name;  ///< empty for a column of a plain array
  NpyNumber number;
  std::size_t offset = 0;  ///< of its first number from the first byte of the data
};

/// What the header of a NumPy file says of its data.
struct NpyHeader {
  std::size_t rows = 0;
  std::vector<NpyColumn> columns;
  std::size_t stride = 0;  ///< from one row to the next [bytes]
  /// Each column is in one piece (Fortran's order), not each row.
  bool by_columns = false;

  /// Bytes of the data.
  std::size_t size() const;
};

/// Largest row, so that a block of whole rows fits into memory [bytes].
inline constexpr std::size_t longest_npy_row = std::size_t{1} << 24;

/// Reads the dictionary in the header of file `name`: a plain array of one dimension (a column) or
/// two (rows, columns), or a structured array of one dimension, whose fields are the columns; a
/// field u of n numbers is the columns u1 to un, and padding is left out.
///
/// Throws InputError (not-an-array) for text that is no such dictionary, Python objects, other
/// shapes, plain arrays of anything but numbers as NpyNumber has them, more than 2^39 rows or 2^17
/// columns, and rows longer than longest_npy_row.
NpyHeader read_npy_header(const std::string& name, std::string_view text);

}  // namespace clackers::input
