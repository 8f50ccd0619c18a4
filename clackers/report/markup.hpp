#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clackers::report {

/// Text as html text or attribute value.
std::string escape(std::string_view text);

/// Escaped text in which a long name may break: behind every "+" and ":".
std::string breakable(const std::string& escaped);

/// Json that can stand inside a script element: no "<" remains, so no text can end the element.
std::string script_json(const nlohmann::ordered_json& json);

/// A number for a person, as html: "0.0157", "1.2 × 10<sup>−7</sup>"; "–" for NaN.
std::string html_number(double value, int digits);
/// The same with the power of ten from 10^3 up and from 10^-3 down, for columns of errors.
std::string html_scientific(double value, int decimals = 1);
/// A whole number with thin spaces between thousands.
std::string html_count(long long value);

/// The template with every {{name}} replaced. Throws std::logic_error for a slot without a value,
/// since that is a mistake in our own page.
std::string fill(std::string_view page,
                 const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace clackers::report
