#include "cli/help/completion.hpp"

#include <algorithm>
#include <sstream>
#include <variant>

#include "clackers/cases/case.hpp"
#include "clackers/paper/table.hpp"
#include "clackers/study/listing.hpp"

namespace clackers::cli {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, '|');) parts.push_back(part);
  return parts;
}

void append_first_column(const study::Sheet& sheet, std::vector<std::string>& words,
                         const std::string& kind = {}) {
  for (const auto& row : sheet.rows)
    if (kind.empty() || std::get<std::string>(row[1]) == kind)
      words.push_back(std::get<std::string>(row[0]));
}

// The words of "[a|b|c]" in a usage, when that is a list of words and not of options or
// placeholders.
std::vector<std::string> written_out(const std::string& usage) {
  const auto open = usage.find('['), close = usage.find(']', open);
  if (open == std::string::npos || close == std::string::npos) return {};
  const auto inside = usage.substr(open + 1, close - open - 1);
  const auto is_plain = [](char c) { return (c >= 'a' && c <= 'z') || c == '|'; };
  if (!std::ranges::all_of(inside, is_plain)) return {};
  return split(inside);
}

// Appends what one placeholder stands for.
void append(const std::string& placeholder, Completion& to) {
  if (placeholder == "CASE") {
    append_first_column(study::list("cases"), to.words);
  } else if (placeholder == "METHOD") {
    append_first_column(study::list("integrators"), to.words);
    append_first_column(study::list("pairs"), to.words);
  } else if (placeholder == "CODE") {
    append_first_column(study::explain(""), to.words);
  } else if (placeholder == "FIGURE") {
    append_first_column(paper::list_figures(), to.words);
  } else if (placeholder.starts_with("BEHAVIOUR")) {
    append_first_column(study::explain(""), to.words, "behaviour");
  } else if (placeholder.starts_with("FILE") || placeholder == "FOLDER") {
    to.files = true;
  } else if (std::ranges::all_of(placeholder, [](char c) { return c >= 'a' && c <= 'z'; }) &&
             placeholder.size() > 1) {
    to.words.push_back(placeholder);
  }
}

}  // namespace

Completion completion_of(const ReferenceItem& item, const Reference& command) {
  Completion all;
  const auto placeholders = split(item.value);
  // A single word in small letters is a name for a number ("x"), not a word to type.
  const bool is_choice = placeholders.size() > 1;
  for (const auto& placeholder : placeholders)
    if (is_choice || placeholder.find_first_of("abcdefghijklmnopqrstuvwxyz") != 0)
      append(placeholder, all);
  const bool positional = !item.names.front().starts_with('-');
  if (positional && all.words.empty() && !all.files) all.words = written_out(command.page.usage);
  // One word a name: the first of two equal ones stays.
  std::vector<std::string> once;
  for (auto& word : all.words)
    if (std::ranges::find(once, word) == once.end()) once.push_back(std::move(word));
  all.words = std::move(once);
  return all;
}

std::vector<CaseWords> case_words() {
  std::vector<CaseWords> all;
  for (const auto& entry : cases::entries()) {
    CaseWords words{entry.name, {}};
    for (const auto& parameter : entry.parameters) words.words.push_back(parameter.name + "=");
    all.push_back(std::move(words));
  }
  return all;
}

}  // namespace clackers::cli
