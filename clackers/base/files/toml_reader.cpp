#include "clackers/base/files/toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/number.hpp"

namespace clackers {
namespace {

// The last character of the text in quotes that begins at `i`.
std::size_t end_of_quotes(std::string_view text, std::size_t i) {
  const std::string mark(3, text[i]);
  const bool is_long = text.substr(i, 3) == mark;
  for (i += is_long ? 3 : 1; i < text.size(); ++i)
    if (text[i] == '\\' && mark[0] == '"')
      ++i;
    else if (!is_long && (text[i] == mark[0] || text[i] == '\n'))
      return i;
    else if (is_long && text.substr(i, 3) == mark)  // two more belong to it
      return i + 2 + std::min<std::size_t>(text.substr(i + 3, 2).find_first_not_of(mark), 2);
  return i;
}

// toml++ recurses over the parts of a key, and looks for tables one by one.
void require_bounded(std::string_view text, const std::string& name) {
  int points = 0, depth = 0, tables = 0;
  bool begins_line = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    tables += (c == '=' && points > 0) || (c == '[' && depth == 0 && begins_line);
    points =
        std::string_view(",=[]{}\n").find(c) == std::string_view::npos ? points + (c == '.') : 0;
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    begins_line = c == '\n' || (begins_line && (c == ' ' || c == '\t'));
    if (points == most_parts || tables > most_tables)
      throw InputError(
          fmt::format("{}:{}: {}.", name,
                      1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(i), '\n'),
                      points == most_parts ? fmt::format("a key has more than {} parts", most_parts)
                                           : fmt::format("more than {} tables", most_tables)),
          "bad-syntax");
    if (c == '"' || c == '\'') i = end_of_quotes(text, i);
    if (c == '#') i = std::min(text.find('\n', i), text.size()) - 1;
  }
}

}  // namespace

toml::table toml_from(std::string_view text, const std::string& name) {
  if (text.size() > longest_text)
    throw InputError(fmt::format("{}: {} bytes; allowed: {}.", name, text.size(), longest_text),
                     "bad-syntax");
  require_bounded(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}.", name, error.source().begin.line,
                                 std::string(error.description())),
                     "bad-syntax");
  }
}

std::string TomlReader::place(const toml::node& node) const {
  const auto line = node.source().begin.line;
  return line > 0 ? fmt::format("{}:{}", name_, line) : name_;
}

void TomlReader::fail(const toml::node& node, const std::string& sentence, Code code) const {
  throw InputError(fmt::format("{}: {}", place(node), sentence), code);
}

void TomlReader::require_known(const toml::table& table, const std::vector<std::string>& keys,
                               std::string_view where) const {
  for (const auto& [key, value] : table) {
    if (std::ranges::find(keys, key.str()) != keys.end()) continue;
    const auto near = nearest(key.str(), keys);
    fail(value,
         fmt::format("unknown key \"{}\"{}.{} Known: {}.", std::string(key.str()), where,
                     near.empty() ? "" : fmt::format(" Did you mean \"{}\"?", near),
                     fmt::join(keys, ", ")),
         "unknown-name");
  }
}

const toml::node& TomlReader::need(const toml::table& table, const char* key,
                                   const char* meaning) const {
  const auto* node = table.get(key);
  if (node == nullptr)
    throw InputError(fmt::format("{}: {} is missing; allowed: {}.", place(table), key, meaning),
                     "no-column");
  return *node;
}

double TomlReader::number(const toml::node& node, const std::string& what) const {
  double value = 0.0;
  const auto* text = node.as_string();
  const auto error = text == nullptr ? NumberError::none : read_number(text->get(), value);
  if (!(text == nullptr ? node.is_number()
                        : error == NumberError::none || error == NumberError::not_finite))
    fail(node,
         fmt::format("{} is no number; allowed: a number, or a fraction in quotes: \"1/3\".", what),
         "not-a-number");
  if (text == nullptr) value = *node.value<double>();
  if (error != NumberError::none || !std::isfinite(value))
    fail(node,
         fmt::format("{} = {}; allowed: a finite number.", what,
                     text == nullptr ? fmt::to_string(value) : text->get()),
         "not-finite");
  return value + 0.0;  // -0 would come back from JSON as 0
}

double TomlReader::number(const toml::table& table, const char* key, double standard) const {
  const auto* node = table.get(key);
  return node == nullptr ? standard : number(*node, key);
}

double TomlReader::number(const toml::table& table, const char* key, const char* meaning) const {
  return number(need(table, key, meaning), key);
}

long long TomlReader::whole(const toml::node& node, const std::string& what, double lowest,
                            double highest) const {
  const double value = number(node, what);
  if (!(value >= lowest && value <= highest && value == std::floor(value)))
    fail(node,
         fmt::format("{} = {}; allowed: a whole number, {} to {}.", what, value, lowest, highest),
         "out-of-range");
  return static_cast<long long>(value);
}

std::string TomlReader::word(const toml::node& node, const std::string& what) const {
  const auto found = node.value_exact<std::string>();
  if (!found || found->empty())
    fail(node, fmt::format("{} is no text; allowed: a word in quotes.", what), "bad-syntax");
  return *found;
}

bool TomlReader::flag(const toml::node& node, const std::string& what) const {
  const auto found = node.value_exact<bool>();
  if (!found) fail(node, fmt::format("{} is no flag; allowed: true or false.", what), "bad-syntax");
  return *found;
}

const toml::array& TomlReader::list(const toml::node& node, const std::string& what) const {
  const auto* found = node.as_array();
  if (found == nullptr || found->empty())
    fail(node, fmt::format("{} is no list of one or more values; allowed: [ ] around them.", what),
         "bad-syntax");
  return *found;
}

const toml::table& TomlReader::table(const toml::node& node, const std::string& what,
                                     const char* allowed) const {
  const auto* found = node.as_table();
  if (found == nullptr)
    fail(node, fmt::format("{} is no table; allowed: {}.", what, allowed), "bad-syntax");
  return *found;
}

const toml::array* TomlReader::tables(const toml::table& root, const char* key) const {
  const auto* node = root.get(key);
  if (node == nullptr) return nullptr;
  const auto* list = node->as_array();
  if (list == nullptr || (!list->empty() && !list->is_homogeneous(toml::node_type::table)))
    fail(*node, fmt::format("{0} is no list of tables; allowed: [[{0}]] above each.", key),
         "bad-syntax");
  return list;
}

}  // namespace clackers
