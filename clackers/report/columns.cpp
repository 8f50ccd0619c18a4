#include "clackers/report/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using record::Cell;

Cell number(double value) { return std::isnan(value) ? Cell() : Cell(value); }

Cell text(std::string_view value) { return value.empty() ? Cell() : Cell(std::string(value)); }

Cell yes_or_no(bool yes) { return text(yes ? "yes" : "no"); }

bool is_method(const Row& row) { return row.subject->kind == record::SubjectKind::method; }

bool is_assessed(const Row& row) {
  const auto ran = [](const record::Level& level) { return !level.runs.empty(); };
  return row.subject->refusal.empty() && std::ranges::any_of(row.subject->levels, ran);
}

// What a run that failed would have had is not known.
template <auto member>
Cell score(const Row& row) {
  return row.score.failed < row.score.runs ? number(row.score.worst.*member) : Cell();
}

const measure::ImpactScore* impacts_of(const Row& row) {
  const bool finished = row.score.failed < row.score.runs;
  return finished && row.score.worst.impacts ? &*row.score.worst.impacts : nullptr;
}

template <auto member>
Cell impacts(const Row& row) {
  const auto* found = impacts_of(row);
  return found == nullptr ? Cell() : Cell(found->*member);
}

// Work is counted in runs of methods; a history may state it.
template <auto member>
Cell work(const Row& row) {
  const long long count = row.score.worst.work.*member;
  return row.score.runs > 0 && (is_method(row) || count > 0) ? Cell(count) : Cell();
}

const record::HistoryFile* file_of(const Row& row) {
  return row.run != nullptr && row.run->file ? &*row.run->file : nullptr;
}

template <auto member>
Cell file(const Row& row) {
  const auto* found = file_of(row);
  if (found == nullptr) return {};
  if constexpr (std::is_same_v<decltype(found->*member), const double&>)
    return number(found->*member);
  else
    return Cell(found->*member);
}

template <auto member>
Cell line(const Row& row) {
  const auto& fit = row.subject->assessment.displacement;
  return is_assessed(row) && fit.has_line ? number(fit.*member) : Cell();
}

Cell count(auto value) { return value > 0 ? Cell(static_cast<long long>(value)) : Cell(); }

template <record::RefinementParameter parameter>
Cell resolution(const Row& row) {
  const bool has = row.score.runs > 0 && row.subject->refined_by == parameter;
  return has ? number(row.score.step) : Cell();
}

bool is_by_step(const record::Subject& subject) {
  return subject.refined_by == record::RefinementParameter::step;
}

bool is_history(const record::Subject& subject) {
  return subject.kind == record::SubjectKind::histories;
}

Cell steps_per_fast_period(const Row& row) {
  if (!is_by_step(*row.subject)) return {};
  const double step = row.score.runs > 0 ? row.score.step : std::nan("");
  return number(row.problem->problem.fast_period / step);
}

Cell impact_time_error(const Row& row) {
  const auto* found = impacts_of(row);
  return found != nullptr && found->matched > 0 ? number(found->worst_time_error) : Cell();
}

Cell matched_of_expected(const Row& row) {
  const auto* found = impacts_of(row);
  return found == nullptr ? Cell() : text(fmt::format("{}/{}", found->matched, found->expected));
}

Cell seconds(const Row& row) {
  const bool is_known = is_method(row) || row.score.worst.seconds > 0.0;
  return is_known && row.score.runs > 0 ? number(row.score.worst.seconds) : Cell();
}

Cell reused(const Row& row) {
  const auto* found = row.subject->kind == record::SubjectKind::program ? file_of(row) : nullptr;
  return found == nullptr ? Cell()
                          : yes_or_no(std::ranges::count(found->notes, "reused", &Note::code) > 0);
}

Cell digits(const Row& row) {
  const auto* found = file_of(row);
  if (found == nullptr) return {};
  int most = 0;
  bool single = false;
  for (const auto& printed : found->columns)
    if (printed.name.starts_with('u')) {
      most = std::max(most, printed.digits);
      single = single || printed.single;
    }
  return text(single ? "single" : fmt::format("{}", most));
}

Cell short_file(const Row& row) {
  const auto* found = file_of(row);
  return found == nullptr ? Cell() : text(short_path(found->file));
}

Cell diagnosis_codes(const Row& row) {
  std::string codes;
  for (const auto& cause : row.subject->diagnoses) codes += (codes.empty() ? "" : " ") + cause.code;
  return text(codes);
}

using Score = measure::RunScore;
using Impacts = measure::ImpactScore;
using Work = model::Work;
using File = record::HistoryFile;
using Fit = judge::LadderFit;
constexpr auto name = Kind::name;
constexpr auto word = Kind::word;
constexpr auto error = Kind::error;

// clang-format off
const Column all[] = {
    {"case", "", "case", "", "name of the case", name, true, [](const Row& row) { return text(row.problem->problem.name); }},
    {"method", "", "method", "", "as typed; \"histories\" for files that check reads without a --name", name, true, [](const Row& row) { return text(row.subject->name); }},
    {"complete", "", "complete", "", "no: interrupted before the last level", word, true, [](const Row& row) { return yes_or_no(row.subject->complete); }},
    {"claim", "", "claimed", "", "behaviour, order and reason that the method claims, or --expect", word, true, [](const Row& row) { return text(claim_text(row.subject->claim)); }},
    {"claim_behaviour", "", "claimed", "", "behaviour that is claimed; empty where nothing is", word, true, [](const Row& row) { return row.subject->claim.behaviour != Behaviour::undecided ? text(to_string(row.subject->claim.behaviour)) : Cell(); }},
    {"claim_order", "", "claimed", "", "order that is claimed", Kind::number, true, [](const Row& row) { return row.subject->claim.order > 0.0 ? Cell(row.subject->claim.order) : Cell(); }},
    {"claim_reason", "", "claimed", "", "reason that is claimed, a code", word, true, [](const Row& row) { return text(row.subject->claim.reason); }},
    {"integrator", "", "integrator", "", "of a method that joins integrator and treatment", name, true, [](const Row& row) { return text(row.subject->integrator); }},
    {"treatment", "", "treatment", "", "contact treatment of the same", name, true, [](const Row& row) { return text(row.subject->treatment); }},
    {"behaviour", "", "behaviour", "", "measured on all levels", word, true, [](const Row& row) { return is_assessed(row) ? text(to_string(row.subject->assessment.displacement.behaviour)) : Cell(); }},
    {"order", "", "order", "", "slope of the line of error in u against step", Kind::number, true, line<&Fit::order>},
    {"order_spread", "", "spread", "", "half width of the order's 95 % interval", Kind::number, true, line<&Fit::spread>},
    {"order_range", "", "order", "", "order and half width of its 95 % interval", Kind::number, false, [](const Row& row) { return is_assessed(row) ? text(order_text(row.subject->assessment.displacement, "")) : Cell(); }},
    {"verdict", "", "verdict", "", "agrees, disagrees, not claimed, undecided, refused or interrupted", Kind::verdict, true, [](const Row& row) { return text(verdict_word(*row.subject)); }},
    {"reason", "", "reason", "", "code of what decided behaviour or verdict", word, true, [](const Row& row) { return text(row.subject->assessment.reason); }},
    {"diagnosis", "", "diagnosis", "", "codes of the causes found, strongest first (clackers list diagnoses)", word, true, diagnosis_codes},
    {"refusal_code", "", "refusal", "", "why the method cannot take the case", word, true, [](const Row& row) { return text(row.subject->refusal_code); }},
    {"refusal", "", "refusal", "", "the same in a sentence", word, true, [](const Row& row) { return text(row.subject->refusal); }},
    {"file", "", "file", "", "history, as given", name, true, file<&File::file>},
    {"file_name", "", "file", "", "history, without its folder", name, false, short_file},
    {"level", "", "level", "", "1 is the coarsest", Kind::count, true, [](const Row& row) { return count(row.level); }},
    {"step", "s", "step", "", "h", Kind::number, true, resolution<record::RefinementParameter::step>},
    {"tolerance", "", "tolerance", "", "of an adaptive solver, which has no step", Kind::number, true, resolution<record::RefinementParameter::tolerance>},
    {"step_source", "", "step from", "", "data (median spacing), name or option", word, true, [](const Row& row) { return file_of(row) ? text(to_string(file_of(row)->step_source)) : Cell(); }},
    {"steps_per_fast_period", "", "steps per fast period", "", "shortest damped period of the free masses / h", Kind::number, true, steps_per_fast_period},
    {"runs", "", "runs", "", "of the level", Kind::count, false, [](const Row& row) { return count(row.score.runs); }},
    {"failed_runs", "", "failed runs", "", "of the level", Kind::count, false, [](const Row& row) { return count(row.score.failed); }},
    {"rows", "", "rows", "", "of the history that were assessed", Kind::count, true, file<&File::rows>},
    {"spacing", "s", "spacing", "", "median time between rows", Kind::number, true, file<&File::spacing>},
    {"first_time", "s", "first time", "", "of the rows assessed", Kind::number, true, file<&File::first>},
    {"last_time", "s", "last time", "", "of the rows assessed", Kind::number, true, file<&File::last>},
    {"digits", "", "digits", "", "most significant digits of a displacement, or single (precision)", Kind::count, true, digits},
    {"printed_floor", "", "printed floor", "", "error in u that printing alone may make", error, true, file<&File::printed_floor>},
    {"u_error", "", "error in u", "", "largest |error in u| / largest envelope over masses and own times", error, true, score<&Score::u_error>},
    {"u_error_absolute", "m", "error in u", "", "the same, not divided", error, true, score<&Score::u_error_absolute>},
    {"v_error", "", "error in v", "", "L1 over time / length / largest envelope, largest over masses", error, true, score<&Score::v_error>},
    {"energy_error", "", "energy error", "", "largest |E - E exact| / largest E exact of the run; stays of order one where restitution < 1", error, true, score<&Score::energy_error>},
    {"energy_ratio", "", "energy ratio", "", "E / E exact at the last state", Kind::number, true, score<&Score::energy_ratio>},
    {"rounding_floor", "", "rounding floor", "", "of u_error, estimated", error, true, score<&Score::rounding_floor>},
    {"impact_source", "", "impacts from", "", "events, history (found in it) or unknown", word, true, [](const Row& row) { return file_of(row) ? text(to_string(file_of(row)->impact_source)) : Cell(); }},
    {"impacts", "", "impacts", "imp.", "matched / exact", Kind::count, false, matched_of_expected},
    {"impacts_expected", "", "exact impacts", "", "of the reference solution up to the end of the run", Kind::count, true, impacts<&Impacts::expected>},
    {"impacts_found", "", "found", "", "reported by the run or by the events file, or found in the history", Kind::count, true, impacts<&Impacts::found>},
    {"impacts_matched", "", "matched", "", "in order, nearest within a quarter of the time between impacts", Kind::count, true, impacts<&Impacts::matched>},
    {"impacts_missed", "", "missed", "", "exact ones that match none", Kind::count, true, impacts<&Impacts::missed>},
    {"impacts_extra", "", "extra", "", "found ones that match none", Kind::count, true, impacts<&Impacts::extra>},
    {"impact_time_error", "s", "impact-time error", "time error", "largest over the matched ones", error, true, impact_time_error},
    {"steps", "", "steps", "", "counted", Kind::count, true, work<&Work::steps>},
    {"force_evaluations", "", "force evaluations", "force eval.", "counted", Kind::count, true, work<&Work::force_evaluations>},
    {"factorizations", "", "factorizations", "", "counted", Kind::count, true, work<&Work::factorizations>},
    {"newton_iterations", "", "Newton iterations", "", "counted", Kind::count, true, work<&Work::newton_iterations>},
    {"event_searches", "", "event searches", "", "impacts located inside a step", Kind::count, true, work<&Work::event_searches>},
    {"seconds", "s", "time", "", "processor time", Kind::error, true, seconds},
    {"finished", "", "finished", "", "the run reached its end", word, true, [](const Row& row) { return row.score.runs > 0 ? yes_or_no(row.score.failed == 0) : Cell(); }},
    {"failure_code", "", "failure", "", "of a run that did not", word, true, [](const Row& row) { return text(row.score.worst.failure_code); }},
    {"reused", "", "reused", "", "yes: an earlier call has made the run (--fresh repeats it); of programs", word, true, reused},
    {"failure", "", "failure", "", "the same in a sentence", word, true, [](const Row& row) { return text(row.score.worst.failure); }},
};
// clang-format on

// The first column that differs between the runs of a subject.
constexpr std::string_view first_of_run = "file";

std::vector<const Column*> named(std::initializer_list<std::string_view> names) {
  std::vector<const Column*> out;
  for (const auto wanted : names) out.push_back(&column(wanted));
  return out;
}

// Metrics of any run, in the order in which they are met.
std::vector<record::Column> metric_columns(std::span<const record::CaseRecord> cases) {
  std::vector<record::Column> out;
  for (const auto& problem : cases)
    for (const auto& subject : problem.subjects)
      for (const auto& level : subject.levels)
        for (const auto& run : level.runs)
          for (const auto& metric : run.metrics) {
            const auto title = "metric:" + metric.name;
            if (std::ranges::find(out, title, &record::Column::name) == out.end())
              out.push_back({title, metric.unit, "see clackers list metrics"});
          }
  return out;
}

Cell metric_of(const Row& row, std::string_view wanted) {
  if (row.run == nullptr) return {};
  const auto found = std::ranges::find(row.run->metrics, wanted.substr(wanted.find(':') + 1),
                                       &record::MetricResult::name);
  return found == row.run->metrics.end() ? Cell() : number(found->value);
}

std::vector<Row> run_rows(const record::CaseRecord& problem, const record::Subject& subject) {
  std::vector<Row> out;
  for (std::size_t level = 0; level < subject.levels.size(); ++level)
    for (const auto& run : subject.levels[level].runs)
      out.push_back(run_row(problem, subject, int(level) + 1, run));
  return out;
}

}  // namespace

Row run_row(const record::CaseRecord& problem, const record::Subject& subject, int level,
            const record::Run& run) {
  const auto& score = run.score;
  return {&problem, &subject, level, {score.step, score, 1, score.finished ? 0 : 1}, &run};
}

Row level_row(const record::CaseRecord& problem, const record::Subject& subject, int level) {
  return {&problem, &subject, level, record::worst(subject.levels[std::size_t(level - 1)]),
          nullptr};
}

Row subject_row(const record::CaseRecord& problem, const record::Subject& subject) {
  return {&problem, &subject, 0, record::worst_of_finest(subject), nullptr};
}

std::span<const Column> columns() { return all; }

const Column& column(std::string_view wanted) {
  const auto* found = std::ranges::find(all, wanted, &Column::name);
  if (found == std::end(all)) throw std::logic_error("no column " + std::string(wanted));
  return *found;
}

bool is_of_subject(const Column& asked) { return &asked < &column(first_of_run); }

Table summary_table(const record::CaseRecord& problem, record::SubjectKind kind,
                    const std::vector<std::string>& only) {
  const bool methods = kind == record::SubjectKind::method;
  const bool is_alone = problem.subjects.size() == 1;
  const bool by_step = std::ranges::all_of(problem.subjects, is_by_step);
  Table table{methods
                  ? named({"method", "u_error", "order_range", "impacts", "impact_time_error",
                           "energy_error", "force_evaluations", "behaviour", "verdict"})
                  : named({"file_name", "rows", by_step ? "step" : "tolerance", "digits", "u_error",
                           "v_error", "impacts", "impact_time_error", "impact_source"}),
              {}};
  // Nothing but the number of steps is known of the work of others.
  if (methods && std::ranges::all_of(problem.subjects, is_history))
    std::erase(table.columns, &column("force_evaluations"));
  if (!methods && !is_alone) {
    std::erase(table.columns, &column("impact_source"));
    table.columns.insert(table.columns.begin() + 1, &column("method"));
  }
  for (const auto& group : groups_of(problem, only)) {
    if (methods && group.is_headed) table.heads.push_back({table.rows.size(), group});
    for (const auto* subject : group.subjects) {
      // A program is a method of others, and so are several sets of histories.
      if (is_history(*subject) ? methods && is_alone : !methods) continue;
      if (methods)
        table.rows.push_back(subject_row(problem, *subject));
      else
        std::ranges::move(run_rows(problem, *subject), std::back_inserter(table.rows));
    }
  }
  return table;
}

Table level_table(const record::CaseRecord& problem, const record::Subject& subject) {
  Table table{named({"level", is_by_step(subject) ? "step" : "tolerance", "steps_per_fast_period",
                     "runs", "failed_runs", "u_error", "v_error", "impacts", "impact_time_error",
                     "energy_error", "force_evaluations", "seconds"}),
              {}};
  for (std::size_t level = 0; level < subject.levels.size(); ++level)
    table.rows.push_back(level_row(problem, subject, int(level) + 1));
  return table;
}

record::Sheet run_sheet(std::span<const record::CaseRecord> cases, bool with_metrics) {
  record::Sheet sheet{"clackers/runs/1", "Every run", {}, {}};
  for (const auto& shown : all)
    if (shown.in_rows)
      sheet.columns.push_back(
          {std::string(shown.name), std::string(shown.unit), std::string(shown.meaning)});
  const auto metrics = with_metrics ? metric_columns(cases) : std::vector<record::Column>{};
  sheet.columns.insert(sheet.columns.end(), metrics.begin(), metrics.end());
  for (const auto& problem : cases)
    for (const auto& subject : problem.subjects) {
      auto rows = run_rows(problem, subject);
      if (rows.empty()) rows.push_back(subject_row(problem, subject));
      for (const auto& row : rows) {
        auto& cells = sheet.rows.emplace_back();
        for (const auto& shown : all)
          if (shown.in_rows) cells.push_back(shown.get(row));
        for (const auto& metric : metrics) cells.push_back(metric_of(row, metric.name));
      }
    }
  return sheet;
}

record::Sheet impact_sheet(const record::Subject& subject) {
  record::Sheet sheet{"clackers/impacts/1",
                      "Impacts of the finest history, read from its rows",
                      {{"t", "s", "where the flight before the impact closes the gap"},
                       {"contact", "", "from 1"},
                       {"closing", "m/s", "closing speed of the gap"},
                       {"opening", "m/s", "speed with which the gap opens again"},
                       {"restitution", "", "opening over closing speed"},
                       {"±", "", "what flights between rows leave of it"},
                       {"momentum defect", "",
                        "part of the change of momentum that no impulse along the contact makes"},
                       {"late", is_by_step(subject) ? "steps" : "rows",
                        "delay of the impact; below 0 it comes too early"}},
                      {}};
  for (const auto& impact : subject.impacts)
    sheet.rows.push_back({impact.t, (long long)(impact.contact) + 1, impact.closing, impact.opening,
                          impact.restitution, impact.restitution_error, impact.momentum_defect,
                          impact.delay_steps});
  if (std::ranges::any_of(subject.impacts, [](const auto& impact) { return impact.contact > 0; }))
    sheet.title += " (contacts numbered from 1)";
  return sheet;
}

record::Sheet list_columns() {
  record::Sheet sheet{"clackers/columns/1",
                      "Columns of csv and json",
                      {{"name", "", "in the first line of csv"},
                       {"unit", "", "empty when dimensionless"},
                       {"command", "", "verify and check have the same columns"},
                       {"meaning", "", "empty cells: not measured, or not of this kind of run"}},
                      {}};
  const auto add = [&](std::string_view title, std::string_view unit, std::string_view command,
                       std::string_view meaning) {
    sheet.rows.push_back(
        {std::string(title), text(unit), std::string(command), std::string(meaning)});
  };
  for (const auto& shown : all)
    if (shown.in_rows) add(shown.name, shown.unit, "verify, check", shown.meaning);
  add("metric:NAME", "", "verify, check", "a metric (clackers list metrics) of the finest run");
  add("t", "s", "respond", "time");
  add("side", "", "respond", "- and + for the limits before and after an impact, else empty");
  add("u1", "m", "respond", "displacement of mass 1; u2, ... of the others");
  add("v1", "m/s", "respond", "velocity of mass 1; v2, ... of the others");
  add("a1", "m/s2", "respond", "acceleration of mass 1; a2, ... of the others");
  return sheet;
}

}  // namespace clackers::report
