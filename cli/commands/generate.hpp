#pragma once

#include <span>
#include <string>

#include "cli/help/reference.hpp"

namespace clackers::cli {

/// Writes what an installed program brings along for its shell into `folder`, as it lies below
/// share/: man/man1/*.1, bash-completion/completions/clackers and zsh/site-functions/_clackers.
/// The first of `references` is the program itself. Throws FileError.
void generate_shell_files(std::span<const Reference> references, const std::string& folder);

}  // namespace clackers::cli
