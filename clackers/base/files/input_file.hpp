#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>

#include "clackers/base/files/files.hpp"

namespace clackers {

/// From here on a wait for another program, by files without an interrupt of their own, ends with Error
/// (interrupted) once `interrupt` is true. For a program that catches signals.
void end_reading_on(const std::atomic<bool>& interrupt);

/// A file that is read once, from its beginning to its end; "-" is standard input.
///
/// A signal ends it: Error with code interrupted once `interrupt` is true. Without one, the flag of
/// end_reading_on() ends only what waits for another program (a pipe, a terminal).
class InputFile {
 public:
  /// Throws FileError (cannot-read) with the system's reason and `hint` for a file that cannot be
  /// opened, a folder among them.
  explicit InputFile(
      const std::string& path, const std::atomic<bool>* interrupt = nullptr,
      std::string_view hint = "Name a file that exists and may be read, or - for standard input.");

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
  /// All that is left. Throws FileError for more than `most` bytes.
  std::string rest(std::size_t most);
  /// The path, or "standard input".
  const std::string& name() const { return name_; }
  /// In bytes from where it was opened; 0 when it is no regular file.
  long long size() const { return size_; }

 private:
  [[noreturn]] void fail(const std::string& reason) const;
  [[noreturn]] void fail(int error) const;

  std::string name_, hint_;
  const std::atomic<bool>* interrupt_;
  Descriptor descriptor_;
  long long size_ = 0;
  long long start_ = 0;  ///< standard input may have been read from before
  std::string first_;    ///< bytes that read() returns before those of the descriptor
};

}  // namespace clackers
