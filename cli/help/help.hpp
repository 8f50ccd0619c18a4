#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cli/command.hpp"

namespace clackers::cli {

struct ExitCode {
  int code;
  std::string_view meaning;
};

/// The exit codes, which all commands share.
std::span<const ExitCode> exit_codes();

/// What --help prints, at 80 columns: examples first, then what the command does, its grammar, its
/// arguments and options.
std::string help_text(const Command& command);

/// The same for the program itself, with a line for each command.
std::string help_text(const Grammar& grammar);

/// The grammar of the program: a line for each command.
std::string overall_usage(const Grammar& grammar);

/// An option as --help heads it: "--samples n", "CASE".
std::string heading(const Option& option);

}  // namespace clackers::cli
