#pragma once

#include <string>
#include <vector>

#include "cli/help/help.hpp"

namespace clackers::cli {

/// An option or a positional argument, as --help tells it.
struct ReferenceItem {
  std::vector<std::string> names;  ///< "-h", "--help"; of a positional argument "METHOD"
  std::string value;  ///< its placeholder, "CASE" or "table|csv|json"; empty for a flag
  std::string description;
  bool repeats = false;  ///< may stand several times
};

/// All that --help tells of one command, as data: help, man pages and completions have this one
/// source.
struct Reference {
  std::string name;  ///< "verify"; empty for the program itself
  HelpPage page;
  std::vector<ReferenceItem> arguments, options;
};

/// The reference of an app that set_help() was called for.
Reference reference_of(const CLI::App& app);

/// What the overall usage says of a command behind its grammar: "  clackers list  [KIND]  what there
/// is" gives "what there is" for "list"; empty when it has no such line.
std::string summary_of(const std::string& command, const HelpPage& overall);

}  // namespace clackers::cli
