#include "clackers/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clackers/base/error.hpp"

namespace clackers {
namespace {

// Optimal string alignment: the edit distance with swaps of neighbouring letters.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

double require_finite(std::string_view who, std::string_view name, double value) {
  if (!std::isfinite(value)) refuse(who, name, value, "a finite number", {}, "not-finite");
  return value;
}

double require_positive(std::string_view who, std::string_view name, double value) {
  if (!(value > 0.0 && std::isfinite(value)))
    refuse(who, name, value, fmt::format("0 < {} < infinity", name));
  return value;
}

double require_within(std::string_view who, std::string_view name, double value, double lowest,
                      double highest) {
  if (!(value >= lowest && value <= highest))
    refuse(who, name, value, fmt::format("{} <= {} <= {}", lowest, name, highest));
  return value;
}

double require_step(std::string_view who, double h) {
  if (!(h > 0.0 && std::isfinite(h)))
    refuse(who, "h", h, "0 < h < infinity, in seconds", {}, "step-not-positive");
  return h;
}

std::string nearest(std::string_view given, std::span<const std::string> known) {
  std::string best;
  // The dashes of an option count as one letter.
  const auto dashes = std::min(given.find_first_not_of('-'), given.size());
  std::size_t least = (given.size() - (dashes + 1) / 2) / 3 + 2;
  for (const auto& name : known) {
    // The distance is no less than that of the lengths.
    if (std::max(given.size(), name.size()) - std::min(given.size(), name.size()) >= least)
      continue;
    const auto far = distance(given, name);
    if (far < least) {
      least = far;
      best = name;
    }
  }
  const auto is_start = [&](const std::string& name) { return name.starts_with(given); };
  if (best.empty() && given.size() > dashes + 2)
    if (const auto found = std::ranges::find_if(known, is_start); found != known.end())
      best = *found;
  return best;
}

void refuse_name(std::string_view what, std::string_view given, std::span<const std::string> known,
                 std::string_view where_listed) {
  const auto guess = nearest(given, known);
  throw InputError(
      fmt::format("clackers: no {} \"{}\".{} All names: {}", what, given,
                  guess.empty() ? "" : fmt::format(" Did you mean \"{}\"?", guess), where_listed),
      "unknown-name");
}

}  // namespace clackers
