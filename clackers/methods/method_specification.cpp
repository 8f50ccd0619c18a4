#include "clackers/methods/method_specification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"

namespace clackers::methods {
namespace {

bool is_small_letter(char c) { return c >= 'a' && c <= 'z'; }
bool is_letter(char c) { return is_small_letter(c) || (c >= 'A' && c <= 'Z'); }

bool is_word(std::string_view text) {
  return !text.empty() && is_small_letter(text.front()) && std::ranges::all_of(text, [](char c) {
    return is_small_letter(c) || (c >= '0' && c <= '9') || c == '-';
  });
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  MethodSpecification specification() const {
    const auto terms = terms_of(text_);
    if (terms.size() > 2) refuse("it joins more than two names");
    MethodSpecification result{term(terms[0]), {}};
    if (terms.size() == 2) result.contact = term(terms[1]);
    return result;
  }

 private:
  [[noreturn]] void refuse(std::string_view why, Code code = "bad-syntax") const {
    throw InputError(
        fmt::format("clackers: method \"{}\": {}; allowed: name:parameter=value,...+contact "
                    "without blanks, for example newmark:beta=0.25+penalty:stiffness=1e6.",
                    text_, why),
        code);
  }

  Term term(std::string_view text) const {
    const auto colon = text.find(':');
    Term result{std::string(text.substr(0, colon)), {}};
    if (result.name.empty()) refuse("a name is missing");
    if (result.name.find_first_of("=,+ ") != std::string::npos)
      refuse(fmt::format("\"{}\" is no name", result.name));
    if (colon == std::string_view::npos) return result;
    for (auto rest = text.substr(colon + 1);;) {
      const auto comma = rest.find(',');
      result.settings.push_back(setting(rest.substr(0, comma)));
      if (comma == std::string_view::npos) return result;
      rest.remove_prefix(comma + 1);
    }
  }

  std::pair<std::string, ParameterValue> setting(std::string_view text) const {
    const auto equals = text.find('=');
    if (equals == std::string_view::npos || equals == 0)
      refuse(fmt::format("\"{}\" is not parameter=value", text));
    const auto name = text.substr(0, equals);
    return {std::string(name), value(name, text.substr(equals + 1))};
  }

  ParameterValue value(std::string_view name, std::string_view text) const {
    double value = 0.0;
    const auto error = read_number(text, value);
    if (error == NumberError::not_finite && std::isinf(value))
      refuse(fmt::format("{} = \"{}\" is not finite", name, text), "not-finite");
    if (error == NumberError::not_finite)
      refuse(fmt::format("{} = \"{}\" is no number", name, text), "not-a-number");
    if (error != NumberError::none) {
      if (is_word(text)) return std::string(text);
      refuse(fmt::format("{} = \"{}\" is neither a number nor a word", name, text), "not-a-number");
    }
    return value;
  }

  std::string_view text_;
};

}  // namespace

// The sign of an exponent (1e+6) stands before a digit, a separator before a letter.
std::vector<std::string_view> terms_of(std::string_view text) {
  std::vector<std::string_view> terms;
  std::size_t begin = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '+' && is_letter(text[i + 1])) {
      terms.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  terms.push_back(text.substr(begin));
  return terms;
}

MethodSpecification parse_specification(std::string_view text) {
  return Parser(text).specification();
}

std::string specification(std::string_view name, std::span<const Parameter> parameters,
                          const Settings& values) {
  std::string text(name);
  char mark = ':';
  for (const auto& parameter : parameters) {
    const auto& value = value_of(values, parameter.name);
    if (value == parameter.default_value || (!value.is_word() && std::isnan(value))) continue;
    text += fmt::format("{}{}={}", mark, parameter.name, value.text());
    mark = ',';
  }
  return text;
}

}  // namespace clackers::methods
