#pragma once

#include <string>

namespace CLI {
class App;
}

namespace clackers::cli {

/// What stands above the options of a command's help.
struct HelpPage {
  std::string examples;  ///< lines to copy
  std::string about;     ///< what it does
  std::string usage;     ///< the grammar
};

/// Gives a command its help at 80 columns: examples first, then what it does, its grammar, its
/// arguments and options.
void set_help(CLI::App& command, const HelpPage& page);

/// The page that set_help() was given for this command.
const HelpPage& help_page(const CLI::App& command);

}  // namespace clackers::cli
