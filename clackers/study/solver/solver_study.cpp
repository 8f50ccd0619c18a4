#include "clackers/study/solver/solver_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/judge/convergence/step_ladder.hpp"
#include "clackers/solvers/work_folder.hpp"

namespace clackers::study {
namespace {

using Clock = std::chrono::steady_clock;

// The number of steps that reach the end; only rounding parts some ends from a whole number.
long long steps_to(double end, double step) {
  return static_cast<long long>(std::ceil(end / step * (1.0 - 1e-12)));
}

// Failures in a row after which smaller steps are not tried.
constexpr int most_repeated = 3;

}  // namespace

SolverStudy::SolverStudy(const SolverSubject& asked, cases::Case problem,
                         record::CaseSummary summary, const record::RefinementPlan& plan,
                         const std::atomic<bool>* interrupt)
    : asked_(asked),
      solver_(asked.prepare(problem)),
      histories_(std::move(problem), std::move(summary), {}, interrupt),
      first_(plan),
      plan_(plan),
      interrupt_(interrupt) {
  subject_.kind = asked.kind;
  subject_.name = asked.name;
  subject_.claim = asked.claim;
}

std::vector<SolverRun> SolverStudy::missing(const record::RefinementPlan& plan) const {
  const auto& problem = histories_.summary();
  std::vector<SolverRun> runs;
  for (const double step : asked_.steps) runs.push_back({step, steps_to(problem.end, step), 0.0});
  if (!runs.empty()) return runs;
  const auto levels = judge::step_ladder({plan.coarsest, plan.levels, plan.samples_per_level},
                                         problem.end, problem.impact_times);
  for (const double tolerance : asked_.tolerances)
    runs.push_back({levels[0].steps[0], levels[0].counts[0], tolerance});
  if (!runs.empty()) return runs;
  for (const auto& level : levels)
    for (std::size_t i = 0; i < level.counts.size(); ++i)
      if (!made_.contains(level.counts[i])) runs.push_back({level.steps[i], level.counts[i], 0.0});
  return runs;
}

double SolverStudy::resolution(const SolverRun& run) const {
  return by_tolerance() ? run.tolerance : run.step;
}

bool SolverStudy::skipped(const SolverRun& run) {
  const std::lock_guard lock(guard_);
  if (repeated_ < most_repeated) return false;
  add_failed(run, last_repeated_.failure_code,
             fmt::format("not made after {} runs in a row: {}", repeated_, last_repeated_.failure),
             last_repeated_.printed);
  return true;
}

void SolverStudy::add_failed(const SolverRun& run, std::string code, std::string sentence,
                             std::string printed) {
  histories_.add_failed(resolution(run), std::move(code), std::move(sentence), std::move(printed));
}

void SolverStudy::make(const SolverRun& run) {
  if (skipped(run)) return;
  const auto start = Clock::now();
  bool interrupted = interrupt_ != nullptr && *interrupt_;
  if (!interrupted) {
    const auto output = solver_->run(run, interrupt_);
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

void SolverStudy::take(const SolverRun& run, const SolverOutput& output) {
  {
    const std::lock_guard lock(guard_);
    repeated_ = output.would_repeat ? repeated_ + 1 : 0;
    if (output.would_repeat) last_repeated_ = output;
  }
  if (!output.history) return add_failed(run, output.failure_code, output.failure, output.printed);
  HistoryTask task;
  task.file = *output.history;
  if (output.events) task.events = *output.events;
  task.step = resolution(run);
  task.step_is_tolerance = by_tolerance();
  try {
    histories_.read(task);
  } catch (const InputError& error) {
    const std::filesystem::path file = input::path_of(*output.history);
    add_failed(
        run, std::string(error.code().name()),
        file.empty() ? error.what() : solvers::without_folder(error.what(), file.parent_path()),
        output.printed);
  } catch (const FileError& error) {
    add_failed(run, std::string(error.code().name()), error.what(), output.printed);
  }
}

double SolverStudy::expected_seconds(const std::vector<SolverRun>& runs) const {
  double steps = 0.0;
  for (const auto& run : runs) steps += double(run.steps);
  return longest_ > 0 ? steps * longest_seconds_ / double(longest_) : 0.0;
}

void SolverStudy::assess(const record::RefinementPlan& plan) {
  plan_ = plan;
  const bool any = !made_.empty();
  if (any)
    subject_ = histories_.assess(subject_.kind, subject_.name, subject_.claim, {}, by_tolerance());
  else
    subject_.assessment.reason = subject_.assessment.displacement.reason =
        Code("interrupted").name();
  subject_.complete = !is_interrupted_;
}

NextPlan SolverStudy::next() const {
  if (by_tolerance() || !asked_.steps.empty() || repeated_ >= most_repeated) return {};
  auto open = subject_;
  if (open.assessment.displacement.behaviour == Behaviour::undecided)
    open.assessment.verdict = Verdict::undecided;
  return next_plan(open, plan_, histories_.summary());
}

void SolverStudy::close(record::RefinementEnd end, double next_seconds) {
  subject_.refinement = refinement_of(first_, plan_, end, next_seconds);
}

}  // namespace clackers::study
