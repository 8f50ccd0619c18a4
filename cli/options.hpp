#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace clackers::cli {

/// What every command takes.
struct CommonOptions {
  std::string format = "table", out;
  bool quiet = false, no_color = false;
};

/// Adds --format, --out, --quiet and --no-color. `options` must outlive the parsing.
void add_common_options(CLI::App& command, CommonOptions& options);

/// Adds --set, which may stand several times.
void add_set_option(CLI::App& command, std::vector<std::string>& settings);

/// Adds --report of commands that judge. `path` must outlive the parsing.
void add_report_option(CLI::App& command, std::string& path);

/// Says in the help of --format that commands that judge know more formats.
void add_verdict_formats(CLI::App& command);

}  // namespace clackers::cli
