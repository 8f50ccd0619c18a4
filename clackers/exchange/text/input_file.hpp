#pragma once

#include <atomic>
#include <cstddef>
#include <string>

namespace clackers::exchange {

/// What messages call a path: "standard input" for "-".
std::string shown_name(const std::string& path);

/// A file that is read once, from its beginning to its end; "-" is standard input.
///
/// Where reading waits for another program (a pipe, a terminal), a signal ends it: Error with code
/// interrupted once `interrupt` is true.
class InputFile {
 public:
  /// Throws FileError (cannot-read) with the system's reason for a file that cannot be opened, a
  /// folder among them.
  InputFile(const std::string& path, const std::atomic<bool>* interrupt);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Reads at most `capacity` bytes and returns their number, 0 at the end. Throws FileError.
  std::size_t read(char* bytes, std::size_t capacity);
  /// The path, or "standard input".
  const std::string& name() const { return name_; }
  /// In bytes; 0 when it is no regular file.
  long long size() const { return size_; }

 private:
  std::string name_;
  const std::atomic<bool>* interrupt_;
  int descriptor_ = -1;
  long long size_ = 0;
};

}  // namespace clackers::exchange
