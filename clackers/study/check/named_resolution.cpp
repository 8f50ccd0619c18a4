#include "clackers/study/check/named_resolution.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>
#include <string>

namespace clackers::study {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

constexpr std::array<std::string_view, 5> step_words = {"h", "dt", "step", "timestep", "stepsize"};
constexpr std::array<std::string_view, 5> count_words = {"n", "nt", "steps", "nsteps", "nstep"};
constexpr std::array<std::string_view, 7> tolerance_words = {
    "tol", "rtol", "atol", "reltol", "abstol", "tolerance", "eps"};

bool contains(std::span<const std::string_view> words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

// "0p005" is 0.005.
std::string with_decimal_point(std::string_view text) {
  std::string number(text);
  for (std::size_t i = 1; i + 1 < number.size(); ++i)
    if (number[i] == 'p' && is_digit(number[i - 1]) && is_digit(number[i + 1])) number[i] = '.';
  return number;
}

std::optional<double> leading_number(std::string_view text) {
  if (!text.empty() && (text[0] == '=' || text[0] == '_' || text[0] == '-')) text.remove_prefix(1);
  if (text.empty() || !(is_digit(text[0]) || text[0] == '.')) return {};
  const auto number = with_decimal_point(text);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || !(value > 0.0) || !std::isfinite(value)) return {};
  return value;
}

void take(NamedResolution& found, std::string_view word, double value) {
  constexpr double fewest_steps = 10.0, largest_tolerance = 0.1;
  if (contains(step_words, word)) {
    if (!found.step) found.step = value;
  } else if (contains(count_words, word)) {
    if (!found.count && value >= fewest_steps && value == std::floor(value)) found.count = value;
  } else if (contains(tolerance_words, word)) {
    if (!found.tolerance && value <= largest_tolerance) found.tolerance = value;
  }
}

double step_of(const NamedResolution& named, double end) {
  return named.step ? *named.step : end / *named.count;
}

// Two files at least, all with a number of their own.
bool all_differ(std::vector<double> numbers, std::size_t files) {
  std::ranges::sort(numbers);
  return files > 1 && numbers.size() == files &&
         std::ranges::adjacent_find(numbers) == numbers.end();
}

// Times between rows are printed, and medians of uneven ones.
constexpr double row_slack = 1.01;

// A history of a longer step has no closer rows.
bool rows_follow(std::span<const double> steps, std::span<const NamedHistory> set) {
  for (std::size_t i = 0; i < set.size(); ++i)
    for (std::size_t j = 0; j < set.size(); ++j) {
      const bool known = set[i].spacing > 0.0 && set[j].spacing > 0.0;
      if (known && steps[i] > steps[j] && row_slack * set[i].spacing < set[j].spacing) return false;
    }
  return true;
}

}  // namespace

NamedResolution named_resolution(std::string_view path) {
  std::string name(path.substr(path.find_last_of('/') + 1));
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  NamedResolution found;
  for (std::size_t at = 0; at < name.size();) {
    if (!is_letter(name[at])) {
      ++at;
      continue;
    }
    auto end = at;
    while (end < name.size() && is_letter(name[end])) ++end;
    if (const auto value = leading_number(std::string_view(name).substr(end)))
      take(found, std::string_view(name).substr(at, end - at), *value);
    at = end;
  }
  return found;
}

NamedSteps named_steps(std::span<const NamedHistory> set, double fast_period, double end) {
  NamedSteps chosen;
  chosen.steps.resize(set.size());
  std::vector<double> steps, tolerances;
  for (const auto& [named, spacing] : set) {
    if (named.tolerance) tolerances.push_back(*named.tolerance);
    if (named.step || named.count) steps.push_back(step_of(named, end));
  }
  if (!all_differ(steps, set.size()) && all_differ(tolerances, set.size())) {
    chosen.by_tolerance = true;
    chosen.steps.assign(tolerances.begin(), tolerances.end());
    return chosen;
  }
  if (all_differ(steps, set.size()) && *std::ranges::max_element(steps) <= fast_period &&
      rows_follow(steps, set)) {
    chosen.steps.assign(steps.begin(), steps.end());
    return chosen;
  }
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto& [named, spacing] = set[i];
    if (!named.step && !named.count) continue;
    const double step = step_of(named, end);
    if (step <= row_slack * spacing) chosen.steps[i] = step;
  }
  return chosen;
}

}  // namespace clackers::study
