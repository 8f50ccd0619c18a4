#include "clackers/study/solver_candidate.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/record/notes.hpp"
#include "clackers/solvers/work_folder.hpp"
#include "clackers/study/check/history/history_run.hpp"

namespace clackers::study {
namespace {

// A start costs a solver about as much as this many steps.
constexpr double start_steps = 5000.0;

Measured failed(double resolution, std::string code, std::string sentence, std::string printed) {
  Measured measured;
  measured.run.score.step = resolution;
  measured.run.score.failure_code = std::move(code);
  measured.run.score.failure = std::move(sentence);
  measured.run.printed = std::move(printed);
  return measured;
}

}  // namespace

SolverCandidate::SolverCandidate(const solvers::SolverSubject& asked, const StudyCase& problem)
    : asked_(asked), problem_(problem), solver_(asked.prepare(problem.problem)) {}

CandidateFacts SolverCandidate::facts() const {
  CandidateFacts facts;
  facts.subject.kind = asked_.kind;
  facts.subject.name = asked_.name;
  facts.subject.labels = asked_.labels;
  facts.subject.claim = asked_.claim;
  const bool by_tolerance = !asked_.tolerances.empty();
  if (by_tolerance) facts.subject.refined_by = record::RefinementParameter::tolerance;
  facts.levels = by_tolerance ? asked_.tolerances : asked_.steps;
  // Callables are called in one thread.
  facts.is_serial = asked_.kind == record::SubjectKind::callable;
  return facts;
}

void SolverCandidate::expect(std::span<const RunTask> tasks) {
  std::vector<solvers::SolverRun> runs;
  for (const auto& task : tasks) runs.push_back(task.run);
  solver_->expect(std::move(runs));
}

double SolverCandidate::cost(const RunTask& task) const {
  return start_steps + double(task.run.steps);
}

std::optional<Measured> SolverCandidate::run(const RunTask& task, TaskShare&,
                                             const std::atomic<bool>* interrupt) {
  if (interrupt != nullptr && *interrupt) return {};
  const auto start = std::chrono::steady_clock::now();
  const auto output = solver_->run(task.run, interrupt);
  if (output.interrupted) return {};
  try {
    auto measured = compared(task, output, interrupt);
    measured.would_repeat = output.would_repeat;
    if (!output.reused)
      measured.seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return measured;
  } catch (const Error& error) {
    if (error.code() != Code("interrupted")) throw;
    return {};
  }
}

Measured SolverCandidate::compared(const RunTask& task, const solvers::SolverOutput& output,
                                   const std::atomic<bool>* interrupt) const {
  const double resolution = task.resolution();
  if (!output.history)
    return failed(resolution, output.failure_code, output.failure, output.printed);
  HistoryTask history;
  history.file = *output.history;
  if (output.events) history.events = *output.events;
  history.step = resolution;
  history.step_is_tolerance = task.run.tolerance > 0.0;
  try {
    auto found = history_run(history, {}, problem_.problem, problem_.summary, {}, interrupt);
    Measured measured;
    measured.run = std::move(found.run);
    if (output.reused) measured.run.file->notes.push_back(record::note("reused"));
    if (auto& seconds = measured.run.score.seconds; !(seconds > 0.0)) seconds = output.seconds;
    measured.observation = std::move(found.observation);
    return measured;
  } catch (const InputError& error) {
    const std::filesystem::path file = input::path_of(*output.history);
    return failed(
        resolution, std::string(error.code().name()),
        (file.empty() ? error.what() : solvers::without_folder(error.what(), file.parent_path())) +
            (output.reused ? " An earlier call has made it; --fresh repeats it." : ""),
        output.printed);
  } catch (const FileError& error) {
    return failed(resolution, std::string(error.code().name()), error.what(), output.printed);
  }
}

}  // namespace clackers::study
