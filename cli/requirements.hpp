#pragma once

#include <string>
#include <vector>

#include "clackers/record/require.hpp"
#include "cli/command.hpp"

namespace clackers::cli {

/// Adds --require, which may stand several times. `requirements` must outlive the parsing.
void add_require_option(Command& command, std::vector<std::string>& requirements);

/// The values of all --require options. Throws InputError as record::requirement_from does.
std::vector<record::Requirement> read_requirements(const std::vector<std::string>& options);

/// The exit code of a record; what does not meet the requirements is named on standard error, a line
/// a requirement.
int required_exit_code(const record::Record& record,
                       const std::vector<record::Requirement>& requirements);

}  // namespace clackers::cli
