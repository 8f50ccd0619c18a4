#include "clackers/base/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers {
namespace {

// Among the words of a parameter: any other text.
constexpr std::string_view any_text = "FILE";

std::vector<std::string> names_of(const std::vector<Word>& words) {
  std::vector<std::string> names;
  for (const auto& word : words) names.push_back(word.name);
  return names;
}

void check_kind(std::string_view owner, const Parameter& parameter, const ParameterValue& value) {
  if (parameter.words.empty()) {
    if (value.is_word())
      refuse(owner, parameter.name, value.text(), parameter.allowed, "A number is needed.",
             "not-a-number");
    return;
  }
  const auto names = names_of(parameter.words);
  if (std::ranges::find(names, any_text) != names.end()) return;
  if (std::ranges::find(names, value.text()) == names.end())
    refuse_name(fmt::format("{} of {}", parameter.name, owner), value.text(), names,
                fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace

ParameterValue::operator double() const {
  if (is_word()) throw std::logic_error(fmt::format("the parameter is \"{}\", no number", word_));
  return number_;
}

std::string ParameterValue::text() const { return is_word() ? word_ : fmt::format("{}", number_); }

std::string Parameter::default_text() const {
  return default_words.empty() ? default_value.text() : default_words;
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
      refuse(owner, name, value.text(), "each parameter once", "It was set twice.", "bad-syntax");
    const auto index = static_cast<std::size_t>(place - names.begin());
    check_kind(owner, parameters[index], value);
    values[index].second = value;
  }
  return values;
}

const ParameterValue& value_of(const Settings& settings, std::string_view name) {
  const auto found = std::ranges::find(settings, name, &Settings::value_type::first);
  if (found == settings.end())
    throw std::logic_error(fmt::format("no parameter \"{}\" among the settings", name));
  return found->second;
}

}  // namespace clackers
