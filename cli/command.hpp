#pragma once

#include <deque>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace clackers::cli {

/// What a value of an option names.
enum class ValueKind { text, input_file, output_file };

/// One row of a command's table of options: an option, a flag or a positional argument. Parser, help,
/// man pages and completion read it.
struct Option {
  /// A flag, a value given once, or values that may be repeated.
  using Target = std::variant<bool*, std::string*, std::vector<std::string>*>;

  std::string name;  ///< "--samples"; of a positional argument "CASE"
  Target target;     ///< where the value goes; outlives the parsing
  std::string explanation;
  std::string placeholder{};  ///< of the value: "n", "table|csv|json"
  ValueKind kind = ValueKind::text;
  /// Of an option that divides a list of arguments: the list, and its length at each value.
  const std::vector<std::string>* divided = nullptr;
  std::vector<std::size_t>* starts = nullptr;

  bool is_flag() const { return std::holds_alternative<bool*>(target); }
  bool repeats() const { return std::holds_alternative<std::vector<std::string>*>(target); }
  /// What was given; empty before the parsing and for flags.
  std::vector<std::string> values() const;

  Option* description(std::string text);
  Option* option_text(std::string text);
  /// The value is the name of a file that the command reads or writes.
  Option* reads_file(std::string text);
  Option* writes_file(std::string text);
  /// Each value holds for the arguments of `list` behind it; `at` gets how many are before it.
  Option* divides(const std::vector<std::string>& list, std::vector<std::size_t>& at);
};

/// What stands above the options of a command's help.
struct HelpPage {
  std::string examples;  ///< lines to copy
  std::string about;     ///< what it does
  std::string usage;     ///< the grammar
};

/// One command: its grammar, its help, and its work.
struct Command {
  std::string name;      ///< "verify"; empty for the program itself
  std::string synopsis;  ///< its arguments in short: "[METHOD ...]"
  std::string summary;   ///< a few words, for the list of commands
  HelpPage page{};
  std::deque<Option> arguments{}, options{};
  /// Does the work after the parsing and returns the exit code. `line` is the whole command line as
  /// a shell would read it. Throws Error (interrupted among them) and BrokenPipe.
  std::function<int(const std::string& line)> run{};

  /// Adds an option ("--step") or a positional argument ("CASE").
  Option* add_option(std::string name, std::string& target, std::string description);
  Option* add_option(std::string name, std::vector<std::string>& target, std::string description);
  Option* add_flag(std::string name, bool& target, std::string description);
  /// The option of that name, which exists.
  Option* get_option(const std::string& name);
};

void set_help(Command& command, HelpPage page);

/// The program with its commands.
struct Grammar {
  Command program;
  std::deque<Command> commands;

  Command* add_subcommand(std::string name, std::string synopsis, std::string summary);
};

void add_list(Grammar& root);
void add_show(Grammar& root);
void add_respond(Grammar& root);
void add_verify(Grammar& root);
void add_check(Grammar& root);
void add_campaign(Grammar& root);
void add_atlas(Grammar& root);
void add_engines(Grammar& root);
void add_export(Grammar& root);
void add_paper(Grammar& root);
void add_explain(Grammar& root);
void add_explore(Grammar& root);
void add_report(Grammar& root);
void add_cite(Grammar& root);

/// What `clackers list` lists.
std::vector<std::string> listed_kinds();

/// What `clackers --version --verbose` prints.
std::string version_text();

/// Reads the arguments, without the name of the program, and runs the command they name. Returns
/// its exit code; throws InputError for what does not follow the grammar, and what commands throw.
int run_command_line(const std::vector<std::string>& arguments);

}  // namespace clackers::cli
