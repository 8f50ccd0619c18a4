#include "clackers/base/files/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "clackers/base/error.hpp"

namespace clackers {
namespace {

std::atomic<const std::atomic<bool>*> interrupt_of_program{nullptr};

// A regular file is not waited for: it can be read after the signal, too.
const std::atomic<bool>* interrupt_for(const std::string& path) {
  std::error_code missing;
  return std::filesystem::is_regular_file(path, missing) ? nullptr : interrupt_of_program.load();
}

// Repeats a system call that a signal interrupted, unless the signal asked to stop.
auto call_again(const std::atomic<bool>* interrupt, const auto& call) {
  while (true) {
    if (interrupt != nullptr && *interrupt) throw Error("interrupted", "interrupted");
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

}  // namespace

void end_reading_on(const std::atomic<bool>& interrupt) { interrupt_of_program = &interrupt; }

InputFile::InputFile(const std::string& path, const std::atomic<bool>* interrupt,
                     std::string_view hint)
    : name_(path == "-" ? "standard input" : path),
      hint_(hint),
      interrupt_(interrupt == nullptr ? interrupt_for(path) : interrupt) {
  descriptor_ = Descriptor(call_again(interrupt_, [&] {
    // A copy of standard input, so that closing it at the end is right in both cases.
    return path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)
                       : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  }));
  if (!descriptor_.is_open()) fail(errno);
  struct stat facts {};
  if (::fstat(descriptor_.number(), &facts) != 0) fail(errno);
  if (S_ISDIR(facts.st_mode)) fail(EISDIR);
  if (!S_ISREG(facts.st_mode)) return;
  start_ = ::lseek(descriptor_.number(), 0, SEEK_CUR);
  size_ = std::max(0LL, static_cast<long long>(facts.st_size) - start_);
}

void InputFile::fail(const std::string& reason) const {
  throw FileError(
      fmt::format("cannot read {}: {}.{}{}", name_, reason, hint_.empty() ? "" : " ", hint_),
      "cannot-read");
}

void InputFile::fail(int error) const { fail(std::generic_category().message(error)); }

std::string_view InputFile::first_bytes(std::size_t count) {
  std::string bytes(count, '\0');
  bytes.resize(read_all(bytes.data(), count));
  first_.insert(0, bytes);  // before those that an earlier, longer look left
  return std::string_view(first_).substr(0, bytes.size());
}

std::size_t InputFile::read(char* bytes, std::size_t capacity) {
  if (!first_.empty()) {
    const auto taken = first_.copy(bytes, capacity);
    first_.erase(0, taken);
    return taken;
  }
  const auto count =
      call_again(interrupt_, [&] { return ::read(descriptor_.number(), bytes, capacity); });
  if (count < 0) fail(errno);
  return static_cast<std::size_t>(count);
}

std::size_t InputFile::read_all(char* bytes, std::size_t count) {
  std::size_t have = 0;
  for (std::size_t last = 1; last > 0 && have < count; have += last)
    last = read(bytes + have, count - have);
  return have;
}

std::size_t InputFile::read_all_at(std::size_t place, char* bytes, std::size_t count) {
  std::size_t have = 0;
  while (have < count) {
    const auto from = start_ + static_cast<long long>(place + have);
    const auto last = call_again(interrupt_, [&] {
      return ::pread(descriptor_.number(), bytes + have, count - have, from);
    });
    if (last < 0) fail(errno);
    if (last == 0) break;
    have += static_cast<std::size_t>(last);
  }
  return have;
}

std::string InputFile::rest(std::size_t most) {
  std::string bytes;
  for (std::size_t size = 0, count = 1; count > 0; size += count) {
    if (size > most) fail(fmt::format("it is too large; allowed: {} bytes", most));
    bytes.resize(size + (1 << 16));
    count = read(bytes.data() + size, bytes.size() - size);
    if (count == 0) bytes.resize(size);
  }
  return bytes;
}

}  // namespace clackers
