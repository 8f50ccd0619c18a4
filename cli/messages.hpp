#pragma once

#include <string_view>

#include "clackers/base/error.hpp"

namespace clackers::cli {

/// One line on standard error, for a person. Control characters are escaped.
void note(std::string_view text);

/// "clackers: message [code]" on standard error, wrapped if that is a terminal. Control characters
/// are escaped.
void report_error(std::string_view message, std::string_view code);

/// Throws InputError (bad-syntax) for options of a command that do not go together.
[[noreturn]] void refuse_usage(std::string_view command, std::string_view sentence);

/// Runs `write`, which writes one of several results: a file that fails is reported and does not
/// stop the others. True when written.
bool try_to_write(const auto& write) {
  try {
    write();
    return true;
  } catch (const FileError& error) {
    report_error(error.what(), error.code().name());
    return false;
  }
}

}  // namespace clackers::cli
