#include "clackers/input/joined_table.hpp"

#include <algorithm>
#include <filesystem>

#include "clackers/base/error.hpp"

namespace clackers::input {
namespace {

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts{{}};
  for (const char c : text)
    if (c == '+')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

}  // namespace

std::vector<std::string> joined_paths(const std::string& path) {
  std::error_code ignored;
  auto parts = parts_of(path);
  const auto is_file = [&](const std::string& part) {
    return !part.empty() && std::filesystem::exists(part, ignored);
  };
  if (parts.size() == 1 || is_file(path) || std::ranges::none_of(parts, is_file)) return {path};
  return parts;
}

std::vector<std::vector<std::string>> joined_names(const std::string& path,
                                                   const std::vector<std::string>& names,
                                                   std::size_t count) {
  std::vector<std::vector<std::string>> lists(1);
  for (const auto& name : names)
    for (std::size_t i = 0; const auto& part : count > 1 ? parts_of(name) : std::vector{name}) {
      if (i++ > 0) lists.emplace_back();
      lists.back().push_back(part);
    }
  if (names.empty()) lists.resize(count);
  if (lists.size() != count)
    refuse(path, "lists of --columns", double(lists.size()), "one a file, joined by +: t,u1+t,v1",
           {}, "ragged-row");
  return lists;
}

JoinedTable::JoinedTable(std::string name, std::vector<std::unique_ptr<Table>> tables)
    : Table(std::move(name)), tables_(std::move(tables)) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    const auto& own = tables_[i]->names();
    const auto time = std::ranges::find_if(
        own, [](const std::string& column) { return column == "t" || column == "time"; });
    if (time == own.end())
      refuse(tables_[i]->name(), "column", "no t", "times, by which files are joined",
             "Name the columns of each: --columns t,u1,u2+t,v1,v2", "no-column");
    times_.push_back(std::size_t(time - own.begin()));
    for (std::size_t column = 0; column < own.size(); ++column)
      if (i == 0 || column != times_[i]) {
        names.push_back(own[column]);
        columns_.emplace_back(i, column);
      }
  }
  set_names(std::move(names));
}

double JoinedTable::time_of(std::size_t table) {
  Number number;
  tables_[table]->read_number(times_[table], number);
  return number.value;
}

bool JoinedTable::next() {
  for (const auto& table : tables_)
    if (!table->next()) return false;
  double latest = time_of(0);
  for (std::size_t i = 0, agreeing = 0; agreeing < tables_.size(); i = (i + 1) % tables_.size()) {
    double time = time_of(i);
    while (time < latest) {
      if (!tables_[i]->next()) return false;
      time = time_of(i);
    }
    agreeing = time > latest ? 1 : agreeing + 1;
    latest = time;
  }
  return true;
}

void JoinedTable::read_number(std::size_t column, Number& number) {
  tables_[columns_[column].first]->read_number(columns_[column].second, number);
}

RowSide JoinedTable::side(std::size_t column) const {
  return tables_[columns_[column].first]->side(columns_[column].second);
}

}  // namespace clackers::input
