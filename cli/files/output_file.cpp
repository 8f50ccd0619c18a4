#include "cli/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <utility>

#include "cli/files/paths.hpp"

namespace clackers::cli {
namespace {

// The descriptor that /dev/stdout, /dev/stderr or /dev/fd/N stands for, or -1. Opening these by
// name would start at the beginning of a redirected file.
int named_descriptor(const std::string& path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  int number = -1, length = 0;
  if (std::sscanf(path.c_str(), "/dev/fd/%9d%n", &number, &length) == 1 &&
      std::size_t(length) == path.size())
    return number;
  return -1;
}

// A name by which a file without one can be reached.
std::string name_in_proc(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

}  // namespace

OutputFile::OutputFile(std::string path, OnInterrupt on_interrupt)
    : path_(std::move(path)), target_(followed(path_)) {
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  // A name that is too long, a loop of links, a file as folder: the temporary name hides these.
  if (!exists && errno != ENOENT) fail_to_write(path_, errno);
  if (exists && S_ISDIR(status.st_mode)) fail_to_write(path_, EISDIR);
  is_device_ = named_descriptor(path_) >= 0 || (exists && !S_ISREG(status.st_mode));
  is_device_ ? open_device() : open_temporary();
  stream_ = std::make_unique<OutputStream>(descriptor_.number(), path_, on_interrupt);
}

OutputFile::~OutputFile() {
  if (temporary_) ::unlink(temporary_->path().c_str());
}

void OutputFile::open_device() {
  const int already_open = named_descriptor(path_);
  int number = -1;
  do {
    if (interrupt_flag()) throw Interrupted();  // a pipe without a reader waits
    number = already_open >= 0 ? ::fcntl(already_open, F_DUPFD_CLOEXEC, 3)
                               : ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  } while (number < 0 && errno == EINTR);
  if (number < 0) fail_to_write(path_, errno);
  descriptor_ = Descriptor(number);
}

void OutputFile::open_temporary() {
  struct stat old {};
  const bool replaces = ::stat(target_.c_str(), &old) == 0;
  // The folder's permission alone would let a write-protected file be replaced.
  if (replaces && ::access(target_.c_str(), W_OK) != 0) fail_to_write(path_, errno);
  int number = ::open(target_.parent_path().c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
  if (number >= 0 && ::access(name_in_proc(number).c_str(), F_OK) != 0) {
    ::close(number);
    number = -1;
  }
  if (number < 0) number = open_named();
  descriptor_ = Descriptor(number);
  if (replaces) ::fchmod(number, old.st_mode & 0777);
}

// The exclusive way: a file or link that exists is never opened.
int OutputFile::open_named() {
  while (true) {
    temporary_.emplace(temporary_beside(target_));
    const int number = ::open(temporary_->path().c_str(),
                              O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (number >= 0) return number;
    const int error = errno;
    temporary_.reset();
    if (error != EEXIST) fail_to_write(path_, error);
  }
}

void OutputFile::give_name() {
  while (true) {
    temporary_.emplace(temporary_beside(target_));
    if (::linkat(AT_FDCWD, name_in_proc(descriptor_.number()).c_str(), AT_FDCWD,
                 temporary_->path().c_str(), AT_SYMLINK_FOLLOW) == 0)
      return;
    const int error = errno;
    temporary_.reset();
    if (error != EEXIST) fail_to_write(path_, error);
  }
}

void OutputFile::commit() {
  stream_->finish();
  if (is_device_) return;
  if (::fsync(descriptor_.number()) != 0) fail_to_write(path_, errno);
  const SignalsWait signals_wait;
  if (!temporary_) give_name();
  if (::rename(temporary_->path().c_str(), target_.c_str()) != 0) fail_to_write(path_, errno);
  temporary_.reset();
  sync_folder(target_.parent_path());
}

}  // namespace clackers::cli
