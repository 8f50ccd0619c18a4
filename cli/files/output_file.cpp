#include "cli/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "cli/system_error.hpp"

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

std::string followed(const std::string& path) {
  std::error_code none;
  const auto real = std::filesystem::canonical(path, none);
  return none ? path : real.string();
}

}  // namespace

Descriptor::~Descriptor() { ::close(number_); }

OutputFile::OutputFile(std::string path, OnInterrupt on_interrupt)
    : path_(std::move(path)), target_(followed(path_)) {
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  // A name that is too long, a loop of links, a file as folder: the temporary name hides these.
  if (!exists && errno != ENOENT) fail_to_write(path_, errno);
  if (exists && S_ISDIR(status.st_mode)) fail_to_write(path_, EISDIR);
  if (named_descriptor(path_) >= 0 || (exists && !S_ISREG(status.st_mode)))
    open_device();
  else
    open_temporary();
  stream_ = std::make_unique<OutputStream>(descriptor_->number(), path_, on_interrupt);
}

OutputFile::~OutputFile() {
  if (temporary_) ::unlink(temporary_->path().c_str());
}

void OutputFile::open_device() {
  const int already_open = named_descriptor(path_);
  const int number = already_open >= 0 ? ::fcntl(already_open, F_DUPFD_CLOEXEC, 3)
                                       : ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (number < 0) fail_to_write(path_, errno);
  descriptor_ = std::make_unique<Descriptor>(number);
}

void OutputFile::open_temporary() {
  struct stat old {};
  const bool replaces = ::stat(target_.c_str(), &old) == 0;
  // The folder's permission alone would let a write-protected file be replaced.
  if (replaces && ::access(target_.c_str(), W_OK) != 0) fail_to_write(path_, errno);
  const auto folder = std::filesystem::path(target_).parent_path();
  static int count = 0;
  temporary_.emplace((folder / fmt::format(".clackers-{}-{}.tmp", ::getpid(), ++count)).string());
  const int number =
      ::open(temporary_->path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (number < 0) {
    const int error = errno;
    temporary_.reset();
    fail_to_write(path_, error);
  }
  descriptor_ = std::make_unique<Descriptor>(number);
  if (replaces) ::fchmod(number, old.st_mode & 07777);
}

void OutputFile::commit() {
  stream_->finish();
  if (!temporary_) return;
  if (::fsync(descriptor_->number()) != 0) fail_to_write(path_, errno);
  if (::rename(temporary_->path().c_str(), target_.c_str()) != 0) fail_to_write(path_, errno);
  temporary_.reset();
}

}  // namespace clackers::cli
