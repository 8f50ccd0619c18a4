#pragma once

#include <fmt/format.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/base/suggest.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers::methods {

/// Parameters as typed: name and number.
using Settings = std::vector<std::pair<std::string, double>>;

/// One parameter of the value type T. A type that has any lists them in `T::parameters()`.
template <class T>
struct ParameterOf {
  std::string_view name, allowed, meaning;
  std::optional<double> (*get)(const T&);  ///< empty: left to the method
  void (*set)(T&, double);
  std::string_view default_value{};  ///< in words, where T{} leaves it empty
};

/// The parameter that is a plain member.
template <auto Member, class T>
ParameterOf<T> member_parameter(std::string_view name, std::string_view allowed,
                                std::string_view meaning) {
  return {name, allowed, meaning, [](const T& x) -> std::optional<double> { return x.*Member; },
          [](T& x, double value) { x.*Member = value; }};
}

/// The name of a method as it would be typed: parameters that differ from their default are
/// spelled out, with digits that read back to the same number.
template <class T>
std::string spelled(const T& x) {
  std::string text(T::name);
  char mark = ':';
  for (const ParameterOf<T>& p : T::parameters())
    if (const auto value = p.get(x); value && value != p.get(T{})) {
      text += fmt::format("{}{}={}", mark, p.name, *value);
      mark = ',';
    }
  return text;
}

/// The value with these parameters. Throws InputError with did-you-mean for names it has not, and
/// for numbers outside their range.
template <class T>
T configured(const Settings& settings) {
  T x{};
  std::vector<std::string> known;
  for (const ParameterOf<T>& p : T::parameters()) known.emplace_back(p.name);
  for (const auto& [name, value] : settings) {
    bool found = false;
    for (const ParameterOf<T>& p : T::parameters())
      if (p.name == name) {
        p.set(x, value);
        found = true;
      }
    if (!found)
      refuse_name(fmt::format("parameter of {}", T::name), name, known,
                  fmt::format("clackers show {}", T::name));
  }
  x.validate();
  return x;
}

/// What listings tell of a type.
template <class T>
Entry entry_of(std::string_view kind, std::string_view card) {
  Entry entry{
      std::string(T::name), std::string(kind), std::string(T::summary), {}, std::string(card)};
  for (const ParameterOf<T>& p : T::parameters()) {
    const auto given = p.get(T{});
    entry.parameters.push_back({std::string(p.name),
                                given ? fmt::format("{}", *given) : std::string(p.default_value),
                                std::string(p.allowed), std::string(p.meaning)});
  }
  return entry;
}

}  // namespace clackers::methods
