#pragma once

#include <string>
#include <vector>

#include "clackers/report/write.hpp"
#include "cli/command.hpp"

namespace clackers::cli {

/// What every command takes.
struct CommonOptions {
  std::string format = "table", out;
  bool quiet = false, no_color = false;
};

/// Adds --format, --out, --quiet and --no-color. `options` must outlive the parsing.
/// `content` decides which formats there are.
void add_common_options(Command& command, CommonOptions& options,
                        report::Content content = report::Content::rows);

/// Adds --case of commands whose first argument is the case. `name` must outlive the parsing.
void add_case_option(Command& command, std::string& name);

/// Adds --set, which may stand several times.
void add_set_option(Command& command, std::vector<std::string>& settings);

/// Adds --problem, which stands for the case piecewise. `path` must outlive the parsing.
void add_problem_option(Command& command, std::string& path);

/// Adds --report of commands that assess. `path` must outlive the parsing.
void add_report_option(Command& command, std::string& path);

}  // namespace clackers::cli
