#include "clackers/report/runs.hpp"

#include <string>

namespace clackers::report {
namespace {

using study::Cell;

std::string yes_or_no(bool yes) { return yes ? "yes" : "no"; }

template <class Whole>
Cell whole(Whole value) {
  return static_cast<long long>(value);
}

const std::vector<study::Column>& columns() {
  static const std::vector<study::Column> table{
      {"method", "", "as typed"},
      {"complete", "", "no: interrupted before the method's last level"},
      {"behaviour", "", "of the method"},
      {"verdict", "", "on the method"},
      {"refusal_code", "", "why the method cannot take the case"},
      {"level", "", "1 is the coarsest"},
      {"step", "s", "h"},
      {"steps_per_fast_period", "", "shortest damped period of the free masses / h"},
      {"u_error", "", "largest |error in u| / initial envelope over masses and own times"},
      {"u_error_absolute", "m", "the same, not divided"},
      {"v_error", "", "L1 over time / length / initial envelope, largest over masses"},
      {"energy_error", "", "largest |E - E true| / E true at t = 0"},
      {"energy_ratio", "", "E / E true at the last state"},
      {"rounding_floor", "", "of u_error, estimated"},
      {"collisions_expected", "", "of the true motion"},
      {"collisions_found", "", "reported by the run"},
      {"collisions_matched", "", "nearest within a quarter of the time between neighbours"},
      {"collisions_missed", "", "true ones that match none"},
      {"collisions_extra", "", "reported ones that match none"},
      {"collision_time_error", "s", "largest over the matched ones"},
      {"steps", "", "counted"},
      {"force_evaluations", "", "counted"},
      {"factorizations", "", "counted"},
      {"newton_iterations", "", "counted"},
      {"event_searches", "", "impacts located inside a step"},
      {"seconds", "s", "processor time"},
      {"finished", "", "the run reached its end"},
      {"failure_code", "", "of a run that did not"},
      {"failure", "", "in a sentence"}};
  return table;
}

std::vector<Cell> method_cells(const study::MethodResult& method) {
  const bool judged = method.refusal.empty();
  std::vector<Cell> row{method.name, yes_or_no(method.complete)};
  row.push_back(judged ? Cell(std::string(to_string(method.assessment.displacement.behaviour)))
                       : Cell());
  row.push_back(judged ? Cell(std::string(to_string(method.assessment.verdict))) : Cell());
  row.push_back(judged ? Cell() : Cell(method.refusal_code));
  return row;
}

void add_run(std::vector<Cell>& row, const assess::RunScore& run, double fast_period) {
  row.insert(row.end(), {run.step, fast_period / run.step});
  // What a run that broke off would have had as errors is not known.
  if (run.finished)
    row.insert(row.end(), {run.u_error, run.u_error_absolute, run.v_error, run.energy_error,
                           run.energy_ratio, run.rounding_floor});
  else
    row.insert(row.end(), 6, Cell());
  if (const auto& score = run.impacts; score && run.finished)
    row.insert(row.end(),
               {score->expected, score->found, score->matched, score->missed, score->extra,
                score->matched > 0 ? Cell(score->worst_time_error) : Cell()});
  else
    row.insert(row.end(), 6, Cell());
  const auto& work = run.work;
  row.insert(row.end(), {whole(work.steps), whole(work.force_evaluations),
                         whole(work.factorizations), whole(work.newton_iterations),
                         whole(work.event_searches), run.seconds, yes_or_no(run.finished)});
  row.push_back(run.failure_code.empty() ? Cell() : Cell(run.failure_code));
  row.push_back(run.failure.empty() ? Cell() : Cell(run.failure));
}

}  // namespace

study::Sheet runs(const study::Record& record) {
  study::Sheet sheet{"clackers/runs/1", "Every run", columns(), {}};
  for (const auto& method : record.methods) {
    const auto before = sheet.rows.size();
    for (std::size_t level = 0; level < method.ladder.size(); ++level)
      for (const auto& run : method.ladder[level].runs) {
        auto row = method_cells(method);
        row.push_back(whole(level + 1));
        add_run(row, run, record.problem.fast_period);
        sheet.rows.push_back(std::move(row));
      }
    if (sheet.rows.size() == before) {
      auto row = method_cells(method);
      row.resize(sheet.columns.size() - 1);
      row.push_back(method.refusal.empty() ? Cell() : Cell(method.refusal));
      sheet.rows.push_back(std::move(row));
    }
  }
  return sheet;
}

}  // namespace clackers::report
