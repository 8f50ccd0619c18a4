#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "clackers/base/number.hpp"
#include "clackers/diagnose/diagnosis.hpp"

namespace clackers::diagnose {
namespace {

std::string plain(double value, int digits = 4) {
  return std::isnan(value) ? std::string() : short_number(value, digits);
}

// With as many digits as the uncertainty leaves, "0.9900 ±0.0001".
std::string with_uncertainty(double value, double uncertainty) {
  if (!(uncertainty > 0.0) || !std::isfinite(uncertainty)) return plain(value, 6);
  if (uncertainty < 1e-6 * std::abs(value) || uncertainty >= std::abs(value))
    return fmt::format("{} ±{}", plain(value, 7), short_number(uncertainty, 1));
  const int decimals = std::clamp(int(-std::floor(std::log10(uncertainty))), 0, 12);
  return fmt::format("{:.{}f} ±{:.{}f}", value, decimals, uncertainty, decimals);
}

std::string percent(double share, int digits = 3) {
  if (std::isnan(share)) return {};
  // Not 1e2.
  return short_number(100.0 * share, share >= 0.995 ? std::max(digits, 3) : digits) + " %";
}

// The value as a share, which is in per cent or not.
double share_of(const Diagnosis& cause) {
  return cause.unit == "%" ? cause.value / 100.0 : cause.value;
}

// A relative change, "differs by +0.50 %", or another value, "looks like 0.75 instead of 0.5".
std::string looks(const Diagnosis& cause) {
  const double expected = cause.fact("expected"), uncertainty = cause.fact("uncertainty");
  if (!std::isnan(expected) && expected != 0.0)
    return fmt::format("looks like {} instead of {}", with_uncertainty(cause.value, uncertainty),
                       plain(expected, 6));
  const double scale = cause.unit == "%" ? 1.0 : 100.0;
  return fmt::format("differs by {}{} %", cause.value > 0.0 ? "+" : "",
                     with_uncertainty(scale * cause.value, scale * uncertainty));
}

std::string load(const Diagnosis& cause) {
  if (cause.text == "missing") return "is missing";
  const auto amplitude = with_uncertainty(cause.value, cause.fact("uncertainty"));
  const double late = cause.fact("time"), uncertainty = cause.fact("uncertainty");
  const auto when =
      fmt::format("comes {} s too {}", plain(std::abs(late)), late > 0.0 ? "late" : "early");
  if (std::isnan(late)) return fmt::format("has {} times its amplitude", amplitude);
  if (std::abs(cause.value - 1.0) < std::max(1e-3, 3.0 * uncertainty)) return when;
  return fmt::format("has {} times its amplitude and {}", amplitude, when);
}

std::string shift(const Diagnosis& cause) {
  const double size = std::abs(cause.value);
  const auto number = with_uncertainty(size, cause.fact("uncertainty"));
  return fmt::format("{} {}", number, size == 1.0 && cause.unit == "steps" ? "step" : cause.unit);
}

// "u mm" of unit-scaled: the quantity and the unit.
std::string quantity(const Diagnosis& cause) {
  const bool is_part = cause.text.starts_with("u ") || cause.text.starts_with("v ") ||
                       cause.text == "u" || cause.text == "v";
  if (!is_part) return "Displacements and velocities";
  return cause.text[0] == 'u' ? "Displacements" : "Velocities";
}

std::string unit_text(const Diagnosis& cause) {
  if (cause.text == "u" || cause.text == "v") return {};
  return cause.text.substr(cause.text.find(' ') + 1);
}

// What stands for a name in braces; empty where it is not known.
std::string word(std::string_view name, const Diagnosis& cause) {
  if (name == "value") return plain(cause.value);
  if (name == "value_pm")
    return std::isnan(cause.value) ? std::string()
                                   : with_uncertainty(cause.value, cause.fact("uncertainty"));
  if (name == "percent") return percent(share_of(cause));
  if (name == "share_percent") return percent(cause.fact("share"), 2);
  if (name == "looks") return looks(cause);
  if (name == "damping" && cause.unit != "%")
    return fmt::format("looks like a ratio of {} instead of none",
                       with_uncertainty(cause.value, cause.fact("uncertainty")));
  if (name == "damping") return looks(cause);
  if (name == "runs")
    return fmt::format("runs {} too {}", percent(std::abs(share_of(cause))),
                       cause.value > 0.0 ? "fast" : "slow");
  if (name == "whose_load")
    return std::isnan(cause.fact("mass"))
               ? "Each load"
               : fmt::format("The load on mass {}", plain(cause.fact("mass")));
  if (name == "load") return load(cause);
  if (name == "clock" && cause.text.empty())
    return fmt::format("run {} too {}", percent(std::abs(cause.value - 1.0)),
                       cause.value > 1.0 ? "fast" : "slow");
  if (name == "clock")
    return fmt::format("are in {}, {} times seconds", cause.text, plain(cause.value));
  if (name == "clock_cure" && std::isnan(cause.value))
    return "convert them to seconds, or check the step that is taken and the one that is printed";
  if (name == "clock_cure")
    return cause.text.empty() ? "check the step that is taken and the one that is printed"
                              : "convert them to seconds";
  if (name == "shift") return shift(cause);
  if (name == "late") return cause.value > 0.0 ? "late" : "early";
  if (name == "later") return cause.value > 0.0 ? "later" : "earlier";
  if (name == "impacts" && std::isnan(cause.value) && cause.fact("share") == 1.0) {
    const double contact = cause.fact("contact");
    return std::isnan(contact) ? "All impacts are"
                               : fmt::format("All impacts of contact {} are", contact);
  }
  if (name == "impacts") return fmt::format("Impact {} is", plain(cause.value, 9));
  if (name == "number")
    return plain(std::isnan(cause.value) ? cause.fact("impact") : cause.value, 9);
  if (name == "level" && cause.text == "tolerance")
    return "tolerance = " + plain(cause.fact("step"), 3);
  if (name == "level") return fmt::format("h = {} s", plain(cause.fact("step"), 3));
  if (name == "quantity") return quantity(cause);
  if (name == "unit_text") return unit_text(cause);
  if (name == "text") return cause.text;
  if (name == "floor") return std::isnan(cause.fact(name)) ? "" : scientific(cause.fact(name));
  return plain(cause.fact(name), name == "expected" ? 6 : 3);
}

// A part without brackets; nothing where a word in it is not known.
std::optional<std::string> filled_part(std::string_view part, const Diagnosis& cause) {
  std::string text;
  bool complete = true;
  for (std::size_t at = 0; at < part.size();) {
    if (part[at] != '{') {
      text += part[at++];
      continue;
    }
    const auto end = part.find('}', at);
    const auto found = word(part.substr(at + 1, end - at - 1), cause);
    complete = complete && !found.empty();
    text += found;
    at = end + 1;
  }
  if (!complete) return {};
  return text;
}

std::string filled(std::string_view pattern, const Diagnosis& cause) {
  std::string text;
  while (!pattern.empty()) {
    const bool optional = pattern.front() == '[';
    const auto end = optional ? pattern.find(']') : std::min(pattern.find('['), pattern.size());
    const auto part = pattern.substr(optional ? 1 : 0, end - (optional ? 1 : 0));
    if (const auto known = filled_part(part, cause))
      text += *known;
    else if (!optional)
      text += "?";
    pattern.remove_prefix(optional ? end + 1 : end);
  }
  return text;
}

std::string gain_text(const Diagnosis& cause) {
  const double gain = cause.fact("gain");
  if (!(gain >= 2.0)) return {};
  const auto times = [](double factor) {
    return factor < 1000.0 ? fmt::format("{:.0f}", factor) : short_number(factor, 1);
  };
  constexpr double explains_all = 50.0;
  auto text = gain < explains_all
                  ? fmt::format(" ({} of the error stays unexplained", percent(1.0 / gain, 2))
                  : fmt::format(" ({} times closer", times(gain));
  if (cause.fact("causes") > 1.0)
    text += fmt::format(" by {} causes together", plain(cause.fact("causes")));
  const double other = cause.fact("runner-up-gain");
  if (!cause.runner_up.empty() && cause.runner_up != cause.code && other >= 2.0)
    text += fmt::format("; {}: {} times", cause.runner_up, times(other));
  return text + ")";
}

}  // namespace

std::string meaning_of(const Cause& cause) {
  auto cure = filled(cause.cure, {});
  cure[0] = char(std::toupper(cure[0]));
  return fmt::format("{} {}", cause.code.meaning(), cure);
}

std::string sentence_of(const Diagnosis& found) {
  const auto* cause = find_cause(found.code);
  if (cause == nullptr) return {};
  return fmt::format("{}{}: {}", filled(cause->what, found), gain_text(found),
                     filled(cause->cure, found));
}

}  // namespace clackers::diagnose
