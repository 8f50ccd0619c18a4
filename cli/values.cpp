#include "cli/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"

namespace clackers::cli {
double read_number(std::string_view what, std::string_view text) {
  double value = 0.0;
  switch (clackers::read_number(text, value)) {
    case NumberError::none:
      return value;
    case NumberError::not_finite:
      if (!std::isfinite(value)) return value;  // nan and inf as words
      refuse("clackers", what, text, "a number that a double can hold, 5e-324 to 1.8e308 in size",
             {}, "not-finite");
    default:
      refuse("clackers", what, fmt::format("\"{}\"", text),
             "a number with a decimal point such as 0.05, 5e-2 or 1/20",
             text.find(',') != std::string_view::npos ? "Use a point, not a comma." : "",
             "not-a-number");
  }
}

long long read_whole(std::string_view what, std::string_view text, long long lowest,
                     long long highest) {
  constexpr long long most_shown = 1'000'000'000'000;
  const auto rule = highest > most_shown ? std::string("a whole number")
                                         : fmt::format("a whole number, {} to {}", lowest, highest);
  double value = 0.0;
  if (clackers::read_number(text, value) == NumberError::no_number || std::isnan(value))
    refuse("clackers", what, fmt::format("\"{}\"", text), rule, {}, "not-a-number");
  value = read_number(what, text);
  if (!(value >= double(lowest) && value <= double(highest) && value == std::floor(value)))
    refuse("clackers", what, text, rule);
  return static_cast<long long>(value);
}

double read_duration(std::string_view what, std::string_view text) {
  auto number = text;
  double unit = 1.0;
  for (const auto& [name, seconds] :
       {std::pair<std::string_view, double>{"min", 60.0}, {"h", 3600.0}, {"s", 1.0}})
    if (number.ends_with(name)) {
      number.remove_suffix(name.size());
      unit = seconds;
      break;
    }
  const double duration = unit * read_number(what, number);
  if (!(duration >= 0.0 && std::isfinite(duration)))
    refuse("clackers", what, text, "0 or more seconds, such as 30s or 2min");
  return duration;
}

namespace {

// "dense", "./frame.toml"; not nan and inf. Whether the parameter takes a word is its case's to say.
bool is_word(std::string_view text) {
  if (text.empty() || text == "nan" || text == "inf") return false;
  const auto first = static_cast<unsigned char>(text.front());
  return std::isalpha(first) != 0 || first == '/' || text.starts_with("./") ||
         text.starts_with("../");
}

}  // namespace

bool is_case(const std::string& word) {
  return std::ranges::find(cases::entries(), word, &cases::CaseEntry::name) !=
         cases::entries().end();
}

std::string case_of(const std::string& first, const std::string& behind,
                    const std::string& problem) {
  constexpr auto of_files = "piecewise";
  if (!first.empty() && !behind.empty() && first != behind)
    refuse("clackers", "--case", behind, "one case",
           fmt::format("{} is named already; leave {} or --case out.", first, first), "bad-syntax");
  const auto& name = first.empty() ? behind : first;
  if (problem.empty()) return name;
  if (!name.empty() && name != of_files)
    refuse("clackers", "--problem", problem, fmt::format("the case {}, or none", of_files),
           fmt::format("The file is a problem of its own; leave {} out.", name), "bad-syntax");
  return of_files;
}

std::vector<std::string> parts_of(std::string_view option, std::string_view text) {
  std::vector<std::string> parts;
  for (bool more = true; more;) {
    const auto comma = text.find(',');
    more = comma != std::string_view::npos;
    parts.emplace_back(text.substr(0, comma));
    if (parts.back().empty())
      refuse("clackers", option, "an empty part", "values behind commas", {}, "bad-syntax");
    if (more) text.remove_prefix(comma + 1);
  }
  return parts;
}

void add_label_option(Command& command, std::vector<std::string>& labels) {
  command
      .add_option("--label", labels,
                  "What to keep beside the name in table, record and report, such as "
                  "precision=single. May be repeated.")
      ->option_text("KEY=VALUE");
}

record::Labels read_labels(const std::vector<std::string>& options) {
  record::Labels labels;
  for (const auto& text : options) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 ||
        !labels.try_emplace(text.substr(0, equals), text.substr(equals + 1)).second)
      refuse("clackers", "--label", fmt::format("\"{}\"", text), "key=value, every key once", {},
             "bad-syntax");
  }
  return labels;
}

cases::Settings read_settings(const std::vector<std::string>& options, const std::string& problem) {
  cases::Settings settings;
  for (std::string_view rest : options) {
    for (bool more = true; more;) {
      const auto comma = rest.find(',');
      more = comma != std::string_view::npos;
      const auto part = rest.substr(0, comma);
      if (more) rest.remove_prefix(comma + 1);
      const auto equals = part.find('=');
      if (equals == std::string_view::npos || equals == 0)
        refuse("clackers", "--set", fmt::format("\"{}\"", part),
               "name=value, more of them behind commas",
               "Numbers take a decimal point; a comma separates settings.", "bad-syntax");
      const auto name = part.substr(0, equals);
      if (std::ranges::find(settings, name, &cases::Settings::value_type::first) != settings.end())
        refuse("clackers", "--set", fmt::format("\"{}\"", part), "every name once",
               fmt::format("{} was set before.", name), "bad-syntax");
      const auto value = part.substr(equals + 1);
      if (is_word(value))
        settings.emplace_back(name, std::string(value));
      else
        settings.emplace_back(name, read_number(name, value));
    }
  }
  if (!problem.empty()) settings.emplace_back("problem", problem);
  return settings;
}

}  // namespace clackers::cli
