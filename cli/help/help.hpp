#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// What may stand in place of the last of `words`, the words behind the program's name up to the
/// cursor: lines of a candidate, a tab and what it is, or ":files" where a file is meant. bash
/// splits words at "=", and takes what stands behind it.
std::vector<std::string> completions(const Grammar& grammar, std::vector<std::string> words);

/// Writes what an installed program brings along for the shell into `folder`, as it lies below
/// share/: man/man1/*.1, bash-completion/completions/clackers and zsh/site-functions/_clackers.
/// Throws FileError.
void write_shell_files(const Grammar& grammar, const std::string& folder);

}  // namespace clackers::cli
