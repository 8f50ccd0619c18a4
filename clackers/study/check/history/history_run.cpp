#include "clackers/study/check/history/history_run.hpp"

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/input/history.hpp"
#include "clackers/study/check/history/prepared_history.hpp"

namespace clackers::study {
namespace {

input::History read(const HistoryTask& task, const std::vector<std::string>& columns, int dof,
                    const Progress& progress, const std::atomic<bool>* interrupt) {
  input::HistoryOptions options{.dof = dof,
                                .columns = columns,
                                .step = task.step_is_tolerance ? 0.0 : task.step,
                                .until_not_finite = true,
                                .interrupt = interrupt,
                                .results = task.results};
  if (progress) options.progress = [&](double share) { progress(read_share * share); };
  return input::read_history(task.file, options);
}

ComparedHistory failed(PreparedHistory history, double step) {
  record::Run run;
  run.score.step = step;
  run.score.failure_code = Code("not-finite").name();
  run.score.failure = std::move(history.data.not_finite);
  run.file = std::move(history.file);
  return {std::move(run), {}};
}

}  // namespace

ComparedHistory history_run(const HistoryTask& task, const std::vector<std::string>& columns,
                            const cases::Case& problem, const record::CaseSummary& summary,
                            const Progress& progress, const std::atomic<bool>* interrupt) {
  auto history =
      prepare(task, read(task, columns, problem.motion->dof(), progress, interrupt), problem);
  const double step = task.step > 0.0 ? task.step : history.file.spacing;
  if (task.step > 0.0) history.file.step_source = record::StepSource::option;
  if (!history.data.not_finite.empty()) return failed(std::move(history), step);
  if (input::is_given(task.events)) add_events(history, task.events, problem, interrupt);
  if (!history.has_all_u) complete_u(history, problem);
  const auto cost = history.data.cost;
  auto compared = measure(std::move(history), step, problem, summary, progress, interrupt);
  auto& score = compared.run.score;
  score.seconds = cost.seconds;
  score.work.steps = std::llround(cost.steps);
  score.work.force_evaluations = std::llround(cost.evaluations);
  return compared;
}

}  // namespace clackers::study
