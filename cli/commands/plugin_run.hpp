#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clackers::cli {

/// The first argument of a command that calls a plug-in, see run_plugin().
inline constexpr std::string_view plugin_run_flag = "--plugin-run";

/// This program with plugin_run_flag, for solvers::PluginRequest.
std::vector<std::string> plugin_host_words();

/// Calls a plug-in in this process, for `verify --plugin` in another one: solvers::host_plugin() with
/// signals as a program of the library's author would have them. Returns the exit code.
int run_plugin(const std::vector<std::string>& arguments);

}  // namespace clackers::cli
