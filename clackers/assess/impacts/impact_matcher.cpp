#include "clackers/assess/impacts/impact_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/check.hpp"

namespace clackers::assess {

ImpactMatcher::ImpactMatcher(const model::Motion& reference, double step, double start)
    : reference_(reference),
      step_(require_step("impact matcher", step)),
      start_(start),
      known_(reference.impact_count(reference.end())),
      more_(known_ > 0) {
  // The impact before the start may still be found late.
  if (more_) now_ = target(start > 0.0 ? std::max(1LL, reference.impact_count(start)) : 1);
}

ImpactMatcher::Target ImpactMatcher::target(long long index) const {
  Target found{.index = index, .t = reference_.impact(index).t, .reach = reference_.end()};
  if (index > 1) found.reach = std::min(found.reach, found.t - reference_.impact(index - 1).t);
  if (index < known_) found.reach = std::min(found.reach, reference_.impact(index + 1).t - found.t);
  found.reach *= 0.25;
  return found;
}

// Books the true impact `now_` with what was found for it.
void ImpactMatcher::settle() {
  if (!nearest_ && now_.t <= start_) return;
  ++sum_.expected;
  if (!nearest_) {
    ++sum_.missed;
    return;
  }
  ++sum_.matched;
  sum_.worst_time_error = std::max(sum_.worst_time_error, std::abs(nearest_->t - now_.t));
  if (keeps_pairs_) pairs_.push_back({now_.index, nearest_->number});
}

void ImpactMatcher::move_on() {
  settle();
  nearest_.reset();
  more_ = now_.index < known_;
  if (more_) now_ = target(now_.index + 1);
}

void ImpactMatcher::take(double t, bool resting) {
  const auto number = reports_++;
  // A little less than two steps, so that reports two whole steps apart stay two.
  const bool same = last_report_ && t - *last_report_ < (2.0 - 1e-6) * step_;
  last_report_ = t;
  if (same) return;
  while (more_ && t > now_.t + now_.reach) move_on();
  const bool near = more_ && t >= now_.t - now_.reach;
  if (resting && !(near && !nearest_)) return;
  ++sum_.found;
  if (!near || nearest_) ++sum_.extra;
  if (near && (!nearest_ || std::abs(t - now_.t) < std::abs(nearest_->t - now_.t)))
    nearest_ = Report{t, number};
}

// The matcher after the last report it will get.
ImpactMatcher ImpactMatcher::ended(double end) const {
  ImpactMatcher rest = *this;
  // What was found although it truly happens in the last two steps or just behind them counts.
  while (rest.more_ && (rest.nearest_ || rest.now_.t <= end - 2.0 * step_)) rest.move_on();
  return rest;
}

ImpactScore ImpactMatcher::score(double end, double rounding) const {
  auto score = ended(end).sum_;
  // A displacement error d of a mass that passes with amplitude times frequency moves its passage
  // by d / (A pi / T), T the time between impacts.
  const double spacing = end / double(std::max(1LL, score.expected));
  score.rounding_floor = rounding * spacing / std::numbers::pi;
  return score;
}

std::vector<ImpactPair> ImpactMatcher::pairs(double end) const { return ended(end).pairs_; }

}  // namespace clackers::assess
