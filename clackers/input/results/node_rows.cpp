#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"
#include "clackers/input/results/result_reader.hpp"

namespace clackers::input {

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t from = line.npos;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    const bool blank = i == line.size() || std::isspace(static_cast<unsigned char>(line[i]));
    const bool sign = !blank && i > 0 && (line[i] == '-' || line[i] == '+') &&
                      std::isdigit(static_cast<unsigned char>(line[i - 1]));
    if (from != line.npos && (blank || sign)) {
      fields.push_back(line.substr(from, i - from));
      from = line.npos;
    }
    if (!blank && from == line.npos) from = i;
  }
  return fields;
}

Number number_of(std::string_view text, const std::string& place) {
  Number number;
  const auto error = read_decimal(text, number);
  if (error == NumberError::not_finite)
    refuse(place, "value", printable(text), "a finite number",
           "The run may have left the range of numbers.", "not-finite");
  if (error != NumberError::none)
    refuse(place, "value", printable(text), "a decimal number", {}, "not-a-number");
  return number;
}

std::optional<std::size_t> ChosenNodes::mass_of(std::string_view node) {
  if (masses_.empty())
    for (const auto& name : choice_.nodes) masses_.emplace(name, masses_.size());
  if (const auto found = masses_.find(node); found != masses_.end()) return found->second;
  if (!choice_.nodes.empty()) return {};
  return masses_.emplace(std::string(node), masses_.size()).first->second;
}

void ChosenNodes::finish(const std::string& file,
                         const std::function<bool(std::size_t mass)>& has_values) {
  for (const auto& name : choice_.nodes)
    if (const auto mass = mass_of(name); !mass || !has_values(*mass))
      refuse(file, "--node", printable(name), "a node of the file", {}, "no-column");
  if (masses_.size() > std::size_t(choice_.most_nodes))
    refuse(file, "nodes", double(masses_.size()),
           fmt::format("{}, one for each mass", choice_.most_nodes),
           "Name the nodes of the masses with --node 1,2,...", "no-column");
}

void NodeRows::begin(const Number& time) {
  if (has_time_ && time.value == time_.value) return;
  end_row();
  time_ = time;
  has_time_ = true;
}

void NodeRows::take(std::string_view node, char quantity, std::string_view text,
                    const std::string& place) {
  if (!has_time_) refuse(place, "value", printable(text), "a time above it", {}, "too-short");
  if (const auto mass = nodes_.mass_of(node)) row_[{*mass, quantity}] = number_of(text, place);
}

void NodeRows::end_row() {
  if (row_.empty()) return;
  if (columns_.empty()) {
    rows_.names.emplace_back("t");
    for (const auto& [key, number] : row_) {
      columns_.push_back(key);
      rows_.names.push_back(fmt::format("{}{}", key.second, key.first + 1));
    }
  }
  rows_.numbers.push_back(time_);
  for (const auto& key : columns_) {
    const auto found = row_.find(key);
    if (found == row_.end() || row_.size() != columns_.size())
      refuse(file_, fmt::format("values at t = {}", time_.value), double(row_.size()),
             fmt::format("{}, as at the first time", columns_.size()),
             "The file may have been cut.", "ragged-row");
    rows_.numbers.push_back(found->second);
  }
  row_.clear();
}

ResultRows NodeRows::finish() {
  end_row();
  if (columns_.empty()) refuse(file_, "values", 0.0, "rows of numbers", {}, "too-short");
  nodes_.finish(file_, [&](std::size_t mass) {
    return std::ranges::any_of(columns_, [&](const Key& key) { return key.first == mass; });
  });
  return std::move(rows_);
}

}  // namespace clackers::input
