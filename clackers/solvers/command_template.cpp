#include "clackers/solvers/command_template.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> placeholders{
    "case", "case:text", "h", "n", "tolerance", "events", "out", "runs", "runs:tolerance"};

// A word of a command: where it stands, and what the shell makes of it; nothing for a word that is
// expanded.
struct Word {
  std::size_t begin = 0, end = 0;
  std::optional<std::string> text{};
  bool is_command = false;  ///< the first one of a command
};

// The words of a line for the shell: blanks and operators end one, quotes and backslashes do not.
std::vector<Word> words_of(std::string_view line) {
  constexpr std::string_view operators = ";|&()<>\n", expanded = "$`*?[{~";
  std::vector<Word> words;
  bool is_command = true;
  for (std::size_t i = 0; i < line.size();) {
    const char c = line[i];
    if (c == ' ' || c == '\t' || operators.find(c) != std::string_view::npos) {
      if (std::string_view(";|&(\n").find(c) != std::string_view::npos) is_command = true;
      ++i;
      continue;
    }
    Word word{i, i, {}, is_command};
    std::string text;
    char quote = 0;
    bool plain = true;
    for (; i < line.size(); ++i) {
      const char at = line[i];
      const bool ends = at == ' ' || at == '\t' || operators.find(at) != std::string_view::npos;
      if (quote == 0 && ends) break;
      if (at == quote)
        quote = 0;
      else if (quote == 0 && (at == '\'' || at == '"'))
        quote = at;
      else if (at == '\\' && quote != '\'' && i + 1 < line.size())
        text += line[++i];
      else {
        if (quote != '\'' && expanded.find(at) != std::string_view::npos) plain = false;
        text += at;
      }
    }
    word.end = i;
    // NAME=value before a command is not the command.
    const bool assigns = is_command && text.find('=') != std::string::npos;
    if (plain) word.text = std::move(text);
    word.is_command = is_command && !assigns;
    is_command = is_command && assigns;
    words.push_back(std::move(word));
  }
  return words;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// The end of a placeholder's name that begins at `at`; `at` where there is none.
std::size_t end_of_name(std::string_view line, std::size_t at) {
  while (at < line.size() &&
         (std::isalpha(static_cast<unsigned char>(line[at])) || line[at] == ':'))
    ++at;
  return at;
}

// The text with "{{name}}" for "{name}".
std::string without_placeholders(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto end = end_of_name(text, i + 1);
    const bool expanded = i > 0 && text[i - 1] == '$';  // stays as it is anyway
    if (text[i] == '{' && !expanded && end > i + 1 && text.substr(end, 1) == "}") {
      result += fmt::format("{{{}}}", text.substr(i, end + 1 - i));
      i = end;
    } else {
      result += text[i];
    }
  }
  return result;
}

// The program that the shell would find.
std::optional<std::string> in_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const auto colon = std::min(rest.find(':'), rest.size());
    const auto candidate = fs::path(rest.substr(0, colon)) / name;
    rest.remove_prefix(std::min(colon + 1, rest.size()));
    if (is_file(candidate) && ::access(candidate.c_str(), X_OK) == 0) return candidate.string();
  }
  return {};
}

}  // namespace

CommandTemplate::CommandTemplate(const std::string& command) {
  std::string line;
  std::size_t from = 0;
  for (const auto& word : words_of(command)) {
    if (!word.text) continue;
    const auto& text = *word.text;
    if (first_word_.empty() && word.is_command) first_word_ = text;
    const bool is_path = text.find('/') != std::string::npos;
    if (word.is_command && !is_path) {
      if (auto found = in_path(text)) files_.push_back(std::move(*found));
    } else if (is_file(text)) {
      files_.push_back(fs::absolute(text).lexically_normal().string());
      line += command.substr(from, word.begin - from) +
              without_placeholders(shell_quoted(files_.back()));
      from = word.end;
    }
  }
  line += command.substr(from);
  if (line.find_first_not_of(" \t\n") == std::string::npos)
    throw InputError(
        "verify --exec: an empty command; allowed: one as in 'solver {case} {h} {out}'.",
        "bad-syntax");

  std::string text;
  const auto add_text = [&] {
    if (!text.empty()) parts_.push_back({std::exchange(text, {}), false});
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool escaped = line.compare(i, 2, "{{") == 0;
    const std::size_t begin = i + (escaped ? 2 : 1);
    const auto end = line[i] == '{' ? end_of_name(line, begin) : begin;
    const bool closed =
        end > begin && line.compare(end, escaped ? 2 : 1, escaped ? "}}" : "}") == 0;
    if (line[i] != '{' || !closed || (i > 0 && line[i - 1] == '$')) {
      text += line[i];
      continue;
    }
    const auto name = line.substr(begin, end - begin);
    i = end + (escaped ? 1 : 0);
    if (escaped) {
      text += '{' + name + '}';
      continue;
    }
    if (std::ranges::find(placeholders, name) == placeholders.end())
      refuse_name("placeholder", name, placeholders, "clackers verify --help");
    add_text();
    parts_.push_back({name, true});
  }
  add_text();
  if (!uses("h") && !uses("n") && !uses("tolerance") && !makes_all_runs())
    refuse("verify", "--exec", command, "a command with {h}, {n}, {tolerance} or {runs}",
           "Without one of them all runs would be the same.", "bad-syntax");
  for (const auto* other : {"h", "n", "tolerance", "events", "out"})
    if (makes_all_runs() && uses(other))
      refuse("verify", "--exec-batch", command, fmt::format("{{runs}} or {{{}}}", other),
             "The file {runs} has steps and histories of all runs, a line each.", "bad-syntax");
}

bool CommandTemplate::by_tolerance() const { return uses("tolerance") || uses("runs:tolerance"); }

bool CommandTemplate::makes_all_runs() const { return uses("runs") || uses("runs:tolerance"); }

bool CommandTemplate::uses(std::string_view placeholder) const {
  return std::ranges::any_of(
      parts_, [&](const Part& part) { return part.is_placeholder && part.text == placeholder; });
}

std::string CommandTemplate::filled(const std::vector<PlaceholderValue>& values) const {
  std::string line;
  for (const auto& part : parts_)
    line += part.is_placeholder
                ? shell_quoted(std::ranges::find(values, part.text, &PlaceholderValue::name)->value)
                : part.text;
  return line;
}

std::string CommandTemplate::identity() const {
  std::string text;
  for (const auto& file : files_) {
    struct stat found {};
    if (::stat(file.c_str(), &found) == 0)
      text += fmt::format("{} {} {}.{:09}\n", file, found.st_size, found.st_mtim.tv_sec,
                          found.st_mtim.tv_nsec);
  }
  return text;
}

std::string CommandTemplate::name() const {
  // Of an interpreter and its script the script names the method.
  const auto is_script = [&](const std::string& file) {
    return fs::path(file).filename() != fs::path(first_word_).filename();
  };
  const auto script = std::ranges::find_if(files_, is_script);
  const auto& chosen = script == files_.end() ? first_word_ : *script;
  const auto stem = fs::path(chosen).stem().string();
  return stem.empty() ? "program" : stem;
}

}  // namespace clackers::solvers
