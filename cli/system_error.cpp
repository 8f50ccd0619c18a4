#include "cli/system_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "clackers/base/error.hpp"

namespace clackers::cli {
namespace {

std::string reason(int error_number) { return std::generic_category().message(error_number); }

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

}  // namespace

void fail_to_write(const std::string& file, int error_number) {
  throw FileError(fmt::format("cannot write {}: {}. {}", file, reason(error_number),
                              advice_to_write(error_number)),
                  "cannot-write");
}

void fail_to_read(const std::string& file, int error_number) {
  throw FileError(fmt::format("cannot read {}: {}. Name a text file that exists and may be read, "
                              "or - for standard input.",
                              file, reason(error_number)),
                  "cannot-read");
}

}  // namespace clackers::cli
