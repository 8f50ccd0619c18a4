#include "cli/files/paths.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>
#include <tuple>

#include "clackers/base/error.hpp"

namespace clackers::cli {
namespace {

namespace fs = std::filesystem;

std::string_view advice_to_write(int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      return "Create the folder first, or name a file in one that exists.";
    case EISDIR:
      return "Name a file, for example one in this folder.";
    case EACCES:
    case EPERM:
    case EROFS:
      return "Name a file in a folder you may write to.";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "Free some space, or name a file on another disk.";
    default:
      return "Name another file.";
  }
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Device, inode, and the name of a file that does not exist yet in that folder.
using Identity = std::tuple<dev_t, ino_t, std::string>;

// Nothing for devices and pipes, which may be read and written at once, and for what cannot be
// found, which fails later with its reason.
std::optional<Identity> identity_of(const std::string& path) {
  struct stat status {};
  const bool exists =
      (path == "-" ? ::fstat(STDIN_FILENO, &status) : ::stat(path.c_str(), &status)) == 0;
  if (exists)
    return S_ISREG(status.st_mode) ? std::optional(Identity{status.st_dev, status.st_ino, ""})
                                   : std::nullopt;
  const auto file = followed(path);
  if (::stat(folder_of(file).c_str(), &status) != 0) return {};
  return Identity{status.st_dev, status.st_ino, file.filename().string()};
}

bool are_same(const NamedFile& a, const NamedFile& b) {
  const auto identity = identity_of(a.path);
  return identity && identity == identity_of(b.path);
}

}  // namespace

void fail_to_write(const std::string& file, int error_number) {
  throw FileError(
      fmt::format("cannot write {}: {}. {}", file, std::generic_category().message(error_number),
                  advice_to_write(error_number)),
      "cannot-write");
}

fs::path followed(fs::path path) {
  constexpr int most_links = 40;  // as the system allows
  std::error_code error;
  for (int i = 0; i < most_links && fs::is_symlink(path, error); ++i)
    path = folder_of(path) / fs::read_symlink(path, error);
  const auto folder = fs::canonical(folder_of(path), error);
  return error ? path : folder / path.filename();
}

std::string temporary_beside(const fs::path& target) {
  std::uint64_t number = 0;
  while (::getrandom(&number, sizeof number, 0) != sizeof number) {
  }
  return (folder_of(target) / fmt::format(".clackers-{:016x}.tmp", number)).string();
}

void sync_folder(const fs::path& folder) {
  const int number =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (number < 0) return;
  ::fsync(number);
  ::close(number);
}

void require_distinct_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& output = outputs[i];
    for (const auto& input : inputs) {
      const bool is_update = input.option == "--baseline" && output.option == "--out";
      if (!is_update && are_same(input, output))
        throw InputError(fmt::format("{} {} is the file that {} reads, and would overwrite it. "
                                     "Name another file.",
                                     output.option, output.path, input.option),
                         "bad-syntax");
    }
    for (const auto& other : outputs.subspan(i + 1))
      if (are_same(output, other))
        throw InputError(fmt::format("{} {} and {} {} name the same file; give each its own.",
                                     output.option, output.path, other.option, other.path),
                         "bad-syntax");
  }
}

}  // namespace clackers::cli
