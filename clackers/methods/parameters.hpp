#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/parameter.hpp"
#include "clackers/methods/method_specification.hpp"

namespace clackers::methods {

/// A parameter that is a member of the value type T. The default is that of T{}, or NaN with the
/// words for it. A type lists its fields in `T::fields()`.
template <class T>
struct Field {
  std::string_view name, allowed, meaning;
  double T::*member;
  std::string_view default_words{};
};

template <class T>
std::vector<Parameter> parameters_of() {
  std::vector<Parameter> all;
  for (const Field<T>& field : T::fields())
    all.push_back({std::string(field.name), T{}.*field.member, "", std::string(field.allowed),
                   std::string(field.meaning), std::string(field.default_words)});
  return all;
}

/// The value with these parameters. Throws InputError with did-you-mean for names that it does not
/// have, for a name given twice, and for numbers outside their range.
template <class T>
T configured(const Settings& given) {
  T x{};
  const auto values = complete(T::name, parameters_of<T>(), given);
  for (const Field<T>& field : T::fields()) x.*field.member = value_of(values, field.name);
  x.validate();
  return x;
}

/// The specification of a value: its name, and the parameters that differ from their default with
/// digits that read back to the same number.
template <class T>
std::string specification(const T& x) {
  Settings values;
  for (const Field<T>& field : T::fields()) values.emplace_back(field.name, x.*field.member);
  return specification(T::name, parameters_of<T>(), values);
}

}  // namespace clackers::methods
