#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace clackers {

/// An open file descriptor, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  void close();
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

/// Bytes that a text of a person or a program may have, and a file of any kind: /dev/zero must not
/// fill the memory.
inline constexpr std::size_t longest_text = std::size_t{1} << 24,
                             longest_file = std::size_t{1} << 30;

/// The whole of a file. Throws FileError (cannot-read) with its name, the system's reason and `hint`
/// for one that cannot be read or has more than `most` bytes; Error (interrupted), see InputFile.
std::string read_file(const std::string& path, std::string_view hint = {},
                      std::size_t most = longest_text);

/// Writes a whole file. Throws FileError (cannot-write) with its name and the system's reason.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace clackers
