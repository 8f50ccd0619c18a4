#pragma once

#include <array>
#include <exception>
#include <ostream>
#include <streambuf>
#include <string>

namespace clackers::cli {

/// Thrown when the reader of a pipe has gone (`clackers list | head -1`): nobody wants the rest.
class BrokenPipe : public std::exception {
 public:
  const char* what() const noexcept override { return "broken pipe"; }
};

/// What a stream does when a signal asked to stop.
enum class OnInterrupt {
  stop,   ///< throw Interrupted at the next buffer that is written
  finish  ///< write everything all the same
};

/// The bytes behind OutputStream.
class DescriptorBuffer : public std::streambuf {
 public:
  DescriptorBuffer(int descriptor, std::string name, OnInterrupt on_interrupt);
  /// Throws what went wrong earlier, if a writer swallowed it.
  void rethrow_failure() const;

 protected:
  int_type overflow(int_type byte) override;
  int sync() override;

 private:
  void write_out();

  int descriptor_;
  std::string name_;
  OnInterrupt on_interrupt_;
  std::exception_ptr failure_;
  std::array<char, 1 << 16> bytes_;
};

/// A stream on an open file descriptor whose errors are thrown where they happen: FileError with
/// the name of the file and the system's reason, BrokenPipe, Interrupted.
class OutputStream : public std::ostream {
 public:
  /// The descriptor is not closed. `name` is what messages call it: "standard output".
  OutputStream(int descriptor, std::string name, OnInterrupt on_interrupt);
  /// Writes what is buffered and throws if anything failed until now.
  void finish();

 private:
  DescriptorBuffer buffer_;
};

}  // namespace clackers::cli
