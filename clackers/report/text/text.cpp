#include "clackers/report/writers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <ostream>

#include "clackers/base/text.hpp"
#include "clackers/judge/cost/performance_profile.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/groups.hpp"
#include "clackers/report/text/table.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using Cells = std::vector<std::vector<TextCell>>;

TextColor color_of(std::string_view verdict) {
  if (verdict == "agrees") return TextColor::green;
  if (verdict == "disagrees") return TextColor::red;
  if (verdict == "not claimed") return TextColor::plain;
  return TextColor::yellow;
}

std::string number_text(double value, Kind kind) {
  return kind == Kind::error ? scientific(value) : short_number(value, 3, 8);
}

TextCell cell_of(const Column& shown, const Row& row) {
  const auto cell = shown.get(row);
  std::string text = "-";
  if (const auto* real = std::get_if<double>(&cell)) text = number_text(*real, shown.kind);
  if (const auto* whole = std::get_if<long long>(&cell)) text = short_count(*whole);
  if (const auto* word = std::get_if<std::string>(&cell)) text = *word;
  const auto color = shown.kind == Kind::name      ? TextColor::bold
                     : shown.kind == Kind::verdict ? color_of(text)
                                                   : TextColor::plain;
  return {std::move(text), color};
}

// Columns of which long names take the place where rows stand in groups.
constexpr auto left_out =
    std::to_array<std::string_view>({"impact_time_error", "force_evaluations"});
constexpr int width_for_all = 100;

void print(Table table, std::ostream& out, const Style& style) {
  if (!table.heads.empty() && style.width < width_for_all)
    std::erase_if(table.columns, [](const Column* shown) {
      return std::ranges::find(left_out, shown->name) != left_out.end();
    });
  std::vector<TextColumn> columns;
  for (const auto* shown : table.columns) {
    auto header = std::string(shown->brief_heading());
    if (!shown->unit.empty()) header += fmt::format("\n[{}]", shown->unit);
    columns.push_back({std::move(header), is_number(shown->kind)});
  }
  Cells rows;
  for (const auto& row : table.rows) {
    auto& cells = rows.emplace_back();
    for (const auto* shown : table.columns) cells.push_back(cell_of(*shown, row));
  }
  std::vector<TableHead> heads;
  for (std::size_t i = 0; i < table.heads.size(); ++i) {
    const auto& [row, group] = table.heads[i];
    heads.push_back({row, heading_of(group)});
    for (std::size_t k = 0; k < group.subjects.size(); ++k)
      rows[row + k].front().text = name_in(group, *group.subjects[k]);
  }
  print_table(std::move(columns), rows, out, style, heads);
}

bool is_in_reports(const record::MetricResult& metric) {
  const auto row = std::ranges::find(measure::metrics(), metric.name, &measure::Metric::name);
  return row != measure::metrics().end() && row->in_reports;
}

void print_metrics(const std::string& who, const record::Run& run, std::ostream& out,
                   const Style& style) {
  Cells rows;
  std::vector<std::string> missing;
  std::size_t hidden = 0;
  bool has_mark = false;
  for (const auto& metric : run.metrics) {
    if (!style.all_metrics && !is_in_reports(metric)) {
      ++hidden;
      continue;
    }
    has_mark = has_mark || !metric.across_jumps;
    if (std::isnan(metric.value)) {
      missing.push_back(metric.name);
      continue;
    }
    std::vector<std::string> masses;
    for (const double value : metric.masses) masses.push_back(scientific(value, 2));
    const bool is_count = metric.unit == "1" && metric.value == std::floor(metric.value);
    rows.push_back({{metric.name + (metric.across_jumps ? "" : " *")},
                    {is_count ? short_number(metric.value) : scientific(metric.value, 2)},
                    {metric.unit == "1" ? "" : metric.unit},
                    {fmt::format("{}", fmt::join(masses, "  "))}});
  }
  out << '\n';
  print_table({{who + "metric"}, {"value", true}, {"unit"}, {"mass by mass"}}, rows, out, style);
  if (has_mark)
    print_wrapped("* need not tend to zero while impacts are a little early or late.", out, style);
  if (!missing.empty())
    print_wrapped(fmt::format("Not measured: {}; why: --format json.", fmt::join(missing, ", ")),
                  out, style);
  if (hidden > 0) print_wrapped(fmt::format("{} more: --metrics all.", hidden), out, style);
}

void print_methods(const record::CaseRecord& problem, std::ostream& out, const Style& style) {
  const auto table = summary_table(problem, record::SubjectKind::method, style.only);
  if (!style.only.empty()) {
    out << '\n';
    print_wrapped(fmt::format("Only {}: {} of {}.", fmt::join(style.only, " or "),
                              table.rows.size(), counted(std::ssize(problem.subjects), "method")),
                  out, style);
  }
  if (table.rows.empty()) return;
  out << '\n';
  print(table, out, style);
  out << '\n';
  print_wrapped(fmt::format("Worst of the finest level's steps; errors {}; order ± 95 %; impacts "
                            "matched/exact.",
                            error_scale_text),
                out, style);
}

void print_failures(const record::CaseRecord& problem, std::ostream& out, const Style& style) {
  bool is_first = true;
  for (const auto& subject : problem.subjects)
    for (const auto& failure : failure_texts(subject)) {
      if (is_first) out << '\n';
      is_first = false;
      print_wrapped(subject.name + ": " + failure, out, style);
    }
}

void print_impacts(const std::string& who, const record::Subject& subject, std::ostream& out,
                   const Style& style) {
  out << '\n';
  if (subject.impacts.empty())
    return print_wrapped(
        who + "The rows show no impact: they need velocities, and several rows between impacts.",
        out, style);
  auto sheet = impact_sheet(subject);
  sheet.title = who + sheet.title;
  record::SheetRows rows(sheet);
  write_table(rows, out, style);
}

void print_histories(const record::CaseRecord& problem, std::ostream& out, const Style& style) {
  const auto table = summary_table(problem, record::SubjectKind::histories);
  if (table.rows.empty()) return;
  out << '\n';
  print(table, out, style);
  out << '\n';
  print_wrapped(
      "Errors relative to the largest envelope; v in the mean over time; impacts "
      "matched/exact.",
      out, style);
  for (const auto& subject : problem.subjects) {
    if (subject.kind != record::SubjectKind::histories) continue;
    const auto who = problem.subjects.size() > 1 ? subject.name + ": " : std::string();
    const auto notes = note_texts(subject);
    if (!notes.empty()) out << '\n';
    for (const auto& note : notes) print_wrapped(who + note, out, style);
    const auto* shown = subject.shown_run();
    if (shown != nullptr && !shown->metrics.empty()) print_metrics(who, *shown, out, style);
    if (style.impacts) print_impacts(who, subject, out, style);
  }
}

void print_named(const record::CaseRecord& problem, bool is_named, std::ostream& out,
                 const Style& style,
                 const std::function<std::vector<Finding>(const record::Subject&)>& findings) {
  const auto all = named_findings(groups_of(problem, style.only), findings);
  if (!all.empty()) out << '\n';
  for (const auto& [subject, who, found] : all)
    print_wrapped((is_named ? who + ": " : "") + text_of(found), out, style);
}

void print_findings(const record::CaseRecord& problem, const OpeningLine& opening,
                    std::ostream& out, const Style& style) {
  // The name of the only subject of `check` says nothing.
  const bool is_named = problem.plan.levels > 0 || problem.subjects.size() > 1;
  for (const auto& texts : {&finding, &false_convergence})
    if (!(opening.has_finding && texts == &finding))
      print_named(problem, is_named, out, style, [&](const record::Subject& subject) {
        const auto found = texts(subject);
        return found ? std::vector{*found} : std::vector<Finding>{};
      });
}

// Causes stand before the numbers.
void print_diagnoses(const record::CaseRecord& problem, const OpeningLine& opening,
                     std::ostream& out, const Style& style) {
  const bool is_named = problem.plan.levels > 0 || problem.subjects.size() > 1;
  print_named(problem, is_named, out, style, [&](const record::Subject& subject) {
    auto texts = diagnosis_texts(subject);
    if (opening.has_cause) texts.erase(texts.begin());
    return texts;
  });
}

void print_case(const record::CaseRecord& problem, const OpeningLine& opening, std::ostream& out,
                const Style& style) {
  print_wrapped(case_text(problem.problem), out, style);
  print_wrapped(length_text(problem.problem), out, style);
  if (const auto plan = plan_text(problem); !plan.empty()) print_wrapped(plan, out, style);
  for (const auto& subject : problem.subjects)
    if (!subject.labels.empty())
      print_wrapped(fmt::format("{}: {}.", subject.name, record::labels_text(subject.labels)), out,
                    style);
  if (const auto first = departure_text(problem); !first.empty()) {
    out << '\n';
    print_wrapped(first, out, style);
  }
  print_diagnoses(problem, opening, out, style);
  const bool is_check = problem.plan.levels == 0;
  if (is_check) print_findings(problem, opening, out, style);
  print_methods(problem, out, style);
  print_failures(problem, out, style);
  print_histories(problem, out, style);
  if (!is_check) print_findings(problem, opening, out, style);
}

// Over all cases, by force evaluations where they are counted.
void print_profile(const record::Record& record, std::ostream& out, const Style& style) {
  out << '\n';
  if (record.profiles.empty())
    return print_wrapped(
        "No performance profile: a study was interrupted, or no method reaches an error of 0.1 on "
        "any case.",
        out, style);
  const auto counted_forces =
      std::ranges::find(record.profiles, record::field_of(judge::Counter::force_evaluations),
                        &record::Profile::counter);
  const auto& profile =
      counted_forces == record.profiles.end() ? record.profiles.front() : *counted_forces;
  const auto tasks = std::ssize(profile.tasks);
  print_wrapped(
      fmt::format(
          "Performance profile over {} and {}, by {}. A task is an error in u to reach on a "
          "case: 0.1, 0.01, ... down to the smallest that some method reaches.",
          counted(std::ssize(record.cases), "case"), counted(tasks, "task"),
          column(profile.counter).heading),
      out, style);
  const auto percent = [](double share) { return fmt::format("{:.0f} %", 100.0 * share); };
  Cells rows;
  for (const auto& method : profile.methods)
    rows.push_back({{method.method, TextColor::bold},
                    {fmt::format("{}", method.best)},
                    {percent(judge::share_within(method, 2.0))},
                    {percent(judge::share_within(method, 10.0))},
                    {fmt::format("{}/{}", tasks - method.failed, tasks)}});
  out << '\n';
  print_table({{"method"},
               {"cheapest of all", true},
               {"within 2 x", true},
               {"within 10 x", true},
               {"tasks solved", true}},
              rows, out, style);
  out << '\n';
  print_wrapped(
      "Shares of all tasks, solved at no more than so many times the least cost; what was refused "
      "or failed counts as not solved.",
      out, style);
}

}  // namespace

void write_changes(const study::BaselineComparison& changes, std::ostream& out,
                   const Style& style) {
  print_wrapped(change_summary(changes), out, style);
  const auto is_of_first_case = [&](const study::SubjectChange& change) {
    return change.case_name == changes.subjects.front().case_name;
  };
  const bool one_case = std::ranges::all_of(changes.subjects, is_of_first_case);
  for (const auto& change : changes.subjects) {
    if (!change.any()) continue;
    const auto who = one_case ? change.name : change.case_name + ", " + change.name;
    for (const auto& text : change_texts(change))
      print_wrapped(fmt::format("{}: {}", who, text), out, style);
  }
}

void write_text(const record::Record& record, std::ostream& out, const Style& style,
                const study::BaselineComparison* changes) {
  if (record.interrupted)
    print_wrapped("INTERRUPTED: only what was finished is shown [interrupted]", out, style,
                  TextColor::yellow);
  const auto line = verdict_line(record);
  const auto opening = opening_line(record);
  print_wrapped(opening.text, out, style, color_of(line.word));
  const char* between = "\n";
  for (const auto& problem : record.cases) {
    out << between;
    print_case(problem, opening, out, style);
    between = "\n";
  }
  if (record.cases.size() > 1) print_profile(record, out, style);
  if (changes != nullptr) {
    out << '\n';
    write_changes(*changes, out, style);
  }
  out << '\n';
  // A command is for copying, so it is not broken; of one that is too long only the change is named.
  auto last = fmt::format("Verdict: {}. Next: {}", line.word, line.next);
  if (display_width(printable(last)) > std::size_t(std::max(style.width, 20)))
    last = fmt::format("Verdict: {}. Next: {}", line.word, line.next_in_words);
  print_wrapped(last, out, style, color_of(line.word));
}

}  // namespace clackers::report
