#include "cli/help/help.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <sstream>

#include "cli/files/output_file.hpp"

namespace clackers::cli {
namespace {

// The scripts ask the program for candidates: one a line, then a tab and what it is.
constexpr auto bash_completion = R"(# Completion of clackers for bash.
_clackers() {
  local current="${COMP_WORDS[COMP_CWORD]}"
  mapfile -t COMPREPLY < <(command "${COMP_WORDS[0]}" --complete "${COMP_WORDS[@]:1:COMP_CWORD}" \
    2>/dev/null | cut -f 1)
  if [ "${COMPREPLY[0]-}" = ':files' ]; then
    compopt -o filenames 2>/dev/null || :
    if [ "$current" = '=' ]; then current=''; fi
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
  case "${COMPREPLY[0]-}" in *=) compopt -o nospace 2>/dev/null || : ;; esac
}

complete -F _clackers clackers
)";

constexpr auto zsh_completion = R"(#compdef clackers
# Completion of clackers for zsh.
_clackers() {
  local line
  local -a candidates shown suffix
  for line in "${(@f)$(command ${words[1]} --complete "${(@)words[2,CURRENT]}" 2>/dev/null)}"; do
    [[ -n $line ]] || continue
    candidates+=("${line%%$'\t'*}")
    shown+=("${line/$'\t'/  }")
  done
  if [[ $candidates[1] == ':files' ]]; then
    compset -P '--[a-z]#='
    _files
    return
  fi
  [[ $candidates[1] == *= ]] && suffix=(-S '')
  compadd "${suffix[@]}" -l -d shown -a candidates
}

_clackers "$@"
)";

// Text as roff reads it back: no character of it is a request.
std::string literal(std::string_view text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";  // a minus that can be copied, not a hyphen
    else
      out += c;
    at_start = c == '\n';
  }
  return out;
}

std::string section(std::string_view title, const std::string& body) {
  return body.empty() ? "" : fmt::format(".SH {}\n{}", title, body);
}

// Lines as they stand, without the two spaces that indent them in --help.
std::string as_it_stands(const std::string& text) {
  std::string body;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    body += line.starts_with("  ") ? line.substr(2) + '\n' : line + '\n';
  return ".nf\n" + literal(body) + ".fi\n";
}

std::string described(const std::deque<Option>& options) {
  std::string text;
  for (const auto& option : options)
    text +=
        fmt::format(".TP\n\\fB{}\\fR\n{}\n", literal(heading(option)), literal(option.explanation));
  return text;
}

std::string manual_page_name(const Command& command) {
  return command.name.empty() ? "clackers" : "clackers-" + command.name;
}

std::string manual_page(const Grammar& grammar, const Command& command) {
  const auto name = manual_page_name(command);
  std::string title = name, codes, others;
  for (auto& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const auto& [code, meaning] : exit_codes())
    codes += fmt::format("{:<4} {}\n", code, meaning);
  const auto refer_to = [&](const Command& other) {
    if (&other != &command)
      others += fmt::format("{}.BR {} (1)", others.empty() ? "" : " ,\n",
                            literal(manual_page_name(other)));
  };
  refer_to(grammar.program);
  for (const auto& other : grammar.commands) refer_to(other);
  const auto usage = &command == &grammar.program ? overall_usage(grammar) : command.page.usage;
  // Words are not broken: options and names are there to be copied.
  return fmt::format(".TH {} 1 \"\" \"Clackers {}\" \"Clackers\"\n.nh\n.ad l\n", literal(title),
                     CLACKERS_VERSION) +
         section("NAME", fmt::format("{} \\- {}\n", literal(name), literal(command.summary))) +
         section("SYNOPSIS", as_it_stands(usage)) +
         section("DESCRIPTION", literal(command.page.about) + "\n") +
         section("ARGUMENTS", described(command.arguments)) +
         section("OPTIONS", described(command.options)) +
         section("EXIT STATUS", as_it_stands(codes)) +
         section("EXAMPLES", as_it_stands(command.page.examples)) +
         section("SEE ALSO", others + "\n");
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;  // what is wrong with the folder, the file will say
  std::filesystem::create_directories(path.parent_path(), error);
  OutputFile file(path.string(), OnInterrupt::stop);
  file.stream() << text;
  file.commit();
}

}  // namespace

void write_shell_files(const Grammar& grammar, const std::string& folder) {
  const std::filesystem::path share = folder;
  const auto write_page = [&](const Command& command) {
    write(share / "man/man1" / (manual_page_name(command) + ".1"), manual_page(grammar, command));
  };
  write_page(grammar.program);
  for (const auto& command : grammar.commands) write_page(command);
  write(share / "bash-completion/completions/clackers", bash_completion);
  write(share / "zsh/site-functions/_clackers", zsh_completion);
}

}  // namespace clackers::cli
