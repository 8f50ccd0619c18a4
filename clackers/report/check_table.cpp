#include "clackers/report/check_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "clackers/report/check_words.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/layout.hpp"

namespace clackers::report {
namespace {

using Rows = std::vector<std::vector<TextCell>>;

std::size_t width_of(const Style& style) { return std::size_t(std::max(style.width, 20)); }

void print_wrapped(std::string_view text, std::ostream& out, const Style& style) {
  for (const auto& line : wrap(text, width_of(style))) out << line << '\n';
}

Paint paint_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return Paint::green;
    case Verdict::disagrees:
      return Paint::red;
    case Verdict::undecided:
      return Paint::yellow;
    case Verdict::not_claimed:
      break;
  }
  return Paint::plain;
}

// Columns as wide as their cells; the first one, a name, is wrapped where the line is too short.
void print_table(std::vector<TextColumn> layout, const Rows& rows, std::ostream& out,
                 const Style& style) {
  for (std::size_t c = 0; c < layout.size(); ++c) {
    for (const auto& line : wrap(layout[c].header, 80))
      layout[c].natural = std::max(layout[c].natural, display_width(line));
    for (const auto& row : rows)
      layout[c].natural = std::max(layout[c].natural, display_width(row[c].text));
    layout[c].least = c == 0 ? std::min<std::size_t>(8, layout[c].natural) : layout[c].natural;
  }
  if (!fit(layout, 1, width_of(style))) {
    for (auto& column : layout) column.least = 3;
    fit(layout, 1, width_of(style));
  }
  print_header(layout, 1, out, style);
  for (const auto& row : rows) print_row(layout, row, 1, out, style);
}

std::string base_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

void print_files(const study::CheckRecord& record, std::ostream& out, const Style& style) {
  Rows rows;
  for (const auto& file : record.files) {
    const auto& found = file.score.impacts;
    rows.push_back({{base_name(file.file), Paint::bold},
                    {short_count(file.rows)},
                    {short_number(file.score.step, 3, 8)},
                    {digits_text(file)},
                    {scientific(file.score.u_error)},
                    {scientific(file.score.v_error)},
                    {found ? fmt::format("{}/{}", found->found, found->expected) : "-"},
                    {found ? fmt::format("{}", found->matched) : "-"},
                    {found && found->matched > 0 ? scientific(found->worst_time_error) : "-"}});
  }
  print_table({{"file", false},
               {"rows", true},
               {"step\n[s]", true},
               {"digits", true},
               {"error\nin u", true},
               {"error\nin v", true},
               {"coll.\nfound", true},
               {"coll.\nmatched", true},
               {"time\nerror\n[s]", true}},
              rows, out, style);
}

void print_metrics(const study::CheckedFile& file, std::ostream& out, const Style& style) {
  if (file.metrics.empty()) return;
  Rows rows;
  std::string missing;
  for (const auto& metric : file.metrics) {
    if (std::isnan(metric.value)) {
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", metric.name);
      continue;
    }
    std::string masses;
    for (const double value : metric.masses)
      masses += fmt::format("{}{}", masses.empty() ? "" : "  ", scientific(value, 2));
    const bool counted = metric.unit == "1" && metric.value == std::floor(metric.value);
    rows.push_back({{metric.name + (metric.across_jumps ? "" : " *")},
                    {counted ? short_number(metric.value) : scientific(metric.value, 2)},
                    {metric.unit},
                    {masses}});
  }
  out << '\n';
  print_table({{"metric", false}, {"value", true}, {"unit", false}, {"mass by mass", false}}, rows,
              out, style);
  if (!std::ranges::all_of(file.metrics, &study::MetricResult::across_jumps))
    print_wrapped("* need not tend to zero while impacts are a little early or late.", out, style);
  if (!missing.empty())
    print_wrapped(fmt::format("Not measured: {}; why: --format json.", missing), out, style);
}

// What a note is about: its first two words.
std::string_view subject(const std::string& note) {
  return std::string_view(note).substr(0, note.find(' ', note.find(' ') + 1));
}

// What is said of the finest history, and of others where it is about something else.
void print_notes(const study::CheckRecord& record, std::ostream& out, const Style& style) {
  std::vector<std::string_view> said;
  for (auto file = record.files.rbegin(); file != record.files.rend(); ++file)
    for (const auto& note : file->notes) {
      if (std::ranges::find(said, subject(note)) != said.end()) continue;
      if (said.empty()) out << '\n';
      said.push_back(subject(note));
      const bool finest = file == record.files.rbegin();
      print_wrapped(finest ? note : fmt::format("{}: {}", base_name(file->file), note), out, style);
    }
}

void print_fit(const study::CheckRecord& record, std::ostream& out, const Style& style) {
  if (record.files.size() < 2) return;
  const auto& fit = record.assessment.displacement;
  auto text = fmt::format("{} histories: {}", record.files.size(), to_string(fit.behaviour));
  if (const auto order = order_text(fit); !order.empty()) text += fmt::format(", order {}", order);
  if (!fit.reason.empty()) text += fmt::format(" [{}]", fit.reason);
  print_wrapped(text, out, style);
}

}  // namespace

void write_check_table(const study::CheckRecord& record, std::ostream& out, const Style& style) {
  const auto& problem = record.problem;
  print_wrapped(case_text(problem), out, style);
  print_wrapped(fmt::format("{} s with {} collisions; fast period {} s", short_number(problem.end),
                            problem.impact_count, short_number(problem.fast_period, 4)),
                out, style);
  out << '\n';
  print_files(record, out, style);
  out << '\n';
  print_wrapped("Errors relative to the initial envelope; v in the mean over time.", out, style);
  print_notes(record, out, style);
  print_metrics(record.files.back(), out, style);
  out << '\n';
  print_fit(record, out, style);
  auto sentence = record.sentence;
  if (!record.reason.empty()) sentence += fmt::format(" [{}]", record.reason);
  print_wrapped(sentence, out, style);
  auto last = fmt::format("Verdict: {}. Next: {}", to_string(record.verdict), record.next);
  if (display_width(last) > width_of(style))
    last = fmt::format("Verdict: {}. Next: clackers check --help", to_string(record.verdict));
  for (const auto& line : wrap(last, width_of(style)))
    out << painted(line, paint_of(record.verdict), style) << '\n';
}

}  // namespace clackers::report
