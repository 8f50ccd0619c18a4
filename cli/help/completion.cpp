#include "cli/help/help.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <variant>

#include "clackers/cases/case.hpp"
#include "clackers/decks/deck.hpp"
#include "clackers/input/results/result_table.hpp"
#include "clackers/tables/listing.hpp"
#include "paper/catalogue.hpp"

namespace clackers::cli {
namespace {

class Candidates {
 public:
  explicit Candidates(std::string prefix) : prefix_(std::move(prefix)) {}
  void add(const std::string& word, const std::string& explanation = {}) {
    if (!word.starts_with(prefix_) || std::ranges::find(words_, word) != words_.end()) return;
    words_.push_back(word);
    lines_.push_back(word + "\t" + explanation.substr(0, explanation.find(". ")));
  }
  void add_column(const record::Sheet& sheet, const std::string& kind = {}) {
    for (const auto& row : sheet.rows)
      if (kind.empty() || std::get<std::string>(row[1]) == kind) add(std::get<std::string>(row[0]));
  }
  void add_files() { lines_.emplace_back(":files"); }
  const std::string& prefix() const { return prefix_; }
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::string prefix_;
  std::vector<std::string> words_, lines_;
};

// "name=" for each parameter of the case on the line, behind the settings already typed.
void add_parameters(const std::vector<std::string>& words, Candidates& to) {
  auto name = cases::default_case();
  for (const auto& entry : cases::entries())
    if (std::ranges::find(words, entry.name) != words.end()) name = entry.name;
  const auto typed = to.prefix().substr(0, to.prefix().rfind(',') + 1);
  for (const auto& entry : cases::entries())
    if (entry.name == name)
      for (const auto& parameter : entry.parameters) to.add(typed + parameter.name + "=");
}

// What one placeholder stands for; numbers complete to nothing.
void add_values(std::string_view placeholder, bool is_choice, const Grammar& grammar,
                Candidates& to) {
  if (placeholder == "CASE") {
    to.add_column(tables::list("cases"));
  } else if (placeholder == "METHOD") {
    to.add_column(tables::list("integrators"));
    to.add_column(tables::list("pairs"));
  } else if (placeholder == "KIND") {
    for (const auto& kind : listed_kinds()) to.add(kind);
  } else if (placeholder == "COMMAND") {
    for (const auto& command : grammar.commands) to.add(command.name, command.summary);
  } else if (placeholder == "CODE") {
    to.add_column(tables::explain(""));
  } else if (placeholder == "FIGURE") {
    to.add_column(paper::list_figures());
  } else if (placeholder == "FORMAT") {
    for (const auto& format : decks::formats()) to.add(format.name, format.program);
  } else if (placeholder == "READER") {
    for (const auto& reader : input::result_readers()) to.add(reader.name);
    to.add("table");
  } else if (placeholder == "BEHAVIOUR" || placeholder == "WHAT") {
    to.add_column(tables::explain(""), "behaviour");
    if (placeholder == "WHAT")
      for (const auto* word : {"agrees", "order:", "error:"}) to.add(word);
  } else if (placeholder.starts_with("FILE") || placeholder == "FOLDER") {
    to.add_files();
  } else if (is_choice) {
    to.add(std::string(placeholder));
  }
}

void add_values(const Option& option, const std::vector<std::string>& words, const Grammar& grammar,
                Candidates& to) {
  if (option.placeholder.starts_with("name=")) return add_parameters(words, to);
  const auto& shown = option.placeholder.empty() ? option.name : option.placeholder;
  std::istringstream parts(shown.substr(0, shown.find('[')));  // without what may follow a value
  const bool is_choice = parts.str().find('|') != std::string::npos;
  for (std::string part; std::getline(parts, part, '|');) add_values(part, is_choice, grammar, to);
}

// Joins "--case", "=", "thr" to "--case=thr"; returns how much of the last stands before its last
// part.
std::size_t join_at_equals(std::vector<std::string>& words) {
  std::vector<std::string> joined;
  std::size_t before_last = 0;
  bool is_joined = false;
  for (const auto& word : words) {
    is_joined = !joined.empty() && (word == "=" || (is_joined && joined.back().ends_with('=')));
    before_last = is_joined ? joined.back().size() + (word == "=") : 0;
    is_joined ? joined.back() += word : joined.emplace_back(word);
  }
  words = std::move(joined);
  return before_last;
}

// The positional argument that the last word is of.
const Option& argument_at(const Command& command, const std::vector<std::string>& words) {
  std::size_t at = 0;
  bool is_value = false;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const auto option = std::ranges::find(command.options, words[i], &Option::name);
    const bool is_option = words[i].starts_with('-');
    if (!is_option && !is_value && !command.arguments[at].repeats()) ++at;
    if (at == command.arguments.size()) return command.arguments.back();
    is_value = option != command.options.end() && !option->is_flag();
  }
  return command.arguments[at];
}

void add_all(const Grammar& grammar, const std::vector<std::string>& words, Candidates& to) {
  const auto command = std::ranges::find(grammar.commands, words.front(), &Command::name);
  if (words.size() == 1 || command == grammar.commands.end()) {
    if (words.size() > 1) return;
    add_values("COMMAND", false, grammar, to);
    for (const auto& option : grammar.program.options) to.add(option.name, option.explanation);
    return to.add("-h");
  }
  const auto& before = words[words.size() - 2];
  for (const auto& option : command->options)
    if (option.name == before && !option.is_flag()) return add_values(option, words, grammar, to);
  if (to.prefix().starts_with('-'))
    for (const auto& option : command->options) to.add(option.name, option.explanation);
  else if (!command->arguments.empty())
    add_values(argument_at(*command, words), words, grammar, to);
}

}  // namespace

std::vector<std::string> completions(const Grammar& grammar, std::vector<std::string> words) {
  if (words.empty()) words.emplace_back();
  auto hidden = join_at_equals(words);
  // "--case=thr" is a value of --case.
  std::string option;
  if (const auto equals = words.back().find('=');
      words.back().starts_with("--") && equals != std::string::npos) {
    option = words.back().substr(0, equals + 1);
    const auto value = words.back().substr(equals + 1);
    words.back().resize(equals);
    words.push_back(value);
  }
  Candidates candidates(words.back());
  add_all(grammar, words, candidates);
  auto lines = candidates.lines();
  for (auto& line : lines)
    if (line != ":files") line.insert(0, option).erase(0, hidden);
  return lines;
}

}  // namespace clackers::cli
