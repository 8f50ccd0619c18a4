#include "clackers/study/baseline.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/study/record/baseline_match.hpp"
#include "clackers/study/verify/verify_plan.hpp"

namespace clackers::study {
namespace {

Standing standing_of(const MethodResult& method) {
  Standing s;
  s.refused = !method.refusal.empty();
  s.complete = method.complete;
  s.claim = method.claim;
  if (s.refused) {
    s.reason = method.refusal_code;
    return s;
  }
  s.verdict = method.assessment.verdict;
  s.behaviour = method.assessment.displacement.behaviour;
  s.reason = method.assessment.displacement.reason;
  return s;
}

// Steps of both, finest first, each with its two runs.
struct Pair {
  const assess::RunScore *before, *now;
};
std::vector<Pair> common_runs(const MethodResult& before, const MethodResult& now) {
  std::vector<Pair> pairs;
  for (const auto& level : now.ladder)
    for (const auto& run : level.runs)
      for (const auto& old_level : before.ladder)
        for (const auto& old_run : old_level.runs)
          if (old_run.step == run.step) pairs.push_back({&old_run, &run});
  std::ranges::stable_sort(pairs, {}, [](const Pair& pair) { return pair.now->step; });
  return pairs;
}

bool visible(double before, double now, double share) {
  // NaN on one side only is a change; on both it is none.
  if (std::isnan(before) || std::isnan(now)) return std::isnan(before) != std::isnan(now);
  if (before == now) return false;
  return std::abs(now - before) > share * std::max(std::abs(before), std::abs(now));
}

std::optional<Change<assess::LadderFit>> order_change(const assess::LadderFit& before,
                                                      const assess::LadderFit& now) {
  // A line that appears or vanishes changes the behaviour, which is told.
  if (!before.has_line || !now.has_line) return {};
  const double change = std::abs(now.order - before.order);
  if (!(change > before.spread + now.spread && change >= visible_order)) return {};
  return Change<assess::LadderFit>{before, now};
}

std::optional<ChangeAtStep<double>> error_change(const Pair& pair) {
  const auto& [before, now] = pair;
  if (!visible(before->u_error, now->u_error, visible_error)) return {};
  if (std::abs(now->u_error - before->u_error) <= before->rounding_floor + now->rounding_floor)
    return {};
  return ChangeAtStep<double>{now->step, before->u_error, now->u_error};
}

std::optional<ChangeAtStep<Collisions>> collision_change(const Pair& pair) {
  const auto& before = pair.before->impacts;
  const auto& now = pair.now->impacts;
  if (!before || !now) return {};
  if (before->missed == now->missed && before->extra == now->extra) return {};
  const auto of = [](const assess::ImpactScore& s) {
    return Collisions{s.expected, s.missed, s.extra};
  };
  return ChangeAtStep<Collisions>{pair.now->step, of(*before), of(*now)};
}

void compare_runs(const MethodResult& before, const MethodResult& now, MethodChange& change) {
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
    if (!change.collisions) change.collisions = collision_change(pair);
  }
}

MethodChange change_of(const MethodResult& before, const MethodResult& now) {
  MethodChange change;
  change.name = now.name;
  const Change<Standing> standing{standing_of(before), standing_of(now)};
  if (!(standing.before == standing.now)) change.standing = standing;
  change.order = order_change(before.assessment.displacement, now.assessment.displacement);
  compare_runs(before, now, change);
  return change;
}

const MethodResult* find(const Record& record, const std::string& name) {
  const auto found = std::ranges::find(record.methods, name, &MethodResult::name);
  return found == record.methods.end() ? nullptr : &*found;
}

}  // namespace

bool operator==(const Standing& a, const Standing& b) {
  return a.refused == b.refused && a.complete == b.complete && a.verdict == b.verdict &&
         a.behaviour == b.behaviour && a.reason == b.reason &&
         a.claim.behaviour == b.claim.behaviour && a.claim.order == b.claim.order &&
         a.claim.reason == b.claim.reason;
}

bool MethodChange::any() const {
  return presence != Presence::both || standing || order || error || collisions || finished || work;
}

bool BaselineComparison::any() const { return std::ranges::any_of(methods, &MethodChange::any); }

void require_same_study(const VerifyRequest& request, const Record& baseline) {
  match_baseline(plan_of(request).summary, request.plan, baseline);
}

BaselineComparison compare(const Record& now, const Record& baseline) {
  match_baseline(now.problem, now.plan, baseline);
  BaselineComparison all;
  all.before = baseline.provenance;
  all.interrupted = baseline.interrupted;
  for (const auto& method : now.methods) {
    const auto* before = find(baseline, method.name);
    if (before != nullptr) {
      all.methods.push_back(change_of(*before, method));
    } else {
      all.methods.emplace_back();
      all.methods.back().name = method.name;
      all.methods.back().presence = MethodChange::Presence::added;
    }
  }
  for (const auto& method : baseline.methods)
    if (find(now, method.name) == nullptr) {
      all.methods.emplace_back();
      all.methods.back().name = method.name;
      all.methods.back().presence = MethodChange::Presence::gone;
    }
  return all;
}

}  // namespace clackers::study
