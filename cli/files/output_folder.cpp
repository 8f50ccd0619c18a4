#include "cli/files/output_folder.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "clackers/base/error.hpp"
#include "cli/system_error.hpp"

namespace clackers::cli {
namespace {

namespace fs = std::filesystem;

void require_replaceable(const std::string& path, const std::vector<std::string>& own) {
  std::error_code error;
  for (fs::directory_iterator at(path, error), end; !error && at != end; at.increment(error)) {
    const auto name = at->path().filename().string();
    if (std::ranges::find(own, name) == own.end())
      throw InputError(fmt::format("--out {0}: the folder holds {1}, which this command did not "
                                   "write, and would be replaced as a whole. Name a new folder, or "
                                   "move {1} away.",
                                   path, name),
                       "foreign-folder");
  }
  if (error) fail_to_read(path, error.value());
}

void rename_or_fail(const fs::path& from, const fs::path& to, const std::string& path) {
  if (::rename(from.c_str(), to.c_str()) != 0) fail_to_write(path, errno);
}

}  // namespace

OutputFolder::OutputFolder(std::string path, const std::vector<std::string>& own)
    : path_(std::move(path)) {
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail_to_write(path_, errno);
  if (exists && !S_ISDIR(status.st_mode)) fail_to_write(path_, EEXIST);
  if (exists) require_replaceable(path_, own);
  // "results/" is the folder results; a folder reached through a link is replaced where it lies.
  auto given = fs::absolute(path_).lexically_normal();
  if (given.filename().empty()) given = given.parent_path();
  target_ = exists ? fs::canonical(given) : given;
  const auto temporary =
      target_.parent_path() / fmt::format(".{}-{}.tmp", target_.filename().string(), ::getpid());
  if (::mkdir(temporary.c_str(), 0777) != 0) fail_to_write(path_, errno);
  temporary_ = temporary;
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;  // what made the work fail has been told
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void OutputFolder::commit() {
  const auto old = fs::path(temporary_.string() + ".old");
  const bool replaces = fs::exists(target_);
  if (replaces) rename_or_fail(target_, old, path_);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int error = errno;
    if (replaces) rename_or_fail(old, target_, path_);
    fail_to_write(path_, error);
  }
  temporary_.clear();
  std::error_code error;
  if (replaces && fs::remove_all(old, error) == static_cast<std::uintmax_t>(-1))
    fail_to_write(old.string(), error.value());
}

}  // namespace clackers::cli
