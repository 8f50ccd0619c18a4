#include "clackers/report/case_studies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "clackers/report/counters.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/layout.hpp"
#include "clackers/report/verdict_table.hpp"

namespace clackers::report {
namespace {

void print_wrapped(std::string_view text, std::ostream& out, const Style& style) {
  for (const auto& line : wrap(text, std::size_t(std::max(style.width, 20)))) out << line << '\n';
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

std::vector<TextCell> cells_of(const assess::MethodProfile& method) {
  study::MethodResult named;
  named.name = method.method;
  const auto tasks = int(method.ratios.size());
  return {{typed_name(named), Paint::bold},
          {fmt::format("{}", method.best)},
          {percent(assess::share_within(method, 2.0))},
          {percent(assess::share_within(method, 10.0))},
          {fmt::format("{}/{}", tasks - method.failed, tasks)},
          {fmt::format("{}", method.failed)}};
}

void print_profile(const study::Profile& profile, std::ostream& out, const Style& style) {
  std::vector<TextColumn> layout{{"method", false},       {"cheap-\nest", true},
                                 {"within\n2 x", true},   {"within\n10 x", true},
                                 {"tasks\nsolved", true}, {"not\nsolved", true}};
  std::vector<std::vector<TextCell>> rows;
  for (const auto& method : profile.methods) rows.push_back(cells_of(method));
  for (std::size_t c = 0; c < layout.size(); ++c) {
    layout[c].natural = layout[c].least = 6;
    for (const auto& row : rows)
      layout[c].natural = std::max(layout[c].natural, display_width(row[c].text));
    if (c > 0) layout[c].least = layout[c].natural;
  }
  const auto width = std::size_t(std::max(style.width, 1));
  if (!fit(layout, 2, width)) {
    for (auto& column : layout) column.least = 3;
    fit(layout, 2, width);
  }
  print_header(layout, 2, out, style);
  for (const auto& row : rows) print_row(layout, row, 2, out, style);
}

void print_profiles(const study::CaseStudies& studies, std::ostream& out, const Style& style) {
  const auto counters = counters_of(studies.profiles);
  if (counters.empty()) {
    print_wrapped(
        "No performance profile: a study was interrupted, or no method reaches an error of "
        "0.1 on any case.",
        out, style);
    return;
  }
  const auto shown = first_shown(counters);
  const auto& profile = *std::ranges::find(studies.profiles, shown.field, &study::Profile::counter);
  print_wrapped(
      fmt::format("Performance profile over {} cases and {} tasks, by {}. A task is an "
                  "error in u to reach on a case: 0.1, 0.01, ... down to the smallest that "
                  "some method reaches.",
                  studies.records.size(), profile.tasks.size(), shown.title),
      out, style);
  out << '\n';
  print_profile(profile, out, style);
  out << '\n';
  print_wrapped(
      "Shares of all tasks, solved at no more than so many times the least cost; what was "
      "refused or failed stays in them.",
      out, style);
}

// The word of the record that gives the exit code.
std::string overall(const study::CaseStudies& studies) {
  const int code = study::exit_code(studies);
  const auto decisive = std::ranges::find_if(
      studies.records, [&](const auto& record) { return study::exit_code(record) == code; });
  return decisive == studies.records.end() ? "not claimed" : closing(*decisive).word;
}

}  // namespace

void write(const study::CaseStudies& studies, Format format, std::ostream& out,
           const Style& style) {
  if (format == Format::json) {
    out << study::to_json(studies) << '\n';
    return;
  }
  if (format != Format::table)
    throw std::logic_error("several cases have no such format; takes_several_cases says which");
  for (const auto& record : studies.records) {
    write_verdict_table(record, out, style);
    out << '\n';
  }
  print_profiles(studies, out, style);
  out << '\n'
      << fmt::format("Verdict over {} cases: {}.\n", studies.records.size(), overall(studies));
}

}  // namespace clackers::report
