#include "clackers/study/record.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// NaN is a number that a run lacks.
void raise(double& most, double value) {
  if (std::isnan(most) || value > most) most = value;
}

// Energy off by a factor is as bad as by its inverse; none at all is worse than any.
double departure(double energy_ratio) { return std::abs(std::log(energy_ratio)); }

void raise(model::Work& most, const model::Work& work) {
  for (auto counter : {&model::Work::steps, &model::Work::force_evaluations,
                       &model::Work::factorizations, &model::Work::newton_iterations,
                       &model::Work::event_searches})
    most.*counter = std::max(most.*counter, work.*counter);
}

void add_impacts(std::optional<assess::ImpactScore>& worst, const assess::ImpactScore& score) {
  const auto wrong = [](const assess::ImpactScore& s) { return s.missed + s.extra; };
  const double time_error = std::max(worst ? worst->worst_time_error : 0.0, score.worst_time_error);
  const double floor = std::max(worst ? worst->rounding_floor : 0.0, score.rounding_floor);
  if (!worst || wrong(score) > wrong(*worst)) worst = score;
  worst->worst_time_error = time_error;
  worst->rounding_floor = floor;
}

void add_run(assess::RunScore& worst, const assess::RunScore& run) {
  worst.finished = true;
  raise(worst.u_error, run.u_error);
  raise(worst.u_error_absolute, run.u_error_absolute);
  raise(worst.v_error, run.v_error);
  raise(worst.energy_error, run.energy_error);
  if (std::isnan(worst.energy_ratio) ||
      departure(run.energy_ratio) > departure(worst.energy_ratio))
    worst.energy_ratio = run.energy_ratio;
  worst.rounding_floor = std::max(worst.rounding_floor, run.rounding_floor);
  if (run.impacts) add_impacts(worst.impacts, *run.impacts);
  raise(worst.work, run.work);
  worst.seconds = std::max(worst.seconds, run.seconds);
}

assess::RunScore no_run(double step) {
  assess::RunScore score;
  score.step = step;
  score.u_error = score.u_error_absolute = score.v_error = unknown;
  score.energy_error = score.energy_ratio = unknown;
  return score;
}

void add(Counts& to, const Counts& more) {
  for (auto count : {&Counts::agrees, &Counts::disagrees, &Counts::not_claimed, &Counts::undecided,
                     &Counts::refused, &Counts::interrupted})
    to.*count += more.*count;
}

bool any(const Record& record, Verdict verdict) {
  return std::ranges::any_of(record.cases, [&](const CaseRecord& one) {
    return std::ranges::any_of(one.subjects, [&](const Subject& subject) {
      return subject.refusal.empty() && subject.assessment.verdict == verdict;
    });
  });
}

}  // namespace

std::string_view to_string(StepSource source) {
  constexpr std::string_view names[] = {"data", "name", "option"};
  return names[static_cast<std::size_t>(source)];
}

std::string_view to_string(CollisionSource source) {
  constexpr std::string_view names[] = {"events", "history", "unknown"};
  return names[static_cast<std::size_t>(source)];
}

std::string_view to_string(SubjectKind kind) {
  return kind == SubjectKind::method ? "method" : "histories";
}

const Run* Subject::shown_run() const {
  for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    for (auto run = level->runs.rbegin(); run != level->runs.rend(); ++run)
      if (!run->metrics.empty() || !run->error_history.t.empty()) return &*run;
  return nullptr;
}

LevelScore worst(const Level& level) {
  LevelScore score{level.step, no_run(level.step), int(level.runs.size()), 0};
  for (const auto& run : level.runs)
    if (run.score.finished)
      add_run(score.worst, run.score);
    else
      ++score.failed;
  return score;
}

LevelScore worst_of_finest(const Subject& subject) {
  for (auto level = subject.levels.rbegin(); level != subject.levels.rend(); ++level)
    if (!level->runs.empty()) return worst(*level);
  return {unknown, no_run(unknown), 0, 0};
}

assess::Ladder ladder_of(const Subject& subject) {
  assess::Ladder ladder;
  for (const auto& level : subject.levels) {
    ladder.push_back({level.step, {}});
    for (const auto& run : level.runs) ladder.back().runs.push_back(run.score);
  }
  return ladder;
}

Counts counts(const CaseRecord& record) {
  Counts all;
  for (const auto& subject : record.subjects) {
    if (!subject.refusal.empty())
      ++all.refused;
    else if (!subject.complete)
      ++all.interrupted;
    else
      switch (subject.assessment.verdict) {
        case Verdict::agrees:
          ++all.agrees;
          break;
        case Verdict::disagrees:
          ++all.disagrees;
          break;
        case Verdict::not_claimed:
          ++all.not_claimed;
          break;
        case Verdict::undecided:
          ++all.undecided;
          break;
      }
  }
  return all;
}

Counts counts(const Record& record) {
  Counts all;
  for (const auto& one : record.cases) add(all, counts(one));
  return all;
}

std::string_view verdict_word(const Subject& subject) {
  if (!subject.refusal.empty()) return "refused";
  if (!subject.complete) return "interrupted";
  return to_string(subject.assessment.verdict);
}

int exit_code(const Record& record) {
  if (record.interrupted) return 130;
  if (any(record, Verdict::disagrees)) return 1;
  return any(record, Verdict::undecided) ? 3 : 0;
}

}  // namespace clackers::study
