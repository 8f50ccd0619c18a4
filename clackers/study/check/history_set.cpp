#include "clackers/study/check/history_set.hpp"

#include <algorithm>
#include <functional>

#include "clackers/base/error.hpp"
#include "clackers/diagnose/diagnose.hpp"
#include "clackers/diagnose/limit.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/judge/convergence/step_levels.hpp"
#include "clackers/record/notes.hpp"

namespace clackers::study {
namespace {

void require_levels(const std::vector<record::Run>& runs) {
  if (runs.size() < 2 || runs.front().score.step > 1.001 * runs.back().score.step) return;
  refuse("check", "step of every history", runs.front().score.step,
         "different steps, since several histories are levels of one method",
         "Name the steps with --steps h1,h2,... in the order of the files.");
}

std::vector<record::Level> levels_of(const std::vector<record::Run>& runs) {
  std::vector<double> steps;
  for (const auto& run : runs) steps.push_back(run.score.step);
  std::vector<record::Level> levels;
  for (const auto& indices : judge::levels_of_steps(steps)) {
    auto& level = levels.emplace_back(record::Level{steps[indices.front()], {}});
    for (const auto i : indices) level.runs.push_back(runs[i]);
  }
  return levels;
}

// Of the finest history; nothing where no run came to its end.
const record::HistoryFile* finest(const std::vector<record::Run>& runs) {
  const record::HistoryFile* file = nullptr;
  for (const auto& run : runs)
    if (run.score.finished && run.file) file = &*run.file;
  return file;
}

judge::Facts facts_of(const record::HistoryFile* file, const record::Subject& subject,
                      const cases::Case& problem) {
  judge::Facts facts;
  facts.tolerance = subject.tolerance;
  facts.by_tolerance = subject.resolution == record::Resolution::tolerance;
  if (file == nullptr) return facts;
  const auto& motion = *problem.motion;
  facts.contact_time = file->contact_time;
  facts.finest = judge::HistoryFacts{.rows = file->rows,
                                     .printed_floor = file->printed_floor,
                                     .first = file->first,
                                     .start_error = file->start_error,
                                     .rows_resolve_collisions = file->rows_resolve_collisions,
                                     .last = file->last,
                                     .end = motion.end(),
                                     .expected_to_last = motion.impact_count(file->last),
                                     .expected = motion.impact_count(motion.end())};
  return facts;
}

std::optional<measure::SharedImpacts> shared_impacts(const record::Subject& subject,
                                                     const cases::Case& problem) {
  const auto* run = subject.shown_run();
  if (run == nullptr) return {};
  const auto instant = measure::first_shared_instant(*problem.motion, problem.problem);
  if (!instant) return {};
  return measure::at_shared_instant(*instant, problem.problem.start.t, run->error_history.t,
                                    run->error_history.y);
}

bool is_about_name(const record::Note& note) {
  return note.code == "step-in-name-ignored" || note.code == "rows-closer-than-step";
}

}  // namespace

HistorySet::HistorySet(cases::Case problem, record::CaseSummary summary,
                       std::vector<std::string> columns, const std::atomic<bool>* interrupt)
    : problem_(std::move(problem)),
      summary_(std::move(summary)),
      columns_(std::move(columns)),
      interrupt_(interrupt) {}

void HistorySet::read(const HistoryTask& task, const Progress& progress) {
  auto found = history_run(task, columns_, problem_, summary_, progress, interrupt_);
  add({.run = std::move(found.run),
       .named = named_resolution(input::name_of(task.file)),
       .step_is_given = task.step > 0.0},
      std::move(found.observation));
}

void HistorySet::add_failed(double step, std::string code, std::string sentence,
                            std::string printed) {
  record::Run run;
  run.score.step = step;
  run.score.failure_code = std::move(code);
  run.score.failure = std::move(sentence);
  run.printed = std::move(printed);
  add({.run = std::move(run), .named = {}, .step_is_given = true}, {});
}

void HistorySet::add(Entry entry, std::optional<diagnose::Observation> observation) {
  const std::lock_guard lock(guard_);
  if (observation) {
    entry.observation = observations_.size();
    observations_.push_back(std::move(*observation));
  }
  entries_.push_back(std::move(entry));
}

// Steps or tolerances of all runs; those that were given count before names and rows.
void HistorySet::choose_steps(record::Resolution& resolution) {
  std::vector<NamedHistory> set;
  for (const auto& entry : entries_)
    if (!entry.step_is_given) set.push_back({entry.named, entry.run.file->spacing});
  const auto names = named_steps(set, summary_.fast_period, problem_.motion->end());
  if (names.by_tolerance && set.size() == entries_.size())
    resolution = record::Resolution::tolerance;
  std::size_t next = 0;
  for (auto& entry : entries_) {
    if (entry.step_is_given) continue;
    const auto& step = names.steps[next++];
    auto& file = *entry.run.file;
    std::erase_if(file.notes, is_about_name);
    const double spacing = file.spacing, named = entry.named.step.value_or(spacing);
    file.step_source = step ? record::StepSource::name : record::StepSource::data;
    entry.run.score.step = step.value_or(spacing);
    if (!step && named > spacing)
      file.notes.push_back(record::note("step-in-name-ignored", {named, spacing}));
    if (step && resolution == record::Resolution::step && *step > 1.01 * spacing)
      file.notes.push_back(record::note("rows-closer-than-step", {*step, spacing}));
  }
}

record::Subject HistorySet::assess(record::SubjectKind kind, std::string name, const Claim& claim,
                                   std::optional<double> tolerance, bool by_tolerance) {
  record::Subject subject;
  subject.kind = kind;
  subject.name = std::move(name);
  subject.claim = claim;
  subject.tolerance = tolerance;
  subject.resolution = by_tolerance ? record::Resolution::tolerance : record::Resolution::step;
  choose_steps(subject.resolution);
  std::ranges::stable_sort(entries_, std::greater{},
                           [](const Entry& entry) { return entry.run.score.step; });
  std::vector<record::Run> runs;
  std::vector<diagnose::Observation> histories;
  for (const auto& entry : entries_) {
    runs.push_back(entry.run);
    if (!entry.observation) continue;
    histories.push_back(observations_[*entry.observation]);
    histories.back().facts.step = entry.run.score.step;
  }
  const auto* file = finest(runs);
  if (!is_solver(kind) && file == nullptr && !runs.empty())
    throw InputError(runs.back().score.failure, "not-finite");
  require_levels(runs);
  subject.contact_time = file != nullptr ? file->contact_time : 0.0;
  subject.levels = levels_of(runs);
  const auto ladder = ladder_of(subject);
  auto facts = facts_of(file, subject, problem_);
  const auto limit = diagnose::limit_of(histories, problem_.problem, *problem_.motion);
  facts.wrong_limit = limit.wrong;
  facts.shared = shared_impacts(subject, problem_);
  const auto diagnosed = [&] {
    subject.assessment = judge::judge(ladder, claim, facts);
    return diagnose::diagnose(
        {.problem = problem_.problem,
         .motion = *problem_.motion,
         .histories = histories,
         .ladder = ladder,
         .displacement = subject.assessment.displacement,
         .velocity = subject.assessment.velocity,
         .limit = limit,
         .by_tolerance = subject.resolution == record::Resolution::tolerance});
  };
  subject.diagnoses = diagnosed();
  // Files of another system converge to another motion, also where too few of them show it; what
  // diagnosis finds in the rows of files, their errors alone may not show.
  const auto shown = [&](auto cause) { return std::ranges::any_of(subject.diagnoses, cause); };
  const bool wrong_limit = facts.wrong_limit || shown(diagnose::is_other_system);
  if (wrong_limit == facts.wrong_limit && !shown(diagnose::is_noise)) return subject;
  facts.wrong_limit = wrong_limit;
  facts.noise = shown(diagnose::is_noise);
  subject.assessment = judge::judge(ladder, claim, facts);
  return subject;
}

}  // namespace clackers::study
