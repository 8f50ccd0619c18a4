#include "clackers/exchange/text/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "clackers/base/error.hpp"

namespace clackers::exchange {
namespace {

[[noreturn]] void fail_to_read(const std::string& name, int error) {
  throw FileError(fmt::format("cannot read {}: {}. Name a text file that exists and may be read, "
                              "or - for standard input.",
                              name, std::generic_category().message(error)),
                  "cannot-read");
}

// Repeats a system call that a signal interrupted, unless the signal asked to stop.
template <class Call>
auto call_again(const std::atomic<bool>* interrupt, const Call& call) {
  while (true) {
    if (interrupt != nullptr && *interrupt) throw Error("interrupted", "interrupted");
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

}  // namespace

std::string shown_name(const std::string& path) { return path == "-" ? "standard input" : path; }

InputFile::InputFile(const std::string& path, const std::atomic<bool>* interrupt)
    : name_(shown_name(path)), interrupt_(interrupt) {
  descriptor_ = call_again(interrupt_, [&] {
    // A copy of standard input, so that closing it at the end is right in both cases.
    return path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)
                       : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  });
  if (descriptor_ < 0) fail_to_read(name_, errno);
  struct stat facts {};
  if (::fstat(descriptor_, &facts) != 0 || S_ISDIR(facts.st_mode)) {
    const int error = S_ISDIR(facts.st_mode) ? EISDIR : errno;
    ::close(descriptor_);
    fail_to_read(name_, error);
  }
  if (S_ISREG(facts.st_mode)) size_ = facts.st_size;
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::read(char* bytes, std::size_t capacity) {
  const auto count = call_again(interrupt_, [&] { return ::read(descriptor_, bytes, capacity); });
  if (count < 0) fail_to_read(name_, errno);
  return static_cast<std::size_t>(count);
}

}  // namespace clackers::exchange
