#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>

#include "clackers/base/files.hpp"

namespace clackers::input {

/// A file that is read once, from its beginning to its end; "-" is standard input.
///
/// Where reading waits for another program (a pipe, a terminal), a signal ends it: Error with code
/// interrupted once `interrupt` is true.
class InputFile {
 public:
  /// Throws FileError (cannot-read) with the system's reason for a file that cannot be opened, a
  /// folder among them.
  InputFile(const std::string& path, const std::atomic<bool>* interrupt);

  /// The first bytes, as many as there are up to `count`, before anything is read; they will be
  /// read again. Throws FileError.
  std::string_view first_bytes(std::size_t count);
  /// Reads at most `capacity` bytes and returns their number, 0 at the end. Throws FileError.
  std::size_t read(char* bytes, std::size_t capacity);
  /// Reads as many as `count` bytes, fewer only at the end, and returns their number.
  std::size_t read_all(char* bytes, std::size_t count);
  /// The same from a place of a regular file, counted from where it was opened; read() goes on where
  /// it was.
  std::size_t read_all_at(std::size_t place, char* bytes, std::size_t count);
  /// The path, or "standard input".
  const std::string& name() const { return name_; }
  /// In bytes from where it was opened; 0 when it is no regular file.
  long long size() const { return size_; }

 private:
  std::string name_;
  const std::atomic<bool>* interrupt_;
  Descriptor descriptor_;
  long long size_ = 0;
  long long start_ = 0;  ///< standard input may have been read from before
  std::string first_;    ///< bytes that read() returns before those of the descriptor
};

}  // namespace clackers::input
