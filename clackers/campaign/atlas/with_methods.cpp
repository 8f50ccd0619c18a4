#include <sstream>

#include "clackers/campaign/atlas.hpp"
#include "clackers/cases/toml_reader.hpp"

namespace clackers::campaign {
namespace {

void add(toml::array& list, const MethodEntry& entry) {
  if (entry.kind == MethodEntry::Kind::catalogue) {
    list.push_back(entry.text);
    return;
  }
  toml::table values;
  values.insert(entry.kind == MethodEntry::Kind::command ? "exec" : "plugin", entry.text);
  if (!entry.name.empty()) values.insert("name", entry.name);
  if (!entry.expect.empty()) values.insert("expect", entry.expect);
  list.push_back(std::move(values));
}

}  // namespace

std::string with_methods(const std::string& text, std::span<const MethodEntry> methods) {
  auto root = toml_from(text, "specification");
  toml::array list;
  for (const auto& entry : methods) add(list, entry);
  root.insert_or_assign("methods", std::move(list));
  std::ostringstream out;
  out << toml::toml_formatter{root} << '\n';
  return out.str();
}

}  // namespace clackers::campaign
