#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace clackers::solvers {

/// How far the process of a plug-in came, which it writes to a file before every call of the library:
/// when it crashes the file says where.
struct PluginReport {
  std::string stage = "start";  ///< "load", "prepare", "run", "free", or "end" after the last
  std::string code;             ///< of a failure; empty: none
  std::string sentence;         ///< of a failure, without control characters
  std::string name;             ///< of the solver; empty: it has none, or is not known yet
  bool by_tolerance = false;    ///< what it refines
};

/// Throws FileError.
void write(const PluginReport& report, const std::filesystem::path& path);
/// "start" where there is no such file.
PluginReport read_plugin_report(const std::filesystem::path& path);

}  // namespace clackers::solvers
