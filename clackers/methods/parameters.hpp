#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "clackers/base/parameter.hpp"
#include "clackers/methods/method_specification.hpp"

namespace clackers::methods {

/// A parameter that is a member of the value type T: a number, or a name out of `words`, which then
/// say what is allowed. The default is that of T{}, or NaN with the words for it. A type with
/// parameters lists them in `T::fields()` and checks them in `validate()`.
template <class T>
struct Field {
  std::string_view name, allowed, meaning;
  std::variant<double T::*, std::string T::*> member;
  std::string_view default_words{};
  std::vector<Word> words{};

  ParameterValue get(const T& x) const {
    if (const auto* number = std::get_if<double T::*>(&member)) return x.*(*number);
    return x.*std::get<std::string T::*>(member);
  }
  std::string allowed_text() const {
    std::string text(allowed);
    for (const auto& word : words)
      text += (text.empty() ? std::string(name) + " = " : ", ") + word.name;
    return text;
  }
  void set(T& x, const ParameterValue& value) const {
    if (const auto* number = std::get_if<double T::*>(&member))
      x.*(*number) = value;
    else
      x.*std::get<std::string T::*>(member) = value.text();
  }
};

template <class T>
std::span<const Field<T>> fields_of() {
  if constexpr (requires { T::fields(); })
    return T::fields();
  else
    return {};
}

template <class T>
std::vector<Parameter> parameters_of() {
  std::vector<Parameter> all;
  static const T standard{};
  for (const Field<T>& field : fields_of<T>())
    all.push_back({std::string(field.name), field.get(standard), "", field.allowed_text(),
                   std::string(field.meaning), std::string(field.default_words), field.words});
  return all;
}

/// The value with these parameters. Throws InputError with did-you-mean for names that it does not
/// have, for a name given twice, and for numbers outside their range.
template <class T>
T configured(const Settings& given) {
  T x{};
  const auto values = complete(T::name, parameters_of<T>(), given);
  for (const Field<T>& field : fields_of<T>()) field.set(x, value_of(values, field.name));
  if constexpr (requires { x.validate(); }) x.validate();
  return x;
}

/// The specification of a value: its name, and the parameters that differ from their default with
/// digits that read back to the same number.
template <class T>
std::string specification(const T& x) {
  Settings values;
  for (const Field<T>& field : fields_of<T>()) values.emplace_back(field.name, field.get(x));
  return specification(T::name, parameters_of<T>(), values);
}

}  // namespace clackers::methods
