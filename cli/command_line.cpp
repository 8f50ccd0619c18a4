#include "cli/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/base/suggest.hpp"
#include "cli/command.hpp"
#include "cli/commands/generate.hpp"
#include "cli/files/output_stream.hpp"
#include "cli/help/help.hpp"
#include "cli/help/reference.hpp"
#include "cli/text.hpp"

namespace clackers::cli {
namespace {

const HelpPage overall_page{
    .examples =
        "  clackers verify                        judge the default methods\n"
        "  clackers verify newmark --report newmark.html\n"
        "  clackers respond three-parameter --samples 1001 --format csv --out exact.csv\n",
    .about = "Exact motions of colliding structures, and verdicts on time-integration methods.",
    .usage =
        "  clackers list     [KIND]           what there is: cases, methods, metrics\n"
        "  clackers show     CASE|METHOD      one case or method in full\n"
        "  clackers respond  CASE ...         the exact motion of a case\n"
        "  clackers verify   [METHOD ...]     judge methods on a ladder of steps\n"
        "  clackers check    FILE ...         judge time histories of any program\n"
        "  clackers paper    [FIGURE ...]     the paper's figures and claims, reproduced\n"
        "  clackers explain  [CODE]           what a code in [brackets] means\n"
        "\n"
        "  clackers COMMAND --help tells the rest. Quantities are in SI units.\n"
        "\n"
        "Exit codes\n"
        "  0 agrees, nothing claimed, or done   1 disagrees         2 refused input\n"
        "  3 undecided                          4 file or failure   130 interrupted\n"};

std::string help_of(const CLI::App& app) {
  const auto* parent = app.get_parent();
  return parent == nullptr ? "clackers --help" : fmt::format("clackers {} --help", app.get_name());
}

// The long names of an app's options, as typed.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

[[noreturn]] void refuse_syntax(const std::string& what, const CLI::App& app) {
  throw InputError(fmt::format("{} See: {}", what, help_of(app)), "bad-syntax");
}

// Refuses what the parser could not place: unknown options, then surplus arguments.
void refuse_leftovers(const CLI::App& app) {
  auto left = app.remaining();
  std::erase(left, "--");  // ends the options, as everywhere
  const auto option = std::ranges::find_if(
      left, [](const std::string& text) { return text.size() > 1 && text.starts_with('-'); });
  if (option != left.end()) {
    const auto name = option->substr(0, option->find('='));
    const auto known = option_names(app);
    // A known one is left over behind "--", where options are arguments.
    if (std::ranges::find(known, name) == known.end())
      refuse_name("option", name, known, help_of(app));
  }
  if (!left.empty())
    refuse_syntax(fmt::format("one argument too many: \"{}\".", left.front()), app);
}

// An empty value is a shell variable that was not set, and not a wish for the default.
void refuse_empty_values(const CLI::App& app) {
  for (const auto* option : app.get_options())
    for (const auto& value : option->results())
      if (value.empty())
        refuse_syntax(fmt::format("{} is given an empty value.", option->get_name()), app);
}

void refuse_root_leftovers(const CLI::App& root, const std::vector<Command>& commands) {
  const auto left = root.remaining();
  if (left.empty()) return;
  const auto& first = left.front();
  if (!first.starts_with('-')) {
    std::vector<std::string> names;
    for (const auto& command : commands) names.push_back(command.app->get_name());
    refuse_name("command", first, names, help_of(root));
  }
  const auto name = first.substr(0, first.find('='));
  const auto known = option_names(*commands.front().app);
  if (std::ranges::find(known, name) != known.end())
    refuse_syntax(fmt::format("{} stands after the command: clackers COMMAND ... {}.", name, name),
                  root);
  refuse_name("option", name, option_names(root), help_of(root));
}

// The parser's complaint in our words.
[[noreturn]] void refuse_parse(const CLI::ParseError& error, const CLI::App& app) {
  const std::string what = error.what();
  if (error.get_name() != "ArgumentMismatch") refuse_syntax(what + ".", app);
  auto name = what.substr(0, what.find_first_of(": "));
  if (!name.starts_with("--")) name = "--" + name;
  const auto* option = app.get_option_no_throw(name);
  if (option == nullptr) refuse_syntax(what + ".", app);
  if (option->get_option_text().empty())
    refuse_syntax(fmt::format("{} stands alone, without a value.", name), app);
  if (option->count() > 1) refuse_syntax(fmt::format("{} stands more than once.", name), app);
  refuse_syntax(fmt::format("{0} needs a value: {0} {1}.", name, option->get_option_text()), app);
}

void print(const std::string& text) {
  OutputStream out(1, "standard output", OnInterrupt::stop);
  out << text;
  out.finish();
}

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
  CLI::App root("", "clackers");
  set_help(root, overall_page);
  root.set_help_flag("-h,--help", "This help.");
  root.set_version_flag("--version", "clackers " CLACKERS_VERSION, "The version.");
  root.require_subcommand(0, 1);  // so that `clackers explain list` is not two commands
  root.allow_extras();
  const std::vector<Command> commands{add_list(root),   add_show(root),  add_respond(root),
                                      add_verify(root), add_check(root), add_paper(root),
                                      add_explain(root)};
  for (const auto& command : commands) {
    command.app->set_help_flag("-h,--help", "This help.");
    command.app->allow_extras();
    for (auto* option : command.app->get_options())
      if (option->get_items_expected_max() == 0) option->disable_flag_override();
  }
  // Unlisted: the build calls it, with everything above as its source.
  if (arguments.size() == 2 && arguments.front() == "--generate") {
    std::vector<Reference> references{reference_of(root)};
    for (const auto& command : commands) references.push_back(reference_of(*command.app));
    generate_shell_files(references, arguments.back());
    return 0;
  }
  const auto chosen = [&] {
    return std::ranges::find_if(commands, [](const Command& it) { return it.app->parsed(); });
  };
  const auto innermost = [&]() -> const CLI::App& {
    return chosen() == commands.end() ? root : *chosen()->app;
  };

  try {
    root.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return 0;
  } catch (const CLI::Success&) {
    print(innermost().help());
    return 0;
  } catch (const CLI::ParseError& error) {
    refuse_parse(error, innermost());
  }
  refuse_root_leftovers(root, commands);
  if (chosen() == commands.end()) {
    print(root.help());
    return 0;
  }
  refuse_leftovers(*chosen()->app);
  refuse_empty_values(*chosen()->app);

  std::vector<std::string> line{"clackers"};
  line.insert(line.end(), arguments.begin(), arguments.end());
  return chosen()->run(shell_line(line));
}

}  // namespace clackers::cli
