#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "clackers/cases/case.hpp"
#include "cli/help/completion.hpp"

namespace clackers::cli {
namespace {

// The first sentence, as _arguments takes it between quotes.
std::string explained(const std::string& description) {
  std::string text;
  const auto end = std::min(description.find(". "), description.find_last_not_of('.') + 1);
  for (const char c : description.substr(0, end)) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') text += '\\';
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text;
}

std::string action(const Completion& completion) {
  if (completion.files) return "_files";
  if (completion.words.empty()) return " ";
  return fmt::format("({})", fmt::join(completion.words, " "));
}

std::string specification(const ReferenceItem& option, const Reference& command) {
  const auto value = option.value.empty() ? ""
                     : option.value.starts_with("name=")
                         ? ":parameters:_clackers_parameters"
                         : fmt::format(":value:{}", action(completion_of(option, command)));
  std::string text;
  for (const auto& name : option.names)
    text += fmt::format("        '{}{}[{}]{}' \\\n", option.repeats ? "*" : "", name,
                        explained(option.description), value);
  return text;
}

std::string specifications(const Reference& command) {
  std::string text;
  for (const auto& option : command.options) text += specification(option, command);
  for (const auto& argument : command.arguments)
    text +=
        fmt::format("        '{}:{}:{}' \\\n", argument.repeats ? "*" : "",
                    explained(argument.names.front()), action(completion_of(argument, command)));
  return text;
}

std::string parameters() {
  std::string branches;
  for (const auto& known : case_words())
    branches += fmt::format("      {}) names=({}) ;;\n", known.name, fmt::join(known.words, " "));
  return fmt::format(
      "# The parameters of the case on the line, or of the default case.\n"
      "_clackers_parameters() {{\n"
      "  local word\n"
      "  local -a names\n"
      "  for word in {} $words; do\n"
      "    case $word in\n{}    esac\n"
      "  done\n"
      "  compset -P '*,'\n"
      "  compadd -S '' -- $names\n"
      "}}\n",
      cases::default_case(), branches);
}

}  // namespace

std::string zsh_completion(std::span<const Reference> references) {
  const auto& program = references.front();
  std::string commands, branches;
  for (const auto& command : references.subspan(1)) {
    commands += fmt::format("    '{}:{}'\n", command.name,
                            explained(summary_of(command.name, program.page)));
    branches += fmt::format("      {})\n      _arguments \\\n{}        && return 0 ;;\n",
                            command.name, specifications(command));
  }
  return "#compdef clackers\n# Completion of clackers for zsh. Written by the program itself.\n\n" +
         parameters() +
         fmt::format(
             "\n_clackers() {{\n"
             "  local curcontext=$curcontext state line\n"
             "  local -a commands\n"
             "  commands=(\n{}  )\n"
             "  _arguments -C \\\n{}"
             "        '1:command:->command' '*::argument:->argument' && return 0\n"
             "  case $state in\n"
             "    command) _describe command commands ;;\n"
             "    argument) case $words[1] in\n{}    esac ;;\n"
             "  esac\n"
             "}}\n\n_clackers \"$@\"\n",
             commands, specifications(program), branches);
}

}  // namespace clackers::cli
