#pragma once

#include <string>
#include <vector>

namespace clackers::cli {

/// Reads the arguments, without the name of the program, and runs the command they name. Returns
/// its exit code; throws InputError for what does not follow the grammar, and what commands throw.
int run_command_line(const std::vector<std::string>& arguments);

}  // namespace clackers::cli
