#include "clackers/base/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "clackers/base/error.hpp"

namespace clackers {
namespace {

[[noreturn]] void fail(const char* what, const std::string& path, int error, Code code,
                       std::string_view hint = {}) {
  throw FileError(
      fmt::format("cannot {} {}: {}.{}{}", what, path, std::generic_category().message(error),
                  hint.empty() ? "" : " ", hint),
      code);
}

// Repeats a system call that a signal interrupted.
auto call_again(const auto& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace

void Descriptor::close() {
  if (number_ >= 0) ::close(std::exchange(number_, -1));
}

std::string read_file(const std::string& path, std::string_view hint, std::size_t most) {
  const Descriptor file(
      call_again([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY); }));
  if (!file.is_open()) fail("read", path, errno, "cannot-read", hint);
  constexpr std::size_t block = 1 << 16;
  std::string bytes;
  for (std::size_t size = 0;;) {
    bytes.resize(size + block);
    const auto count =
        call_again([&] { return ::read(file.number(), bytes.data() + size, block); });
    if (count < 0) fail("read", path, errno, "cannot-read", hint);
    size += static_cast<std::size_t>(count);
    if (size > most) fail("read", path, EFBIG, "cannot-read", hint);
    if (count > 0) continue;
    bytes.resize(size);
    return bytes;
  }
}

void write_file(const std::string& path, std::string_view bytes) {
  const Descriptor file(call_again(
      [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666); }));
  if (!file.is_open()) fail("write", path, errno, "cannot-write");
  while (!bytes.empty()) {
    const auto count =
        call_again([&] { return ::write(file.number(), bytes.data(), bytes.size()); });
    if (count < 0) fail("write", path, errno, "cannot-write");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace clackers
