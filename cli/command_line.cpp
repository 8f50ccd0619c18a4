#include "cli/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <span>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"
#include "clackers/solvers/program.hpp"
#include "cli/files/output_stream.hpp"
#include "cli/files/paths.hpp"
#include "cli/help/help.hpp"

namespace clackers::cli {
namespace {

std::string help_of(const Command& command) {
  return command.name.empty() ? "clackers --help" : fmt::format("clackers {} --help", command.name);
}

[[noreturn]] void refuse_syntax(const std::string& what, const Command& command) {
  throw InputError(fmt::format("{} See: {}", what, help_of(command)), "bad-syntax");
}

[[noreturn]] void refuse_option(const std::string& name, const Command& command) {
  if (name == "--plugin") throw InputError(std::string(solvers::instead_of_plugin), "unknown-name");
  std::vector<std::string> known;
  for (const auto& option : command.options) known.push_back(option.name);
  // "--method": an argument written as an option.
  auto word = name.substr(2);
  for (auto& c : word) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const auto& argument : command.arguments) {
    const auto& shown = argument.placeholder.empty() ? argument.name : argument.placeholder;
    if (fmt::format("|{}|", shown).find("|" + word + "|") != std::string::npos)
      throw InputError(fmt::format("no option \"{0}\": {1} stands without it, clackers {2} {1}. "
                                   "See: {3}",
                                   name, word, command.name, help_of(command)),
                       "unknown-name");
  }
  refuse_name("option", name, known, help_of(command));
}

bool is_help(std::string_view word) { return word == "-h" || word == "--help"; }

// "-- a comment of SQL" is none.
bool is_option(std::string_view word) {
  return word.size() > 1 && word.front() == '-' &&
         word.substr(0, word.find('=')).find_first_of(" \t\n") == word.npos;
}

// Gives the words behind a command to its options and arguments.
class Parser {
 public:
  Parser(Command& command, std::span<const std::string> words) : command_(command), words_(words) {}

  /// False when help is asked for, and nothing else counts.
  bool parse() {
    bool options_end = false;
    while (at_ < words_.size()) {
      const auto& word = words_[at_++];
      if (!options_end && is_help(word)) return false;
      if (!options_end && word == "--")
        options_end = true;
      else if (!options_end && is_option(word))
        take_option(word);
      else
        take_argument(word);
    }
    return true;
  }

 private:
  void take_option(const std::string& word) {
    const auto equals = word.find('=');
    const auto name = word.substr(0, equals);
    const auto option = std::ranges::find(command_.options, name, &Option::name);
    if (option == command_.options.end()) refuse_option(name, command_);
    if (auto* const* flag = std::get_if<bool*>(&option->target)) {
      if (equals != std::string::npos) refuse_syntax(name + " takes no value.", command_);
      **flag = true;
    } else if (equals != std::string::npos) {
      give(*option, word.substr(equals + 1));
    } else if (at_ == words_.size() || words_[at_].starts_with("--") || is_help(words_[at_])) {
      refuse_syntax(fmt::format("{0} needs a value: {0} {1}.", name, option->placeholder),
                    command_);
    } else {
      give(*option, words_[at_++]);
    }
  }

  void take_argument(const std::string& word) {
    if (next_argument_ == command_.arguments.size())
      refuse_syntax(fmt::format("one argument too many: \"{}\".", word), command_);
    auto& argument = command_.arguments[next_argument_];
    next_argument_ += !argument.repeats();
    give(argument, word);
  }

  void give(Option& option, const std::string& value) {
    // A shell variable that was not set; it does not stand for the default.
    if (value.empty())
      refuse_syntax(fmt::format("{} is given an empty value.", option.name), command_);
    if (option.divided != nullptr) option.starts->push_back(option.divided->size());
    if (auto* const* many = std::get_if<std::vector<std::string>*>(&option.target)) {
      (*many)->push_back(value);
      return;
    }
    if (std::ranges::find(given_, &option) != given_.end())
      refuse_syntax(fmt::format("{} is given more than once.", option.name), command_);
    given_.push_back(&option);
    *std::get<std::string*>(option.target) = value;
  }

  Command& command_;
  std::span<const std::string> words_;
  std::size_t at_ = 0, next_argument_ = 0;
  std::vector<const Option*> given_;
};

// No file is both read and written.
void require_distinct_files(const Command& command) {
  std::vector<NamedFile> inputs, outputs;
  const auto collect = [&](const Option& option) {
    if (option.kind == ValueKind::text) return;
    auto& files = option.kind == ValueKind::input_file ? inputs : outputs;
    for (const auto& path : option.values())
      if (&files == &inputs || path != "-") files.push_back({option.name, path});
  };
  std::ranges::for_each(command.arguments, collect);
  std::ranges::for_each(command.options, collect);
  require_distinct_files(inputs, outputs);
}

void print(const std::string& text) {
  OutputStream out(1, "standard output", OnInterrupt::stop);
  out << text;
  out.finish();
}

[[noreturn]] void refuse_command(const std::string& word, const Grammar& grammar) {
  const auto& program = grammar.program;
  if (!word.starts_with('-')) {
    std::vector<std::string> names;
    for (const auto& command : grammar.commands) names.push_back(command.name);
    refuse_name("command", word, names, help_of(program));
  }
  const auto name = word.substr(0, word.find('='));
  const auto& known = grammar.commands.front().options;
  if (std::ranges::find(known, name, &Option::name) != known.end())
    refuse_syntax(fmt::format("{0} goes after the command: clackers COMMAND ... {0}.", name),
                  program);
  refuse_option(name, program);
}

Command& command_of(const std::string& word, Grammar& grammar) {
  const auto command = std::ranges::find(grammar.commands, word, &Command::name);
  if (command == grammar.commands.end()) refuse_command(word, grammar);
  return *command;
}

void add_help(Grammar& grammar) {
  const auto topic = std::make_shared<std::string>();
  auto* help = grammar.add_subcommand("help", "[COMMAND]", "how to use the program or a command");
  set_help(*help, {.examples = "  clackers help\n  clackers help verify\n",
                   .about = "Prints what COMMAND --help prints; without COMMAND, all commands.",
                   .usage = "  clackers help [COMMAND]\n"});
  help->add_option("COMMAND", *topic, "Its name.");
  help->run = [topic, &grammar](const std::string&) {
    print(topic->empty() ? help_text(grammar) : help_text(command_of(*topic, grammar)));
    return 0;
  };
}

// The flags --help and --version have no target of their own: they end the parsing.
bool unused_flag = false;

void add_commands(Grammar& grammar) {
  grammar.program.summary =
      "exact motions of colliding structures, and verdicts on time-integration methods";
  grammar.program.page = {
      .examples =
          "  clackers verify                        assess the default methods\n"
          "  clackers verify newmark --report newmark.html\n"
          "  clackers respond three-parameter --samples 1001 --format csv --out exact.csv\n",
      .about = "Exact motions of colliding structures, and verdicts on time-integration methods.",
      .usage = ""};
  grammar.program.add_flag("--help", unused_flag, "This help.");
  grammar.program.add_flag(
      "--version", unused_flag,
      "The version; with --verbose behind it also compiler, vectors and libraries.");
  for (const auto add : {add_list, add_show, add_respond, add_verify, add_check, add_campaign,
                         add_atlas, add_engines, add_export, add_report, add_paper, add_explore,
                         add_explain, add_cite, add_help})
    add(grammar);
  for (auto& command : grammar.commands) command.add_flag("--help", unused_flag, "This help.");
}

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
  Grammar grammar;
  add_commands(grammar);
  const auto first = arguments.empty() ? "--help" : arguments.front();
  const auto rest = std::span(arguments).subspan(arguments.empty() ? 0 : 1);
  if (is_help(first)) {
    print(help_text(grammar));
    return 0;
  }
  if (first == "--version") {
    if (!rest.empty() && rest.front() != "--verbose")
      refuse_syntax(fmt::format("--version takes --verbose, not \"{}\".", rest.front()),
                    grammar.program);
    print(rest.empty() ? "clackers " CLACKERS_VERSION "\n" : version_text());
    return 0;
  }
  // Unlisted: called by the build and the shells.
  if (first == "--generate" && rest.size() == 1) {
    write_shell_files(grammar, rest.front());
    return 0;
  }
  if (first == "--complete") {
    for (const auto& line : completions(grammar, {rest.begin(), rest.end()})) print(line + "\n");
    return 0;
  }
  auto& command = command_of(first, grammar);
  if (!Parser(command, rest).parse()) {
    print(help_text(command));
    return 0;
  }
  require_distinct_files(command);
  std::vector<std::string> line{"clackers"};
  line.insert(line.end(), arguments.begin(), arguments.end());
  return command.run(shell_line(line));
}

}  // namespace clackers::cli
