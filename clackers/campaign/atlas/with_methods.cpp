#include <sstream>

#include "clackers/base/files/toml_reader.hpp"
#include "clackers/base/number.hpp"
#include "clackers/campaign/atlas.hpp"

namespace clackers::campaign {
namespace {

void add(toml::array& list, const MethodEntry& entry) {
  if (entry.kind == MethodEntry::Kind::catalogue) {
    list.push_back(entry.text);
    return;
  }
  toml::table values;
  values.insert("exec", entry.text);
  if (!entry.name.empty()) values.insert("name", entry.name);
  if (!entry.expect.empty()) values.insert("expect", entry.expect);
  toml::table labels;
  for (const auto& [key, value] : entry.labels) labels.insert(key, value);
  if (!labels.empty()) values.insert("labels", std::move(labels));
  toml::array steps;
  // In quotes, for the formatter's sake.
  for (const double step : entry.steps) steps.push_back(exact_number(step));
  if (!steps.empty()) values.insert("steps", std::move(steps));
  list.push_back(std::move(values));
}

// Where a position of the parser stands in the text: it counts lines and code points.
std::size_t offset_of(const std::string& text, const toml::source_position& position) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < position.line; ++line) at = text.find('\n', at) + 1;
  for (toml::source_index column = 1; column < position.column; ++column) do
      ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80);
  return at;
}

}  // namespace

// The rest stays as it was typed: the formatter of toml++ has no defined behaviour for numbers below 0.1.
std::string with_methods(const std::string& text, std::span<const MethodEntry> methods) {
  const auto root = toml_from(text, "specification");
  toml::array list;
  for (const auto& entry : methods) add(list, entry);
  std::ostringstream written;
  written << toml::toml_formatter{list};
  const auto* old = root.get("methods");
  if (old == nullptr) return "methods = " + written.str() + "\n" + text;
  const auto begin = offset_of(text, old->source().begin), end = offset_of(text, old->source().end);
  return text.substr(0, begin) + written.str() + text.substr(end);
}

}  // namespace clackers::campaign
