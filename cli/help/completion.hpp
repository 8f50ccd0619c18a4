#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"

namespace clackers::cli {

/// What may stand in place of the last of `words`, the words behind the program's name up to the
/// cursor: lines of a candidate, a tab and what it is, or ":files" where a file is meant. bash
/// splits words at "=", and takes what stands behind it.
std::vector<std::string> completions(const Grammar& grammar, std::vector<std::string> words);

}  // namespace clackers::cli
