#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace clackers::study {

/// A table of numbers in a file that appears whole or not at all: csv, with the digits that read back
/// to the same double.
class NumberFile {
 public:
  /// Nothing is written before the first row is full.
  explicit NumberFile(std::filesystem::path path);
  ~NumberFile();
  NumberFile(const NumberFile&) = delete;
  NumberFile& operator=(const NumberFile&) = delete;

  void add(std::string_view name);
  void add(double value);
  void add(const double* values, int count);
  void end_row();

  std::size_t size() const { return written_ + buffer_.size(); }  ///< [bytes]
  /// Puts the file in its place. Throws FileError.
  void commit();

 private:
  void flush();

  std::filesystem::path path_, temporary_;
  std::ofstream file_;
  std::string buffer_;
  std::size_t written_ = 0;
};

}  // namespace clackers::study
