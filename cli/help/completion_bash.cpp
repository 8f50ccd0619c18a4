#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "clackers/cases/case.hpp"
#include "cli/help/completion.hpp"

namespace clackers::cli {
namespace {

// A shell word that stands for itself. Names have no quotes in them.
std::string quoted(const std::vector<std::string>& words) {
  return fmt::format("'{}'", fmt::join(words, " "));
}

std::string offer(const Completion& completion) {
  if (completion.files) return "_clackers_files";
  if (completion.words.empty()) return ":";
  return fmt::format("_clackers_words {}", quoted(completion.words));
}

std::vector<std::string> option_names(const Reference& command) {
  std::vector<std::string> names;
  for (const auto& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::string values_of_options(const Reference& command) {
  std::string text;
  for (const auto& option : command.options) {
    if (option.value.empty()) continue;
    const auto action = option.value.starts_with("name=") ? "_clackers_parameters"
                                                          : offer(completion_of(option, command));
    text += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, "|"), action);
  }
  return text;
}

std::string branch(const Reference& command) {
  return fmt::format(
      "    {})\n"
      "      case \"$before\" in\n{}      esac\n"
      "      case \"$current\" in\n"
      "        -*) _clackers_words {}; return ;;\n"
      "      esac\n"
      "      {} ;;\n",
      command.name, values_of_options(command), quoted(option_names(command)),
      command.arguments.empty() ? ":" : offer(completion_of(command.arguments.front(), command)));
}

std::string parameters() {
  std::string branches;
  for (const auto& known : case_words())
    branches += fmt::format("      {}) names={} ;;\n", known.name, quoted(known.words));
  return fmt::format(
      "# The parameters of the case on the line, or of the default case.\n"
      "_clackers_parameters() {{\n"
      "  local word names='' name=''\n"
      "  for word in {} \"${{COMP_WORDS[@]}}\"; do\n"
      "    case \"$word\" in\n{}    esac\n"
      "  done\n"
      "  # Behind a comma the next name begins.\n"
      "  case \"$current\" in *,*) name=\"${{current%,*}},\" ;; esac\n"
      "  mapfile -t COMPREPLY < <(compgen -P \"$name\" -W \"$names\" -- "
      "\"${{current#\"$name\"}}\")\n"
      "  compopt -o nospace 2>/dev/null || :\n"
      "}}\n",
      cases::default_case(), branches);
}

}  // namespace

std::string bash_completion(std::span<const Reference> references) {
  const auto& program = references.front();
  std::vector<std::string> commands;
  std::string branches;
  for (const auto& command : references.subspan(1)) {
    commands.push_back(command.name);
    branches += branch(command);
  }
  return "# Completion of clackers for bash. Written by the program itself.\n\n"
         "_clackers_words() {\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$current\")\n"
         "}\n\n"
         "_clackers_files() {\n"
         "  compopt -o filenames 2>/dev/null || :\n"
         "  mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "}\n\n" +
         parameters() +
         fmt::format(
             "\n_clackers() {{\n"
             "  local current=\"${{COMP_WORDS[COMP_CWORD]}}\" before='' command=''\n"
             "  ((COMP_CWORD > 0)) && before=\"${{COMP_WORDS[COMP_CWORD - 1]}}\"\n"
             "  COMPREPLY=()\n"
             "  # --case=stop arrives as three words.\n"
             "  if [ \"$current\" = '=' ]; then current=''; "
             "elif [ \"$before\" = '=' ]; then before=\"${{COMP_WORDS[COMP_CWORD - 2]}}\"; fi\n"
             "  ((COMP_CWORD > 1)) && command=\"${{COMP_WORDS[1]}}\"\n"
             "  case \"$command\" in\n"
             "    '') _clackers_words '{} {}' ;;\n{}  esac\n"
             "}}\n\ncomplete -F _clackers clackers\n",
             fmt::join(commands, " "), fmt::join(option_names(program), " "), branches);
}

}  // namespace clackers::cli
