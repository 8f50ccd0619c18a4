#include "clackers/base/files/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "clackers/base/error.hpp"
#include "clackers/base/files/input_file.hpp"

namespace clackers {
namespace {

[[noreturn]] void fail_to_write(const std::string& path, int error) {
  throw FileError(fmt::format("cannot write {}: {}.", path, std::generic_category().message(error)),
                  "cannot-write");
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
  return InputFile(path == "-" ? "./-" : path, nullptr, hint).rest(most);
}

void write_file(const std::string& path, std::string_view bytes) {
  const Descriptor file(call_again(
      [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666); }));
  if (!file.is_open()) fail_to_write(path, errno);
  while (!bytes.empty()) {
    const auto count =
        call_again([&] { return ::write(file.number(), bytes.data(), bytes.size()); });
    if (count < 0) fail_to_write(path, errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace clackers
