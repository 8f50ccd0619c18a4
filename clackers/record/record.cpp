#include "clackers/record/record.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clackers::judge {

std::string_view to_string(Mismatch mismatch) {
  constexpr std::string_view names[] = {
      "", "behaviour", "lower-order", "higher-order", "floor-reason", "evidence"};
  return names[static_cast<std::size_t>(mismatch)];
}

}  // namespace clackers::judge

namespace clackers::record {
namespace {

void add(Counts& to, const Counts& more) {
  for (auto count : {&Counts::agrees, &Counts::disagrees, &Counts::not_claimed, &Counts::undecided,
                     &Counts::refused, &Counts::interrupted})
    to.*count += more.*count;
}

}  // namespace

std::string_view to_string(StepSource source) {
  constexpr std::string_view names[] = {"data", "name", "option"};
  return names[static_cast<std::size_t>(source)];
}

std::string_view to_string(ImpactSource source) {
  constexpr std::string_view names[] = {"events", "history", "unknown"};
  return names[static_cast<std::size_t>(source)];
}

std::string_view to_string(SubjectKind kind) {
  constexpr std::string_view names[] = {"method", "histories", "program", "callable"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view to_string(RefinementParameter parameter) {
  return parameter == RefinementParameter::step ? "step" : "tolerance";
}

std::string_view to_string(RefinementEnd end) {
  constexpr std::string_view names[] = {"decided",        "budget",     "rounding-floor",
                                        "too-many-steps", "run-failed", "interrupted"};
  return names[static_cast<std::size_t>(end)];
}

const Run* Subject::shown_run() const {
  for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    for (auto run = level->runs.rbegin(); run != level->runs.rend(); ++run)
      if (!run->metrics.empty() || !run->error_history.t.empty()) return &*run;
  return nullptr;
}

LevelScore worst(const Level& level) {
  std::vector<measure::RunScore> scores;
  for (const auto& run : level.runs) scores.push_back(run.score);
  LevelScore score{level.step, measure::worst(scores), int(level.runs.size()), 0};
  score.failed = int(std::ranges::count(scores, false, &measure::RunScore::finished));
  return score;
}

LevelScore worst_of_finest(const Subject& subject) {
  for (auto level = subject.levels.rbegin(); level != subject.levels.rend(); ++level)
    if (!level->runs.empty()) return worst(*level);
  auto none = worst(Level{});
  none.step = none.worst.step = std::numeric_limits<double>::quiet_NaN();
  return none;
}

measure::Ladder ladder_of(const Subject& subject) {
  measure::Ladder ladder;
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
  for (const auto& problem : record.cases) add(all, counts(problem));
  return all;
}

std::string labels_text(const Labels& labels) {
  std::string text;
  for (const auto& [key, value] : labels)
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", key, value);
  return text;
}

std::string_view verdict_word(const Subject& subject) {
  if (!subject.refusal.empty()) return "refused";
  if (!subject.complete) return "interrupted";
  return to_string(subject.assessment.verdict);
}

std::vector<FailedSolver> failed_solvers(const Record& record) {
  std::vector<FailedSolver> failed;
  for (const auto& problem : record.cases)
    for (const auto& subject : problem.subjects) {
      const Run* first = nullptr;
      bool has_finished = !is_solver(subject.kind);
      for (const auto& level : subject.levels)
        for (const auto& run : level.runs) {
          if (first == nullptr) first = &run;
          has_finished = has_finished || run.score.finished;
        }
      if (first != nullptr && !has_finished) failed.push_back({&problem, &subject, first});
    }
  return failed;
}

std::string_view verdict_word(const Record& record) {
  const auto all = counts(record);
  if (record.interrupted) return "interrupted";
  if (all.disagrees > 0) return to_string(Verdict::disagrees);
  if (all.undecided > 0) return to_string(Verdict::undecided);
  return to_string(all.agrees > 0 ? Verdict::agrees : Verdict::not_claimed);
}

int exit_code(const Record& record) {
  const auto word = verdict_word(record);
  if (record.interrupted) return 130;
  if (!failed_solvers(record).empty()) return 4;
  return word == to_string(Verdict::disagrees) ? 1 : word == to_string(Verdict::undecided) ? 3 : 0;
}

}  // namespace clackers::record
