#include "clackers/cases/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/suggest.hpp"

namespace clackers::cases {

Settings complete(const CaseEntry& entry, const Settings& given) {
  std::vector<std::string> names;
  Settings values;
  for (const auto& parameter : entry.parameters) {
    names.push_back(parameter.name);
    values.emplace_back(parameter.name, parameter.default_value);
  }
  std::vector<std::string> seen;
  for (const auto& [name, value] : given) {
    const auto place = std::ranges::find(names, name);
    if (place == names.end())
      refuse_name(fmt::format("parameter of {}", entry.name), name, names,
                  fmt::format("{} (clackers show {})", fmt::join(names, ", "), entry.name));
    if (std::ranges::find(seen, name) != seen.end())
      refuse(entry.name, name, value, "each parameter once", "It was set twice.", "bad-syntax");
    seen.push_back(name);
    values[static_cast<std::size_t>(place - names.begin())].second = value;
  }
  return values;
}

double Values::operator[](std::string_view name) const {
  return std::ranges::find(values_, name, &Settings::value_type::first)->second;
}

double ratio_of(std::string_view who, double N) {
  const auto rule = fmt::format("a whole number, 0 <= N <= {:.0f}", largest_N);
  if (!(N >= 0.0 && N <= largest_N))
    refuse(who, "N", N, rule, N < 0.0 ? "Mass 2 is X = 4N + 1 times as fast as mass 1." : "");
  if (N != std::floor(N))
    refuse(who, "N", N, rule,
           "Only with X = 4N + 1 odd both masses pass equilibrium together at every collision.",
           "not-whole");
  return 4.0 * N + 1.0;
}

double end_of(std::string_view who, double a_t) { return 20.0 * require_positive(who, "a_t", a_t); }

}  // namespace clackers::cases
