#include "clackers/model/problem_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/files/json.hpp"
#include "clackers/base/number.hpp"
#include "clackers/base/text.hpp"

namespace clackers::model {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_syntax(const std::string& place, std::string_view what) {
  throw InputError(fmt::format("{}: {}.", place, what), "bad-syntax");
}

[[noreturn]] void refuse_unstated(const std::string& place, std::string_view law) {
  throw InputError(
      fmt::format(
          "{}: the motion obeys a law beside its rows, \"{}\"; allowed: problems whose rows "
          "say all. Take the case itself in place of its file.",
          place, printable(law)),
      "not-stated");
}

struct ToTable {
  toml::table& table;
  const std::string& key;
  void operator()(auto value) const { table.insert_or_assign(key, std::move(value)); }
};
struct ToArray {
  toml::array& array;
  void operator()(auto value) const { array.push_back(std::move(value)); }
};

void convert(const Json& value, const std::string& name, int depth, const auto& put) {
  constexpr int deepest = 8;
  if (value.is_object() && depth < deepest) {
    toml::table table;
    for (const auto& [key, member] : value.items())
      convert(member, name, depth + 1, ToTable{table, key});
    put(std::move(table));
  } else if (value.is_array() && depth < deepest) {
    toml::array array;
    for (const auto& member : value) convert(member, name, depth + 1, ToArray{array});
    put(std::move(array));
  } else if (value.is_number()) {
    put(value.get<double>());
  } else if (value.is_string()) {
    put(value.get<std::string>());
  } else {
    refuse_syntax(name, "null, true, false or deep nesting; allowed: numbers, lists and objects");
  }
}

// Of the object itself, or of its member "problem", as files for programs and `show` have it.
toml::table table_from_json(std::string_view text, const std::string& name) {
  Json json;
  try {
    json = parse_json(text);
  } catch (const InputError& error) {
    refuse_syntax(name, error.what());
  } catch (const Json::exception&) {
  }  // stays null
  if (!json.is_object()) refuse_syntax(name, "not JSON, though it begins with {");
  const auto problem = json.find("problem");
  toml::table root;
  convert(problem == json.end() ? json : *problem, name, 0, ToTable{root, "problem"});
  auto* table = root["problem"].as_table();
  if (table == nullptr) refuse_syntax(name, "problem is no object");
  return std::move(*table);
}

toml::array array_of(std::span<const double> numbers) {
  toml::array array;
  for (const double number : numbers) array.push_back(number);
  return array;
}

// A line of numbers that is a row of a list: those of `names`, and before them a direction.
struct RowLine {
  std::string_view key, list;
  std::vector<std::string_view> names;
};
const std::array<RowLine, 7> row_lines{{
    {"direction", "contacts", {}},
    {"load", "loads", {"dof", "amplitude", "frequency", "phase"}},
    {"spring", "springs", {"gap", "stiffness"}},
    {"sine", "nonlinear_springs", {"stiffness", "length"}},
    {"cubic", "nonlinear_springs", {"stiffness", "length"}},
    {"friction", "frictions", {"limit", "kinetic", "velocity"}},
    {"rubbing", "frictions", {"coefficient", "velocity", "contact"}},
}};

// Of lines key=values as problem_file_text() writes them.
toml::table table_from_lines(std::string_view text, const std::string& name) {
  toml::table root, start;
  std::map<std::string_view, toml::array> lists;
  for (int number = 1; !text.empty(); ++number) {
    const auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const auto place = fmt::format("{}:{}", name, number);
    const auto equals = std::min(line.find('='), line.size());
    const auto letters = line.substr(0, equals).find_last_not_of("0123456789") + 1;
    const auto key = line.substr(0, letters);
    if (key == "unstated") refuse_unstated(place, line.substr(std::min(equals + 1, line.size())));
    std::vector<double> values;
    for (auto rest = line.substr(std::min(equals + 1, line.size())); !rest.empty();) {
      const auto word = rest.substr(0, rest.find(' '));
      const auto value = finite_number(word);
      if (!value) refuse_syntax(place, fmt::format("\"{}\" is no number", printable(word)));
      values.push_back(*value);
      rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    }
    const std::span all = values;
    const auto* row = std::ranges::find(row_lines, key, &RowLine::key);
    const bool is_row = row != row_lines.end(), is_load = key == "load";
    const bool in_contact = key == "gap" || key == "restitution";
    const auto named = is_row ? row->names.size() : 0, before = all.size() - named;
    if (all.empty() || all.size() < named || (is_row && is_load != (before == 0)) ||
        (in_contact && lists["contacts"].empty()))
      refuse_syntax(
          place, fmt::format("\"{}\"; allowed: lines as {{case:text}} has them", printable(line)));
    if (is_row) {
      auto& list = lists[row->list];
      list.push_back(toml::table{});
      auto& numbers = *list.back().as_table();
      if (!is_load) numbers.insert("direction", array_of(all.first(before)));
      for (std::size_t i = 0; i < named; ++i) numbers.insert(row->names[i], all[before + i]);
      if (row->list == "nonlinear_springs") numbers.insert("law", std::string(key));
    } else if (in_contact)
      lists["contacts"].back().as_table()->insert_or_assign(key, all[0]);
    else if (key == "M" || key == "C" || key == "K")
      lists[key].push_back(array_of(all));
    else if (key == "u" || key == "v")
      start.insert_or_assign(key, array_of(all));
    else if (key == "t")
      start.insert_or_assign(key, all[0]);
    else if (key != "dof" && key != "contacts")
      root.insert_or_assign(key, all[0]);
  }
  for (auto& [key, rows] : lists) root.insert_or_assign(key, std::move(rows));
  root.insert_or_assign("start", std::move(start));
  return root;
}

}  // namespace

toml::table table_from(std::string_view text, const std::string& name) {
  if (text.starts_with("dof=")) return table_from_lines(text, name);
  const auto first = text.find_first_not_of(" \t\r\n");
  const bool is_json = first != std::string_view::npos && text[first] == '{';
  auto root = is_json ? table_from_json(text, name) : toml_from(text, name);
  if (const auto law = root["unstated"].value<std::string>()) refuse_unstated(name, *law);
  return root;
}

}  // namespace clackers::model
