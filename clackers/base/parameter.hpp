#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clackers {

/// What a parameter is set to: a number, or a word ("hertz").
class ParameterValue {
 public:
  // Implicit, as settings are written down in braces.
  ParameterValue(double number = 0.0) : number_(number) {}                 // NOLINT
  ParameterValue(std::string word) : word_(std::move(word)) {}             // NOLINT
  ParameterValue(const char* word) : ParameterValue(std::string(word)) {}  // NOLINT

  bool is_word() const { return !word_.empty(); }
  /// The number. After complete() a parameter without words has one; a word here is an error of the
  /// program: std::logic_error.
  operator double() const;  // NOLINT(google-explicit-constructor)
  /// As typed; a number with digits that read back to it.
  std::string text() const;

  bool operator==(const ParameterValue&) const = default;

 private:
  double number_ = 0.0;
  std::string word_;  // empty: a number
};

/// Values of parameters by name, as given; those not named keep their default.
using Settings = std::vector<std::pair<std::string, ParameterValue>>;

/// One word that a parameter may be set to.
struct Word {
  std::string name;      ///< "hertz": a letter, then letters, digits and hyphens
  std::string summary;   ///< one line
  std::string source{};  ///< of the literature; may be empty
};

/// One `name=value` of a method or a case.
struct Parameter {
  std::string name;
  ParameterValue default_value{};  ///< used when not given; NaN: see default_words
  std::string unit;                ///< empty when dimensionless
  std::string allowed;             ///< "0 <= xi1 < 1"
  std::string meaning;
  std::string default_words{};  ///< "1e4 k1", for a default that depends on the problem
  std::vector<Word> words{};    ///< all that it may be; empty: a number

  /// The default as a listing shows it, or as it would be typed.
  std::string default_text() const;
};

/// All parameters in their order: the given ones, else their defaults. Throws InputError for a name
/// that `owner` does not have (with did-you-mean) or that is given twice, for a word that a parameter
/// does not have (with did-you-mean), and for a word in place of a number.
Settings complete(std::string_view owner, std::span<const Parameter> parameters,
                  const Settings& given);

/// The value of a name that is among the settings.
const ParameterValue& value_of(const Settings& settings, std::string_view name);

}  // namespace clackers
