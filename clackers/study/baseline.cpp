#include "clackers/study/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/study/check.hpp"
#include "clackers/study/verify.hpp"
#include "clackers/tables/case_summary.hpp"

namespace clackers::study {
namespace {

// "--case NAME --set a=1,b=2", which makes a case again.
std::string case_options(const record::CaseSummary& problem) {
  std::string values;
  for (const auto& p : problem.parameters)
    values += fmt::format("{}{}={}", values.empty() ? "" : ",", p.name,
                          p.text.empty() ? fmt::format("{}", p.value) : p.text);
  return fmt::format("--case {}{}{}", problem.name, values.empty() ? "" : " --set ", values);
}

std::string plan_options(const record::RefinementPlan& plan) {
  return fmt::format("--coarsest {} --levels {} --samples-per-level {}", plan.coarsest, plan.levels,
                     plan.samples_per_level);
}

[[noreturn]] void refuse_other(std::string_view what, const std::string& theirs,
                               const std::string& ours) {
  throw InputError(fmt::format("baseline: is of {}: {}; this run: {}. Only the same case and the "
                               "same steps can be compared; repeat one of the two with the "
                               "options of the other.",
                               what, theirs, ours),
                   "other-study");
}

// Numbers are compared bit by bit: a record reads back to the same doubles.
bool same(const Quantity& a, const Quantity& b) {
  return a.name == b.name && a.text == b.text && (a.value == b.value || !a.text.empty());
}

void require_same_case(const record::CaseSummary& problem, const record::RefinementPlan& plan,
                       const record::CaseRecord& baseline) {
  const auto& other = baseline.problem;
  if (!std::ranges::equal(other.parameters, problem.parameters, same))
    refuse_other("other parameters", case_options(other), case_options(problem));
  // A case with the same name and parameters that ends elsewhere is of another version.
  if (other.end != problem.end || other.impact_count != problem.impact_count)
    refuse_other("another motion", fmt::format("{} s, {} impacts", other.end, other.impact_count),
                 fmt::format("{} s, {} impacts", problem.end, problem.impact_count));
  const auto& steps = baseline.plan;
  if (steps.coarsest != plan.coarsest || steps.levels != plan.levels ||
      steps.samples_per_level != plan.samples_per_level)
    refuse_other("another ladder", plan_options(steps), plan_options(plan));
}

const record::CaseRecord* find(const record::Record& record, const std::string& case_name) {
  const auto found =
      std::ranges::find(record.cases, case_name,
                        [](const record::CaseRecord& problem) { return problem.problem.name; });
  return found == record.cases.end() ? nullptr : &*found;
}

const record::Subject* find(const record::CaseRecord* record, const std::string& name) {
  if (record == nullptr) return nullptr;
  const auto found = std::ranges::find(record->subjects, name, &record::Subject::name);
  return found == record->subjects.end() ? nullptr : &*found;
}

void require_same(const std::string& command, const std::vector<PlannedCase>& cases,
                  const record::Record& baseline) {
  if (baseline.command != command)
    refuse_other("another command", "clackers " + baseline.command, "clackers " + command);
  bool common = false;
  for (const auto& problem : cases)
    if (const auto* before = find(baseline, problem.problem.name)) {
      require_same_case(problem.problem, problem.steps, *before);
      common = true;
    }
  if (common || cases.empty()) return;
  refuse_other("another case",
               baseline.cases.empty() ? "none" : case_options(baseline.cases.front().problem),
               case_options(cases.front().problem));
}

Finding finding_of(const record::Subject& subject) {
  Finding finding;
  finding.refused = !subject.refusal.empty();
  finding.complete = subject.complete;
  finding.claim = subject.claim;
  if (finding.refused) {
    finding.reason = subject.refusal_code;
    return finding;
  }
  finding.verdict = subject.assessment.verdict;
  finding.behaviour = subject.assessment.displacement.behaviour;
  finding.reason = subject.assessment.displacement.reason;
  return finding;
}

// Steps of both, finest first, each with its two runs.
struct Pair {
  const measure::RunScore *before, *now;
};
std::vector<Pair> common_runs(const record::Subject& before, const record::Subject& now) {
  std::vector<Pair> pairs;
  for (const auto& level : now.levels)
    for (const auto& run : level.runs)
      for (const auto& old_level : before.levels)
        for (const auto& old_run : old_level.runs)
          if (old_run.score.step == run.score.step) pairs.push_back({&old_run.score, &run.score});
  std::ranges::stable_sort(pairs, {}, [](const Pair& pair) { return pair.now->step; });
  return pairs;
}

bool visible(double before, double now, double share) {
  // NaN on one side only is a change; on both it is none.
  if (std::isnan(before) || std::isnan(now)) return std::isnan(before) != std::isnan(now);
  if (before == now) return false;
  return std::abs(now - before) > share * std::max(std::abs(before), std::abs(now));
}

std::optional<Change<judge::LadderFit>> order_change(const judge::LadderFit& before,
                                                     const judge::LadderFit& now) {
  // A line that appears or vanishes changes the behaviour, which has a row of its own.
  if (!before.has_line || !now.has_line) return {};
  const double change = std::abs(now.order - before.order);
  if (!(change > before.spread + now.spread && change >= visible_order)) return {};
  return Change<judge::LadderFit>{before, now};
}

std::optional<ChangeAtStep<double>> error_change(const Pair& pair) {
  const auto& [before, now] = pair;
  if (!visible(before->u_error, now->u_error, visible_error)) return {};
  if (std::abs(now->u_error - before->u_error) <= before->rounding_floor + now->rounding_floor)
    return {};
  return ChangeAtStep<double>{now->step, before->u_error, now->u_error};
}

std::optional<ChangeAtStep<ImpactCounts>> impact_change(const Pair& pair) {
  const auto& before = pair.before->impacts;
  const auto& now = pair.now->impacts;
  if (!before || !now) return {};
  if (before->missed == now->missed && before->extra == now->extra) return {};
  const auto of = [](const measure::ImpactScore& s) {
    return ImpactCounts{s.expected, s.missed, s.extra};
  };
  return ChangeAtStep<ImpactCounts>{pair.now->step, of(*before), of(*now)};
}

void compare_runs(const record::Subject& before, const record::Subject& now,
                  SubjectChange& change) {
  bool finest = true;
  for (const auto& pair : common_runs(before, now)) {
    const double step = pair.now->step;
    if (pair.before->finished != pair.now->finished) {
      if (!change.finished) change.finished = {step, pair.before->finished, pair.now->finished};
      continue;
    }
    if (!pair.now->finished) continue;
    if (finest) {
      change.error = error_change(pair);
      const auto before_work = pair.before->work.force_evaluations;
      const auto now_work = pair.now->work.force_evaluations;
      if (visible(double(before_work), double(now_work), visible_work))
        change.work = {step, before_work, now_work};
      finest = false;
    }
    if (!change.impacts) change.impacts = impact_change(pair);
  }
}

SubjectChange only(SubjectChange::Presence presence) {
  SubjectChange change;
  change.presence = presence;
  return change;
}

SubjectChange change_of(const record::Subject& before, const record::Subject& now) {
  SubjectChange change;
  const Change<Finding> finding{finding_of(before), finding_of(now)};
  if (!(finding.before == finding.now)) change.finding = finding;
  change.order = order_change(before.assessment.displacement, now.assessment.displacement);
  compare_runs(before, now, change);
  return change;
}

}  // namespace

bool SubjectChange::any() const {
  return presence != Presence::both || finding || order || error || impacts || finished || work;
}

bool BaselineComparison::any() const { return std::ranges::any_of(subjects, &SubjectChange::any); }

void require_same_study(const VerifyRequest& request, const record::Record& baseline) {
  require_same("verify", planned_cases(request), baseline);
}

void require_same_study(const CheckRequest& request, const record::Record& baseline) {
  const auto problem = cases::make(
      request.case_name.empty() ? cases::default_case() : request.case_name, request.settings);
  require_same("check", {{tables::summary_of(problem), no_refinement}}, baseline);
}

BaselineComparison compare(const record::Record& now, const record::Record& before) {
  std::vector<PlannedCase> cases;
  for (const auto& problem : now.cases) cases.push_back({problem.problem, problem.plan});
  require_same(now.command, cases, before);
  BaselineComparison all;
  all.before = before.provenance;
  all.interrupted = before.interrupted;
  const auto add = [&](SubjectChange change, const record::CaseRecord& problem,
                       const record::Subject& subject) {
    change.case_name = problem.problem.name;
    change.name = subject.name;
    all.subjects.push_back(std::move(change));
  };
  for (const auto& problem : now.cases)
    for (const auto& subject : problem.subjects) {
      const auto* old = find(find(before, problem.problem.name), subject.name);
      add(old != nullptr ? change_of(*old, subject) : only(SubjectChange::Presence::added), problem,
          subject);
    }
  for (const auto& problem : before.cases)
    for (const auto& subject : problem.subjects)
      if (find(find(now, problem.problem.name), subject.name) == nullptr)
        add(only(SubjectChange::Presence::gone), problem, subject);
  return all;
}

}  // namespace clackers::study
