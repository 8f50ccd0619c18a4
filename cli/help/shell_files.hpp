#pragma once

#include <string>

#include "cli/command.hpp"

namespace clackers::cli {

/// Writes what an installed program brings along for the shell into `folder`, as it lies below
/// share/: man/man1/*.1, bash-completion/completions/clackers and zsh/site-functions/_clackers.
/// Throws FileError.
void write_shell_files(const Grammar& grammar, const std::string& folder);

}  // namespace clackers::cli
