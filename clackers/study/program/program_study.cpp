#include "clackers/study/program/program_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "clackers/assess/convergence/step_ladder.hpp"
#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

using Clock = std::chrono::steady_clock;

// Failures in a row after which smaller steps are not tried.
constexpr int most_repeated = 3;

}  // namespace

ProgramStudy::ProgramStudy(ProgramRunner runner, std::string name, cases::Case problem,
                           CaseSummary summary, const RefinementPlan& plan,
                           std::vector<double> tolerances, const Claim& claim,
                           const std::atomic<bool>* interrupt)
    : runner_(std::move(runner)),
      histories_(std::move(problem), std::move(summary), {}, interrupt),
      asked_(plan),
      plan_(plan),
      tolerances_(std::move(tolerances)),
      interrupt_(interrupt) {
  subject_.kind = SubjectKind::program;
  subject_.name = std::move(name);
  subject_.claim = claim;
}

std::vector<ProgramRun> ProgramStudy::missing(const RefinementPlan& plan) const {
  const auto& problem = histories_.summary();
  const auto levels = assess::step_ladder({plan.coarsest, plan.levels, plan.samples_per_level},
                                          problem.end, problem.impact_times);
  std::vector<ProgramRun> runs;
  for (const double tolerance : tolerances_)
    runs.push_back({levels[0].steps[0], levels[0].counts[0], tolerance});
  if (!runs.empty()) return runs;
  for (const auto& level : levels)
    for (std::size_t i = 0; i < level.counts.size(); ++i)
      if (!made_.contains(level.counts[i])) runs.push_back({level.steps[i], level.counts[i], 0.0});
  return runs;
}

double ProgramStudy::resolution(const ProgramRun& run) const {
  return tolerances_.empty() ? run.step : run.tolerance;
}

bool ProgramStudy::skipped(const ProgramRun& run) {
  const std::lock_guard lock(guard_);
  if (repeated_ < most_repeated) return false;
  add_failed(run, last_repeated_.failure_code,
             fmt::format("not made after {} runs in a row: {}", repeated_, last_repeated_.failure),
             last_repeated_.printed);
  return true;
}

void ProgramStudy::add_failed(const ProgramRun& run, std::string code, std::string sentence,
                              std::string printed) {
  histories_.add_failed(resolution(run), std::move(code), std::move(sentence), std::move(printed));
}

void ProgramStudy::make(const ProgramRun& run) {
  if (skipped(run)) return;
  const auto start = Clock::now();
  bool interrupted = interrupt_ != nullptr && *interrupt_;
  if (!interrupted) {
    const auto output = runner_.run(run, interrupt_);
    interrupted = output.interrupted;
    if (!interrupted) try {
        take(run, output);
      } catch (const Error& error) {
        if (error.code() != Code("interrupted")) throw;
        interrupted = true;
      }
    const std::lock_guard lock(guard_);
    if (!interrupted) made_.insert(run.steps);
    if (!interrupted && !output.reused && run.steps > longest_) {
      longest_ = run.steps;
      longest_seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
    }
  }
  const std::lock_guard lock(guard_);
  is_interrupted_ = is_interrupted_ || interrupted;
}

void ProgramStudy::take(const ProgramRun& run, const ProgramOutput& output) {
  {
    const std::lock_guard lock(guard_);
    repeated_ = output.would_repeat ? repeated_ + 1 : 0;
    if (output.would_repeat) last_repeated_ = output;
  }
  if (output.history.empty())
    return add_failed(run, output.failure_code, output.failure, output.printed);
  HistoryTask task;
  task.file = output.history.string();
  task.events = output.events.string();
  task.step = resolution(run);
  task.step_is_tolerance = !tolerances_.empty();
  try {
    histories_.read(task);
  } catch (const InputError& error) {
    add_failed(run, std::string(error.code().name()),
               without_folder(error.what(), output.history.parent_path()), output.printed);
  } catch (const FileError& error) {
    add_failed(run, std::string(error.code().name()), error.what(), output.printed);
  }
}

double ProgramStudy::expected_seconds(const std::vector<ProgramRun>& runs) const {
  double steps = 0.0;
  for (const auto& run : runs) steps += double(run.steps);
  return longest_ > 0 ? steps * longest_seconds_ / double(longest_) : 0.0;
}

void ProgramStudy::assess(const RefinementPlan& plan) {
  plan_ = plan;
  const bool any = !made_.empty();
  if (any)
    subject_ = histories_.assess(SubjectKind::program, subject_.name, subject_.claim, {},
                                 !tolerances_.empty());
  else
    subject_.assessment.reason = subject_.assessment.displacement.reason =
        Code("interrupted").name();
  subject_.complete = !is_interrupted_;
}

NextPlan ProgramStudy::next() const {
  if (!tolerances_.empty() || repeated_ >= most_repeated) return {};
  auto open = subject_;
  if (open.assessment.displacement.behaviour == Behaviour::undecided)
    open.assessment.verdict = Verdict::undecided;
  return next_plan(open, plan_, histories_.summary());
}

void ProgramStudy::close(RefinementEnd end, double next_seconds) {
  is_closed_ = true;
  subject_.refinement = refinement_of(asked_, plan_, end, next_seconds);
}

}  // namespace clackers::study
