#include "clackers/study/check/history_set.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "clackers/base/error.hpp"
#include "clackers/diagnose/diagnose.hpp"
#include "clackers/study/notes.hpp"

namespace clackers::study {
namespace {

void require_levels(const std::vector<Run>& runs) {
  if (runs.size() < 2 || runs.front().score.step > 1.001 * runs.back().score.step) return;
  refuse("check", "step of every history", runs.front().score.step,
         "different steps, since several histories are levels of one method",
         "Name the steps with --steps h1,h2,... in the order of the files.");
}

// Runs with neighbouring steps, of a ratio below 1.3, within a factor 2 are one level.
std::vector<Level> levels_of(std::vector<Run> runs) {
  constexpr double next_level = 1.3;
  std::vector<Level> levels;
  double last = 0.0;
  for (auto& run : runs) {
    const double h = run.score.step;
    // Of eight samples in the ratio 2^(1/8) the ninth begins the next level.
    const bool joins =
        !levels.empty() && last / h < next_level && levels.back().step / h < std::exp2(15.0 / 16.0);
    if (!joins) levels.push_back({h, {}});
    levels.back().runs.push_back(std::move(run));
    last = h;
  }
  return levels;
}

}  // namespace

HistorySet::HistorySet(cases::Case problem, CaseSummary summary, std::vector<std::string> columns,
                       const std::atomic<bool>* interrupt)
    : problem_(std::move(problem)),
      summary_(std::move(summary)),
      columns_(std::move(columns)),
      interrupt_(interrupt) {}

void HistorySet::read(const HistoryTask& task, const Progress& progress) {
  const auto named = task.step > 0.0 ? std::nullopt : step_in_name(task.file);
  try {
    add({history_run(task, columns_, problem_, summary_, progress, interrupt_), named});
  } catch (const InputError& error) {
    const double step = task.step > 0.0 ? task.step : named.value_or(0.0);
    if (error.code() != Code("not-finite") || !(step > 0.0)) throw;
    add_failed(step, std::string(error.code().name()), error.what());
    const std::lock_guard lock(guard_);
    if (!refusal_) refusal_ = error;
  }
}

void HistorySet::add_failed(double step, std::string code, std::string sentence,
                            std::string printed) {
  Entry entry;
  auto& run = entry.history.run;
  run.score.step = step;
  run.score.failure_code = std::move(code);
  run.score.failure = std::move(sentence);
  run.printed = std::move(printed);
  add(std::move(entry));
}

void HistorySet::add(Entry entry) {
  const std::lock_guard lock(guard_);
  entries_.push_back(std::move(entry));
}

void HistorySet::choose_steps() {
  for (auto& [history, named] : entries_) {
    if (!named || !history.run.file) continue;
    auto& file = *history.run.file;
    // A number in a name that is longer than the time between rows is no step of this history.
    if (*named <= 1.01 * file.spacing) {
      history.run.score.step = *named;
      file.step_source = StepSource::name;
    } else {
      file.notes.push_back(note("step-in-name-ignored", {*named, file.spacing}));
    }
  }
  std::ranges::stable_sort(entries_, std::greater{},
                           [](const Entry& entry) { return entry.history.run.score.step; });
}

assess::Facts HistorySet::facts(const Subject& subject) const {
  if (!finest_) return {};
  const auto& file = *finest_;
  return {.contact_time = file.contact_time,
          .tolerance = subject.tolerance,
          .finest = assess::HistoryFacts{.rows = file.rows,
                                         .printed_floor = file.printed_floor,
                                         .first = file.first,
                                         .start_error = file.start_error,
                                         .rows_resolve_collisions = file.rows_resolve_collisions}};
}

std::vector<diagnose::Diagnosis> HistorySet::diagnoses(const Subject& subject) {
  const auto ladder = ladder_of(subject);
  return diagnose::diagnose({.problem = problem_.problem,
                             .motion = *problem_.motion,
                             .histories = observations_,
                             .ladder = ladder,
                             .displacement = subject.assessment.displacement,
                             .velocity = subject.assessment.velocity,
                             .differences = nullptr,
                             .by_tolerance = subject.resolution == Resolution::tolerance});
}

Subject HistorySet::assess(SubjectKind kind, std::string name, const Claim& claim,
                           std::optional<double> tolerance, bool by_tolerance) {
  choose_steps();
  std::vector<Run> runs;
  for (auto& [history, named] : entries_) {
    if (history.run.score.finished) finest_ = history.run.file;
    if (history.observation) {
      history.observation->facts.step = history.run.score.step;
      observations_.push_back(std::move(*history.observation));
    }
    runs.push_back(std::move(history.run));
  }
  entries_.clear();
  if (!finest_ && refusal_) throw *refusal_;
  require_levels(runs);
  Subject subject;
  subject.kind = kind;
  subject.name = std::move(name);
  subject.claim = claim;
  subject.tolerance = tolerance;
  subject.resolution = by_tolerance ? Resolution::tolerance : Resolution::step;
  if (finest_) subject.contact_time = finest_->contact_time;
  subject.levels = levels_of(std::move(runs));
  subject.assessment = assess::judge(ladder_of(subject), subject.claim, facts(subject));
  subject.diagnoses = diagnoses(subject);
  return subject;
}

}  // namespace clackers::study
