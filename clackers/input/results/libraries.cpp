#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/input/results/arrays.hpp"

namespace clackers::input {
namespace {

constexpr unsigned most_seconds = 60;

// Bytes as the child writes them: of an array its name, shape and values, each behind its count; a message.
class Bytes {
 public:
  explicit Bytes(std::string text = {}) : text_(std::move(text)) {}

  template <class List>
  void put(const List& list) {
    const std::size_t count = list.size();
    text_.append(reinterpret_cast<const char*>(&count), sizeof count);
    text_.append(reinterpret_cast<const char*>(list.data()),
                 count * sizeof(typename List::value_type));
  }
  template <class List>
  bool take(List& list) {
    std::size_t count = 0;
    if (text_.size() - at_ < sizeof count) return false;
    std::memcpy(&count, text_.data() + at_, sizeof count);
    at_ += sizeof count;
    if (count > (text_.size() - at_) / sizeof(typename List::value_type)) return false;
    list.resize(count);
    std::memcpy(list.data(), text_.data() + at_, count * sizeof(typename List::value_type));
    at_ += count * sizeof(typename List::value_type);
    return true;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t at_ = 0;
};

[[noreturn]] void run_child(int out, const std::function<std::vector<NamedArray>()>& work) {
  const rlimit none{};
  setrlimit(RLIMIT_CORE, &none);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  alarm(most_seconds);
  Bytes bytes;
  std::string message;
  std::vector<NamedArray> arrays;
  try {
    arrays = work();
  } catch (const std::exception& error) {
    message = error.what();
  }
  bytes.put(message);
  for (const auto& array : arrays) {
    bytes.put(array.name);
    bytes.put(array.shape);
    bytes.put(array.values);
  }
  for (std::size_t at = 0; at < bytes.text().size();) {
    const auto written = write(out, bytes.text().data() + at, bytes.text().size() - at);
    if (written <= 0 && errno != EINTR) _exit(1);
    if (written > 0) at += std::size_t(written);
  }
  _exit(0);
}

std::string all_of(int from) {
  std::string text;
  char part[1 << 16];
  for (;;) {
    const auto count = read(from, part, sizeof part);
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
    if (count > 0) text.append(part, std::size_t(count));
  }
}

}  // namespace

void* library_function(const std::string& file, const std::vector<const char*>& libraries,
                       const std::string& package, const char* name) {
  // It stays open until the end of the program.
  void* handle = nullptr;
  for (const auto* library : libraries)
    if (handle == nullptr) handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  auto* function = handle == nullptr ? nullptr : dlsym(handle, name);
  if (function == nullptr)
    throw FileError(fmt::format("cannot read {}: it needs a library, {}. Install it (on Debian "
                                "12 {}), or write the history as csv.",
                                file, fmt::join(libraries, " or "), package),
                    "cannot-read");
  return function;
}

std::vector<NamedArray> in_own_process(const std::string& file,
                                       const std::function<std::vector<NamedArray>()>& work) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  const Descriptor from(ends[0]);
  Descriptor to(ends[1]);
  const auto child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
  if (child == 0) run_child(ends[1], work);
  to = Descriptor();
  Bytes bytes(all_of(ends[0]));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  std::string message;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) throw Error("interrupted", "interrupted");
  if (WIFSIGNALED(status))
    message = fmt::format("the library that reads it ended by signal {} ({})", WTERMSIG(status),
                          strsignal(WTERMSIG(status)));
  else if (status != 0 || !bytes.take(message))
    message = "the library that reads it ended early";
  if (!message.empty())
    throw InputError(fmt::format("{}: no whole file of arrays: {}.", file, message),
                     "not-an-array");
  std::vector<NamedArray> arrays;
  for (NamedArray array; bytes.take(array.name);) {
    bytes.take(array.shape);
    bytes.take(array.values);
    arrays.push_back(array);
  }
  return arrays;
}

}  // namespace clackers::input
