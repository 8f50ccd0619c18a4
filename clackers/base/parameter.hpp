#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clackers {

/// Values of parameters by name, as given; those not named keep their default.
using Settings = std::vector<std::pair<std::string, double>>;

/// One `name=value` of a method or a case.
struct Parameter {
  std::string name;
  double default_value = 0.0;  ///< used when not given; NaN: see default_words
  std::string unit;            ///< empty when dimensionless
  std::string allowed;         ///< "0 <= xi1 < 1"
  std::string meaning;
  std::string default_words{};  ///< "1e4 k1", for a default that depends on the problem

  /// The default as a listing shows it, or as it would be typed.
  std::string default_text() const;
};

/// All parameters in their order: the given ones, else their defaults. Throws InputError for a name
/// that `owner` does not have (with did-you-mean) or that is given twice.
Settings complete(std::string_view owner, std::span<const Parameter> parameters,
                  const Settings& given);

/// The value of a name that is among the settings.
double value_of(const Settings& settings, std::string_view name);

}  // namespace clackers
