#include "clackers/study/subject_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/base/codes.hpp"
#include "clackers/diagnose/diagnose.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/ladder/sanity.hpp"
#include "clackers/judge/convergence/claim_comparison.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/study/check/case_family.hpp"

namespace clackers::study {
namespace {

// Failures in a row after which smaller steps are not tried.
constexpr int most_repeated = 3;

// The reference displacements at the end over the largest envelopes.
std::vector<double> reference_end(const model::Motion& motion) {
  const auto end = motion.at(motion.end(), model::Side::right).u;
  const auto envelope = motion.peak().u;
  std::vector<double> u;
  for (Eigen::Index i = 0; i < end.size(); ++i) u.push_back(end[i] / envelope[i]);
  return u;
}

bool is_at_step_end(const diagnose::Diagnosis& cause) {
  return cause.code == Code("impact-at-step-end").name();
}

// What a cause leaves of a claim to converge: impacts at the ends of steps are of first order, and scatter;
// another system is not the one that was claimed, however good the order of the flights is.
Verdict least_verdict(const diagnose::Diagnosis& cause, const Claim& claim) {
  if (is_at_step_end(cause) && cause.confidence >= diagnose::sure &&
      (claim.behaviour == Behaviour::exact ||
       (claim.behaviour == Behaviour::proper && claim.order > 1.5)))
    return Verdict::disagrees;
  if (claim.behaviour == Behaviour::stagnating || claim.behaviour == Behaviour::divergent)
    return Verdict::not_claimed;
  const auto* row = diagnose::find_cause(cause.code);
  return row->effect == diagnose::CauseEffect::other_system ? Verdict::undecided
                                                            : Verdict::not_claimed;
}

judge::HistoryFacts facts_of(const record::HistoryFile& file, const model::Motion& motion) {
  return {.rows = file.rows,
          .printed_floor = file.printed_floor,
          .first = file.first,
          .start_error = file.start_error,
          .rows_resolve_impacts = file.rows_resolve_impacts,
          .last = file.last,
          .end = motion.end(),
          .expected_to_last = motion.impact_count(file.last),
          .expected = motion.impact_count(motion.end())};
}

}  // namespace

SubjectStudy::SubjectStudy(const StudyCase& problem, std::unique_ptr<Candidate> candidate,
                           const record::RefinementPlan& plan, const Wanted& of_shown_run)
    : problem_(problem),
      candidate_(std::move(candidate)),
      facts_(candidate_->facts()),
      subject_(facts_.subject),
      first_(plan),
      plan_(plan),
      of_shown_run_(of_shown_run),
      is_closed_(!subject_.refusal.empty()) {}

SubjectStudy::SubjectStudy(const StudyCase& problem, record::Subject subject)
    : problem_(problem), subject_(std::move(subject)) {}

void SubjectStudy::make(const RunTask& task, TaskShare& share, const std::atomic<bool>* interrupt) {
  {
    const std::lock_guard lock(guard_);
    if (repeated_ >= most_repeated) {
      Measured skipped{last_repeated_};
      skipped.run.score.step = task.resolution();
      skipped.run.score.failure = fmt::format("not made after {} runs in a row: {}", repeated_,
                                              last_repeated_.score.failure);
      runs_.emplace(task.resolution(), Made{task.run, std::move(skipped)});
      return;
    }
  }
  auto measured = candidate_->run(task, share, interrupt);
  if (measured) take(task, std::move(*measured));
}

void SubjectStudy::take(const RunTask& task, Measured measured) {
  const std::lock_guard lock(guard_);
  if (measured.observation) {
    measured.observation->facts.step = task.resolution();
    observations_.push_back(std::move(*measured.observation));
    measured.observation.reset();
  }
  if (task.wanted.observation) return;
  repeated_ = measured.would_repeat ? repeated_ + 1 : 0;
  if (measured.would_repeat) last_repeated_ = measured.run;
  runs_.emplace(task.resolution(), Made{task.run, std::move(measured)});
}

void SubjectStudy::assess(const record::RefinementPlan& plan) {
  plan_ = plan;
  if (!subject_.refusal.empty()) return;
  group();
  auto& assessment = subject_.assessment;
  if (levels_.empty())
    assessment.reason = assessment.displacement.reason = Code("interrupted").name();
  else
    decide();
}

std::optional<measure::SharedImpacts> SubjectStudy::shared_impacts() const {
  if (problem_.shared.empty()) return {};
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level)
    for (auto made = level->runs.rbegin(); made != level->runs.rend(); ++made) {
      const auto& run = (*made)->measured.run;
      if (run.metrics.empty() && run.error_history.t.empty()) continue;
      return measure::at_shared_instants(problem_.shared, problem_.problem.problem.start.t,
                                         run.error_history.t, run.error_history.y);
    }
  return {};
}

// The one place of the verdict. It follows the first of these findings that there is: another system,
// as the rows or the limit of histories show it; noise in them, which is no floor; the ladder of
// errors with the evidence of the finest run. Causes of a method's errors explain its verdict and do
// not change it: a method moves this very system.
void SubjectStudy::decide() {
  judge::JudgeContext facts{.contact_time = subject_.contact_time,
                            .tolerance = subject_.tolerance,
                            .shared = shared_impacts(),
                            .closest_impacts = problem_.closest_impacts,
                            .by_tolerance = by_tolerance()};
  const auto& motion = *problem_.problem.motion;
  for (const auto& [step, made] : runs_) {
    const auto& run = made.measured.run;
    if (!run.score.finished || !run.file) continue;
    facts.contact_time = subject_.contact_time = run.file->contact_time;
    facts.finest = facts_of(*run.file, motion);
  }
  std::ranges::stable_sort(observations_, std::greater{},
                           [](const diagnose::Observation& history) { return history.facts.step; });
  std::span<const diagnose::Observation> histories = observations_;
  auto ladder = ladder_;
  std::optional<diagnose::OddRun> odd;
  if (!is_method()) odd = diagnose::odd_run(ladder, by_tolerance());
  if (odd) {
    auto& runs = ladder[odd->level].runs;
    const double step = runs[odd->run].step;
    runs.erase(runs.begin() + std::ptrdiff_t(odd->run));
    if (runs.empty()) ladder.erase(ladder.begin() + std::ptrdiff_t(odd->level));
    const auto others = std::stable_partition(
        observations_.begin(), observations_.end(),
        [&](const diagnose::Observation& one) { return one.facts.step == step; });
    histories = histories.subspan(std::size_t(others - observations_.begin()));
  }
  auto limit = diagnose::limit_of(histories, problem_.problem.problem, motion);
  // What a solver with tolerances keeps fixed, as an absolute one, may end in such an error.
  constexpr double of_fixed_tolerances = 1e-2;
  if (by_tolerance() && limit.distance < of_fixed_tolerances) limit.wrong = false;
  facts.wrong_limit = !is_method() && limit.wrong;
  auto& assessment = subject_.assessment;
  assessment = judge::judge(ladder, subject_.claim, facts);
  if (is_method() && observations_.empty()) return;
  // Errors of a method that fall along a line lead to no other motion, however a few of its runs scatter.
  if (is_method() && judge::shows_a_line(assessment.displacement)) limit = {};
  subject_.diagnoses = diagnose::diagnose({.problem = problem_.problem.problem,
                                           .motion = motion,
                                           .histories = histories,
                                           .ladder = ladder,
                                           .displacement = assessment.displacement,
                                           .velocity = assessment.velocity,
                                           .limit = limit,
                                           .by_tolerance = by_tolerance(),
                                           .is_this_system = is_method(),
                                           .family = family_of(problem_.problem)});
  if (is_method()) {
    // Why a method does not converge through impacts, its claim says.
    if (judge::explains_no_order(subject_.claim)) std::erase_if(subject_.diagnoses, is_at_step_end);
    return;
  }
  if (subject_.claim.velocity_order > 0.0)
    std::erase_if(subject_.diagnoses, [](const diagnose::Diagnosis& found) {
      return found.code == Code("velocity-order-lower").name();
    });
  if (!histories.empty())
    subject_.impacts =
        diagnose::locate_impacts(histories.back(), problem_.problem.problem, by_tolerance())
            .impacts;
  if (odd) subject_.diagnoses.push_back(odd->found);
  const auto broken = std::ranges::find_if(subject_.diagnoses, diagnose::denies_ladder);
  if (broken != subject_.diagnoses.end()) {
    facts.no_ladder = broken->code;
    facts.wrong_limit = false;
  }
  // Files of another system converge to another motion, also where too few of them show it, and those
  // of impacts found to a fixed tolerance do not; what diagnosis finds in the rows, errors may not show.
  const auto is_located = [](const diagnose::Diagnosis& found) {
    return found.code == Code("impact-tolerance").name();
  };
  const bool other = (facts.wrong_limit && std::ranges::none_of(subject_.diagnoses, is_located)) ||
                     std::ranges::any_of(subject_.diagnoses, diagnose::is_other_system);
  const bool has_other_impacts = std::ranges::any_of(assessment.evidence, [](const auto& found) {
    return found.code == judge::EvidenceCode("other-impacts").name();
  });
  subject_.departure = other || has_other_impacts ? limit.departure : std::nullopt;
  const bool noise = std::ranges::any_of(subject_.diagnoses, diagnose::is_noise);
  for (const auto& cause : subject_.diagnoses)
    if (const auto least = least_verdict(cause, subject_.claim);
        facts.least_verdict == Verdict::not_claimed || least == Verdict::disagrees) {
      facts.least_verdict = least;
      facts.cause_against = cause.code;
    }
  // What single precision makes is a floor that the digits alone do not tell.
  bool single = false;
  for (const auto& cause : subject_.diagnoses)
    if (const double floor = cause.fact("floor");
        cause.code == Code("single-precision").name() && floor > 0.0 && facts.finest) {
      single = true;
      facts.finest->printed_floor = std::max(facts.finest->printed_floor, floor);
      for (auto& level : ladder)
        for (auto& run : level.runs) run.rounding_floor = std::max(run.rounding_floor, floor);
    }
  if (other == facts.wrong_limit && !noise && !single && facts.no_ladder.empty() &&
      facts.least_verdict == Verdict::not_claimed)
    return;
  facts.wrong_limit = other;
  facts.noise = noise;
  assessment = judge::judge(ladder, subject_.claim, facts);
}

void SubjectStudy::explain() {
  if (!observations_.empty()) decide();
  observations_.clear();
}

NextPlan SubjectStudy::next() const {
  if (by_tolerance() || !facts_.levels.empty() || repeated_ >= most_repeated ||
      std::ranges::any_of(subject_.diagnoses, diagnose::denies_ladder))
    return {};
  auto open = subject_;
  if (!is_method() && open.assessment.displacement.behaviour == Behaviour::undecided)
    open.assessment.verdict = Verdict::undecided;
  return next_plan(open, ladder_, plan_, problem_.summary);
}

void SubjectStudy::close(record::RefinementEnd end, double next_seconds) {
  is_closed_ = true;
  subject_.refinement = refinement_of(first_, plan_, end, next_seconds);
}

// Without a claim through impacts a user expects the order of smooth motion.
std::optional<record::SelfResult> SubjectStudy::self_convergence() const {
  const double order = subject_.claim.order > 0.0 ? subject_.claim.order : facts_.order;
  if (!facts_.has_ends || levels_.empty() || !(order > 0.0) || !std::isfinite(order)) return {};
  std::vector<judge::ResponseLevel> ends;
  for (const auto& level : levels_) {
    ends.emplace_back();
    for (const auto* made : level.runs) {
      const auto& score = made->measured.run.score;
      ends.back().push_back({score.step, made->measured.end_u, score.rounding_floor});
    }
  }
  return record::self_result(
      std::move(ends), reference_end(*problem_.problem.motion),
      {.claimed_order = order, .size = 1.0, .contact_time = subject_.contact_time});
}

record::Subject SubjectStudy::finish() {
  subject_.self_convergence = self_convergence();
  for (const auto& level : levels_) {
    auto& added = subject_.levels.emplace_back(record::Level{level.nominal, {}});
    for (auto* made : level.runs) added.runs.push_back(std::move(made->measured.run));
  }
  return std::move(subject_);
}

}  // namespace clackers::study
