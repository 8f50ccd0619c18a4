#include <algorithm>
#include <cmath>

#include "clackers/judge/convergence/fit/error_ladder.hpp"
#include "clackers/record/notes.hpp"
#include "clackers/study/check/history/history_run.hpp"

namespace clackers::study {
namespace {

void add_digits(record::HistoryFile& file, const measure::RunScore& score) {
  if (!(file.printed_floor > 0.0)) return;
  // Fifteen digits err less than the arithmetic of a run of any length.
  const double rounding = 1e-15 * double(file.rows);
  if (file.printed_floor <= std::min(rounding, 1e-12)) return;
  const auto column = std::ranges::find(file.columns, file.printed_by, &PrintedColumn::name);
  file.notes.push_back(
      record::note("printed-digits",
                   {double(column->digits), double(column->single), file.printed_floor,
                    score.u_error / file.printed_floor, judge::rounding_slack},
                   column->name));
}

void add_sampling(record::HistoryFile& file, const record::CaseSummary& problem) {
  // From 20 rows a period the bend is below 1.3 %.
  const double rows = problem.fast_period / file.spacing;
  if (rows < 20.0)
    file.notes.push_back(record::note("few-rows-a-period", {rows, file.unseen_bend}));
}

void add_impacts(record::HistoryFile& file, const measure::RunScore& score) {
  if (!score.impacts) return;
  const auto expected = double(score.impacts->expected), found = double(score.impacts->found);
  if (expected == 0.0 && found == 0.0)
    file.notes.push_back(record::note("no-impacts"));
  else if (file.impact_source != record::ImpactSource::events)
    file.notes.push_back(record::note(
        "impacts-from-history",
        {file.spacing, double(file.rows_resolve_impacts), found, expected, file.contact_time}));
  else if (found == 0.0)
    file.notes.push_back(record::note("no-impacts-reported", {expected}));
}

void add_ends(record::HistoryFile& file, const record::CaseSummary& problem) {
  if (file.first > 0.0) file.notes.push_back(record::note("starts-late", {file.first}));
  if (file.rows_beyond > 0)
    file.notes.push_back(record::note("rows-beyond-end", {double(file.rows_beyond), problem.end}));
  else if (file.last < problem.end - 1.5 * file.spacing)
    file.notes.push_back(record::note("ends-early", {file.last, problem.end}));
}

void add_start(record::HistoryFile& file) {
  const double visible = std::max(10.0 * file.printed_floor, 1e-14);
  if (file.first == 0.0 && file.start_error > visible)
    file.notes.push_back(record::note("start-differs", {file.start_error}));
}

}  // namespace

void add_notes(record::HistoryFile& file, const measure::RunScore& score,
               const record::CaseSummary& problem) {
  add_digits(file, score);
  add_sampling(file, problem);
  add_impacts(file, score);
  add_ends(file, problem);
  add_start(file);
}

}  // namespace clackers::study
