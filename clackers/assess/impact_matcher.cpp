#include "clackers/assess/impact_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/check.hpp"

namespace clackers::assess {

ImpactMatcher::ImpactMatcher(const model::Motion& truth, double step)
    : truth_(truth),
      step_(require_step("impact matcher", step)),
      known_(truth.impact_count(truth.end())),
      more_(known_ > 0) {
  if (more_) now_ = target(1);
}

ImpactMatcher::Target ImpactMatcher::target(long long index) const {
  Target found{.index = index, .t = truth_.impact(index).t, .reach = truth_.end()};
  if (index > 1) found.reach = std::min(found.reach, found.t - truth_.impact(index - 1).t);
  if (index < known_) found.reach = std::min(found.reach, truth_.impact(index + 1).t - found.t);
  found.reach *= 0.25;
  return found;
}

// Books the true impact `now_` with what was found for it.
void ImpactMatcher::settle(ImpactScore& score) const {
  ++score.expected;
  if (!nearest_) {
    ++score.missed;
    return;
  }
  ++score.matched;
  score.worst_time_error = std::max(score.worst_time_error, std::abs(*nearest_ - now_.t));
}

void ImpactMatcher::move_on() {
  settle(sum_);
  nearest_.reset();
  more_ = now_.index < known_;
  if (more_) now_ = target(now_.index + 1);
}

void ImpactMatcher::take(double t, bool resting) {
  // A little less than two steps, so that reports two whole steps apart stay two.
  const bool same = last_report_ && t - *last_report_ < (2.0 - 1e-6) * step_;
  last_report_ = t;
  if (same) return;
  while (more_ && t > now_.t + now_.reach) move_on();
  const bool near = more_ && t >= now_.t - now_.reach;
  if (resting && !(near && !nearest_)) return;
  ++sum_.found;
  if (!near || nearest_) ++sum_.extra;
  if (near && (!nearest_ || std::abs(t - now_.t) < std::abs(*nearest_ - now_.t))) nearest_ = t;
}

ImpactScore ImpactMatcher::score(double end, double rounding) const {
  ImpactMatcher rest = *this;
  // What was found although it truly happens in the last two steps or just behind them counts.
  while (rest.more_ && (rest.nearest_ || rest.now_.t <= end - 2.0 * step_)) rest.move_on();
  // A displacement error d of a mass that passes with amplitude times frequency moves its passage
  // by d / (A pi / T), T the time between impacts.
  const double spacing = end / double(std::max(1LL, rest.sum_.expected));
  rest.sum_.rounding_floor = rounding * spacing / std::numbers::pi;
  return rest.sum_;
}

}  // namespace clackers::assess
