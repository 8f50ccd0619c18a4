#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace clackers::solvers {

/// A table of doubles in a NumPy file that appears whole or not at all.
class NumberFile {
 public:
  explicit NumberFile(std::filesystem::path path);
  ~NumberFile();
  NumberFile(const NumberFile&) = delete;
  NumberFile& operator=(const NumberFile&) = delete;

  /// Before the first row.
  void set_names(std::vector<std::string> names);
  /// A row has a number for each name.
  void add(double value) { buffer_.push_back(value); }
  void add(const double* values, int count) {
    buffer_.insert(buffer_.end(), values, values + count);
  }
  void end_row();

  /// Of the numbers [bytes].
  std::size_t size() const { return (written_ + buffer_.size()) * sizeof(double); }
  /// Puts the file in its place. Throws FileError.
  void commit();

 private:
  std::string header() const;
  void flush();

  std::filesystem::path path_, temporary_;
  std::ofstream file_;
  std::vector<std::string> names_;
  std::vector<double> buffer_;
  std::size_t written_ = 0;  ///< numbers
};

}  // namespace clackers::solvers
