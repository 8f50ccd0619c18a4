#include "clackers/campaign/store/sqlite.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "clackers/base/error.hpp"

namespace clackers::campaign {
namespace {

// A lock of the open file, not of the process; network file systems know it, too.
bool lock(int descriptor) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return ::fcntl(descriptor, F_OFD_SETLK, &whole) == 0;
}

// The last holder may have removed the file between our opening and our lock.
bool is_in_place(int descriptor, const std::string& file) {
  struct stat ours {};
  struct stat named {};
  return ::fstat(descriptor, &ours) == 0 && ::stat(file.c_str(), &named) == 0 &&
         ours.st_ino == named.st_ino && ours.st_dev == named.st_dev;
}

}  // namespace

WriterLock::WriterLock(const std::string& path) : file_(path + ".lock") {
  for (;;) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      throw FileError(
          fmt::format("{}: the database cannot be written: {}. Name a folder that exists "
                      "and that you may write to.",
                      path, std::system_category().message(errno)),
          "cannot-write");
    const bool is_ours = lock(descriptor_);
    if (is_ours && is_in_place(descriptor_, file_)) return;
    ::close(descriptor_);
    if (!is_ours)
      throw InputError(
          fmt::format("{}: another process writes into this database. Wait for its end, "
                      "or give another --database or --shard.",
                      path),
          "database-busy");
  }
}

WriterLock::~WriterLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace clackers::campaign
