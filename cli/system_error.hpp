#pragma once

#include <string>

namespace clackers::cli {

/// Throws FileError: the file, the system's reason for `error_number` and what to do about it.
[[noreturn]] void fail_to_write(const std::string& file, int error_number);
[[noreturn]] void fail_to_read(const std::string& file, int error_number);

}  // namespace clackers::cli
