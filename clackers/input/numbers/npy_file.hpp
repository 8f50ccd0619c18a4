#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/files/input_file.hpp"
#include "clackers/input/numbers/npy_header.hpp"
#include "clackers/input/source.hpp"

namespace clackers::input {

/// The first bytes of every NumPy file.
inline constexpr std::string_view npy_magic = "\x93NUMPY";

/// The numbers of a NumPy file (.npy, versions 1 to 3) as doubles, read a block of rows at a time,
/// so that the file is never in memory as a whole (unless it comes through a pipe in Fortran's
/// order).
class NpyFile {
 public:
  /// What a column may hold, for messages.
  static constexpr std::string_view allowed_numbers =
      "floating-point numbers of 4 or 8 bytes and whole numbers (f4, f8, i1 to i8, u1 to u8)";

  /// Reads the header; `file` stands at its first byte. Throws InputError (not-an-array) as
  /// read_npy_header() does, and for another version and a file that is shorter or longer than its
  /// header says.
  explicit NpyFile(InputFile file);

  const std::string& name() const { return file_.name(); }
  /// Of all blocks together.
  std::size_t rows() const { return header_.rows; }
  /// The file has been found to hold all rows; false for a pipe.
  bool size_is_known() const { return file_.size() > 0; }

  /// The present block: its rows and all columns, 0 rows before the first block. A column without
  /// real numbers has no pointer. Valid as long as this object stays where it is and until the next
  /// block.
  const NumberColumns& block() const { return block_; }
  /// Reads the next block, at least one row; a row must be left.
  void next_block();

 private:
  [[noreturn]] void fail_short() const;
  [[noreturn]] void fail_long() const;
  void read_header();
  void read_whole();
  void read_data(std::size_t offset, std::size_t count);
  std::size_t rows_left() const { return header_.rows - end_; }

  InputFile file_;
  NpyHeader header_;
  std::size_t data_ = 0;     ///< where the data begin in the file [bytes]
  std::size_t end_ = 0;      ///< rows of all blocks so far
  std::vector<char> whole_;  ///< the data, of a pipe in Fortran's order
  std::vector<char> bytes_;
  std::vector<double> numbers_;
  NumberColumns block_;
};

}  // namespace clackers::input
