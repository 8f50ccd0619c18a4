#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace clackers::cli {

/// One command of the grammar.
struct Command {
  CLI::App* app = nullptr;  ///< knows its name and options
  /// Does the work after parsing and returns the exit code. `line` is the whole command line as a
  /// shell would read it. Throws InputError, FileError, Interrupted, BrokenPipe.
  std::function<int(const std::string& line)> run;
};

Command add_list(CLI::App& root);
Command add_show(CLI::App& root);
Command add_respond(CLI::App& root);
Command add_verify(CLI::App& root);
Command add_check(CLI::App& root);
Command add_paper(CLI::App& root);
Command add_explain(CLI::App& root);

}  // namespace clackers::cli
