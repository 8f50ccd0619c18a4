#include "cli/files/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <utility>

#include "clackers/base/error.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/paths.hpp"
#include "cli/messages.hpp"

namespace clackers::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    names.push_back(at->path().filename().string());
  if (error)
    throw FileError(fmt::format("cannot read {}: {}.", folder.string(), error.message()),
                    "cannot-read");
  return names;
}

void require_replaceable(const std::string& path, const std::vector<std::string>& own) {
  for (const auto& name : names_in(path))
    if (std::ranges::find(own, name) == own.end())
      throw InputError(fmt::format("--out {0}: the folder holds {1}, which this command did not "
                                   "write, and would be replaced as a whole. Name a new folder, or "
                                   "move {1} away.",
                                   path, name),
                       "foreign-folder");
}

}  // namespace

OutputFolder::OutputFolder(std::string path, std::vector<std::string> own)
    : path_(std::move(path)), own_(std::move(own)) {
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail_to_write(path_, errno);
  if (exists && !S_ISDIR(status.st_mode)) fail_to_write(path_, EEXIST);
  if (exists) require_replaceable(path_, own_);
  // "results/" is the folder results; a folder reached through a link is replaced where it lies.
  auto given = fs::absolute(path_).lexically_normal();
  if (given.filename().empty()) given = given.parent_path();
  target_ = followed(given);
  do {
    temporary_.emplace(temporary_beside(target_));
    if (::mkdir(temporary_->path().c_str(), 0777) == 0) return;
  } while (errno == EEXIST);
  const int error = errno;
  temporary_.reset();
  fail_to_write(path_, error);
}

OutputFolder::~OutputFolder() {
  if (temporary_) remove_path(temporary_->path().c_str());
}

void OutputFolder::commit() {
  if (const Descriptor written(::open(folder().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
      ::syncfs(written.number()) != 0)
    fail_to_write(path_, errno);
  const SignalsWait signals_wait;
  exchange();
}

// After it the new folder is in place; the old one, if any, is removed.
void OutputFolder::exchange() {
  const fs::path made = folder();
  if (::renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
    temporary_.reset();
    remove_old(made);
  } else if (errno == ENOENT) {  // there is none to exchange it with
    if (::rename(made.c_str(), target_.c_str()) != 0) fail_to_write(path_, errno);
    temporary_.reset();
  } else {
    // A file system that cannot exchange names: for a moment there is no folder in place.
    const auto old = temporary_beside(target_);
    if (::rename(target_.c_str(), old.c_str()) != 0) fail_to_write(path_, errno);
    if (::rename(made.c_str(), target_.c_str()) != 0) {
      const int error = errno;
      if (::rename(old.c_str(), target_.c_str()) != 0)
        report_error(fmt::format("the earlier {} is now {}.", path_, old), "cannot-write");
      fail_to_write(path_, error);
    }
    temporary_.reset();
    remove_old(old);
  }
  sync_folder(target_.parent_path());
}

void OutputFolder::remove_old(const fs::path& old) {
  // Names of entries only: what the list says of other folders is not followed.
  for (const auto& name : own_)
    if (name.find('/') == std::string::npos) ::unlink((old / name).c_str());
  if (::rmdir(old.c_str()) == 0) return;
  for (const auto& name : names_in(old))
    ::renameat2(AT_FDCWD, (old / name).c_str(), AT_FDCWD, (target_ / name).c_str(),
                RENAME_NOREPLACE);
  if (::rmdir(old.c_str()) != 0)
    report_error(fmt::format("{} held files that this command did not write. They are now in {}.",
                             path_, old.string()),
                 "foreign-folder");
}

}  // namespace clackers::cli
