#include "clackers/base/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "clackers/base/error.hpp"
#include "clackers/base/suggest.hpp"

namespace clackers {

std::string Parameter::default_text() const {
  return default_words.empty() ? fmt::format("{}", default_value) : default_words;
}

Settings complete(std::string_view owner, std::span<const Parameter> parameters,
                  const Settings& given) {
  std::vector<std::string> names;
  Settings values;
  for (const auto& parameter : parameters) {
    names.push_back(parameter.name);
    values.emplace_back(parameter.name, parameter.default_value);
  }
  for (auto setting = given.begin(); setting != given.end(); ++setting) {
    const auto& [name, value] = *setting;
    const auto place = std::ranges::find(names, name);
    if (place == names.end())
      refuse_name(fmt::format("parameter of {}", owner), name, names,
                  fmt::format("{}{}clackers show {}{}", fmt::join(names, ", "),
                              names.empty() ? "" : " (", owner, names.empty() ? "" : ")"));
    if (std::ranges::find(given.begin(), setting, name, &Settings::value_type::first) != setting)
      refuse(owner, name, value, "each parameter once", "It was set twice.", "bad-syntax");
    values[static_cast<std::size_t>(place - names.begin())].second = value;
  }
  return values;
}

double value_of(const Settings& settings, std::string_view name) {
  const auto found = std::ranges::find(settings, name, &Settings::value_type::first);
  if (found == settings.end())
    throw std::logic_error(fmt::format("no parameter \"{}\" among the settings", name));
  return found->second;
}

}  // namespace clackers
