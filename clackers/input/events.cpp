#include "clackers/input/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/input/table.hpp"

namespace clackers::input {
namespace {

using Column = std::optional<std::size_t>;

Column find(const Table& table, const std::string& name) {
  const auto at = std::ranges::find(table.names(), name);
  if (at == table.names().end()) return {};
  return static_cast<std::size_t>(at - table.names().begin());
}

// The columns of one quantity, mass by mass ("v1-", "v2-"); empty when there is none at all.
std::vector<Column> find_all(const Table& table, const std::string& letter, const std::string& side,
                             int dof) {
  std::vector<Column> columns;
  for (int j = 1; j <= dof; ++j) {
    auto column = find(table, letter + std::to_string(j) + side);
    if (!column && dof == 1) column = find(table, letter + side);
    columns.push_back(column);
  }
  if (std::ranges::none_of(columns, [](const Column& c) { return c.has_value(); })) columns.clear();
  return columns;
}

double number_in(Table& table, std::size_t column) {
  Number number;
  table.read_number(column, number);
  return number.value;
}

int contact_in(Table& table, std::size_t column, int contacts) {
  const double number = number_in(table, column);
  if (!(number >= 0.0 && number < contacts && number == std::floor(number)))
    refuse(table.place(), "contact", number,
           fmt::format("a whole number from 0 to {}", contacts - 1));
  return int(number);
}

std::vector<double> numbers_in(Table& table, const std::vector<Column>& columns) {
  std::vector<double> numbers;
  for (const auto& column : columns)
    numbers.push_back(column ? number_in(table, *column) : unknown);
  return numbers;
}

}  // namespace

std::vector<model::Impact> read_events(const Source& source, int dof, int contacts,
                                       const std::atomic<bool>* interrupt) {
  const auto opened = open_table(source, {}, TableKind::events, interrupt);
  auto& table = *opened;
  auto t = find(table, "t");
  if (!t) t = find(table, "time");
  if (!t)
    throw InputError(table.name() + " has no column t; impacts need their times.", "no-column");
  const auto contact = contacts > 1 ? find(table, "contact") : Column();
  if (contacts > 1 && !contact)
    throw InputError(fmt::format("{} has no column contact; the problem has {} contacts, and each "
                                 "impact needs the number of one, from 0.",
                                 table.name(), contacts),
                     "no-column");
  const auto impulse = find(table, "impulse");
  const auto u = find_all(table, "u", "", dof);
  const auto before = find_all(table, "v", "-", dof), after = find_all(table, "v", "+", dof);
  std::vector<model::Impact> impacts;
  while (table.next()) {
    model::Impact impact;
    impact.t = number_in(table, *t);
    if (!impacts.empty() && impact.t < impacts.back().t)
      refuse(table.place(), "t", impact.t,
             fmt::format("at least {} s, the time above it", impacts.back().t),
             "Sort the impacts by time.", "not-sorted");
    if (contact) impact.contact = contact_in(table, *contact, contacts);
    impact.impulse = impulse ? number_in(table, *impulse) : unknown;
    impact.u = numbers_in(table, u);
    impact.v_before = numbers_in(table, before);
    impact.v_after = numbers_in(table, after);
    impacts.push_back(std::move(impact));
  }
  return impacts;
}

}  // namespace clackers::input
