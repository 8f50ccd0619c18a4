#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/fit/rules.hpp"

namespace clackers::judge {
namespace {

bool rates_grow(const Window& window) {
  return std::ranges::all_of(window.rates, [](double rate) { return rate < -straight_rates; });
}

// The finest levels whose errors are one number to two digits, where they span what a line must.
std::optional<Window> flat_to_two_digits(const Range& range) {
  constexpr double two_digits = 1.01;
  constexpr std::size_t enough_runs = 6;
  for (int from = range.first; from < range.clear; ++from) {
    const auto points = raw_points(range.levels, from, range.clear);
    if (points.y.size() < enough_runs || octaves_of(points) < shortest_line) return {};
    const auto [least, most] = std::ranges::minmax(points.y);
    if (most - least <= std::log(two_digits)) return window(range.levels, from, range.clear);
  }
  return {};
}

bool changes_sides(const Window& window) {
  int turns = 0;
  for (std::size_t i = 2; i < window.rates.size(); ++i)
    turns +=
        (window.rates[i] - window.rates[i - 1]) * (window.rates[i - 1] - window.rates[i - 2]) < 0.0;
  return turns > 0;
}

}  // namespace

RuleResult nothing_to_fit(const Range& range, const FitContext& context) {
  if (range.levels.empty()) return undecided(range, "too-few-levels");
  if (context.by_tolerance || !(context.contact_time > 0.0) ||
      range.smallest_step * steps_per_contact <= context.contact_time)
    return {};
  if (range.smallest_step * fewest_steps_per_contact <= context.contact_time)
    if (const auto flat = flat_to_two_digits(range)) return stagnates(range, context, *flat);
  return undecided(range, "contact-not-resolved");
}

RuleResult finest_failed(const Range& range, const FitContext&) {
  if (range.level(range.finest).usable) return {};
  int last = range.finest;
  while (last >= 0 && !range.level(last).usable) --last;
  const auto tail = last >= 2 ? window(range.levels, last - 2, last) : std::nullopt;
  return tail && rates_grow(*tail) ? diverges(range.blank) : undecided(range, "run-failed");
}

RuleResult at_rounding_floor(const Range& range, const FitContext&) {
  if (range.above >= range.first) return {};
  return range.first > 0 ? undecided(range, "run-failed") : shows(range.blank, Behaviour::exact);
}

RuleResult too_few_levels(const Range& range, const FitContext& context) {
  if (range.clear_levels() >= shortest_window) return {};
  // Near the floor a line shows when its order is known: without a claim the nearest whole one.
  const auto found = window(range.levels, range.first, range.clear);
  const double whole = found ? std::round(found->line.slope) : 0.0;
  if (!(context.claimed_order > 0.0) && range.clear < range.finest && whole >= 1.0) {
    auto claimed = context;
    claimed.claimed_order = whole;
    if (auto fit = claimed_line(range, claimed)) return fit;
  }
  return undecided(range, "too-few-levels");
}

RuleResult anything_else(const Range& range, const FitContext& context) {
  if (range.level(range.finest).error >= context.saturation)
    return undecided(range, "larger-than-motion");
  const auto tail = range.last(2);
  const double claimed = context.claimed_order;
  const bool as_claimed =
      tail && claimed > 0.0 &&
      is_straight(*tail, {.rates = 0.1 * claimed, .around_slope = false, .centre = claimed});
  if (as_claimed) return undecided(range, "too-few-levels");
  const auto all = window(range.levels, range.tracked, range.clear);
  if (one_sample_a_level(range) && all && changes_sides(*all))
    return undecided(range, "one-sample-a-level");
  return undecided(range, "no-convergence-yet");
}

}  // namespace clackers::judge
