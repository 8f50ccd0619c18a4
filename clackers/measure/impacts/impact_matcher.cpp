#include "clackers/measure/impacts/impact_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::measure {

bool rests_in_contact(const model::Motion& reference, const std::vector<model::Contact<>>& contacts,
                      int contact, double t) {
  if (contact < 0 || contact >= std::ssize(contacts))
    refuse("impact", "contact", double(contact), "a row of the problem's contacts");
  const auto& row = contacts[std::size_t(contact)];
  const auto now = reference.at(std::clamp(t, 0.0, reference.end()), model::Side::right);
  return row.gap_at(now.u) == 0.0 && row.gap_rate(now.v) == 0.0;
}

ImpactMatcher::ImpactMatcher(const model::Motion& reference, double step, double start,
                             int contacts, double contact_time)
    : reference_(reference),
      step_(require_step("impact matcher", step)),
      start_(start),
      known_(reference.impact_count(reference.end())),
      tracks_(std::size_t(std::max(contacts, 1))) {
  const double slow = std::max(step_, 0.5 * contact_time);
  for (const auto& closed : reference.closed_contacts()) {
    allow_around(closed);
    if (!closed.accumulates) continue;
    double from = closed.from, after_next = 0.0;
    auto last = impact_of(closed.contact, reference.impact_count(from), -1);
    // A contact that opens again forgets how late its impacts were.
    double opened = 0.0;
    for (const auto& other : reference.closed_contacts())
      if (other.contact == closed.contact && other.until < from)
        opened = std::max(opened, other.until);
    const auto before = opened > 0.0 ? reference.impact_count(opened) : 0;
    const auto is_resolved = [&] {
      return from - last->t >= apart * slow &&
             after_next >= delays * double(last->index - before) * slow;
    };
    while (last && !is_resolved()) {
      after_next = from - last->t;
      from = last->t;
      last = impact_of(closed.contact, last->index - 1, -1);
    }
    // A report may be early.
    from -= 0.5 * (from - (last ? std::max(last->t, opened) : 0.0));
    accumulations_.push_back({closed.contact, from, closed.until + step_});
  }
  // The impact of each contact before the start may still be found late.
  const auto before = start > 0.0 ? reference.impact_count(start) : 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const auto late = impact_of(int(i), before, -1);
    tracks_[i].target = target(int(i), late ? late->index : 1);
  }
}

// The first impact of a contact from an index on, upwards or downwards.
std::optional<model::MotionImpact> ImpactMatcher::impact_of(int contact, long long from,
                                                            int direction) const {
  for (auto index = from; index >= 1 && index <= known_; index += direction)
    if (auto impact = reference_.impact(index); tracks_.size() == 1 || impact.contact == contact)
      return impact;
  return {};
}

std::optional<ImpactMatcher::Target> ImpactMatcher::target(int contact, long long from) const {
  const auto impact = impact_of(contact, from, 1);
  if (!impact) return {};
  double spacing = reference_.end();
  if (const auto before = impact_of(contact, impact->index - 1, -1))
    spacing = std::min(spacing, impact->t - before->t);
  if (const auto after = impact_of(contact, impact->index + 1, 1))
    spacing = std::min(spacing, after->t - impact->t);
  return Target{impact->index, impact->t, 0.25 * spacing, impact->when.hi - impact->when.lo};
}

// An opening and a closing without an impact are allowed as far off as a match may be.
void ImpactMatcher::allow_around(const model::ClosedContact& closed) {
  const auto before = impact_of(closed.contact, reference_.impact_count(closed.from), -1);
  const auto after = impact_of(closed.contact, reference_.impact_count(closed.until) + 1, 1);
  double opened = before ? before->t : start_, next = after ? after->t : reference_.end();
  for (const auto& other : reference_.closed_contacts()) {
    if (other.contact != closed.contact) continue;
    if (other.until < closed.from) opened = std::max(opened, other.until);
    if (other.from > closed.until) next = std::min(next, other.from);
  }
  const bool by_impact = closed.accumulates || (before && before->t >= closed.begins.lo);
  const double early = by_impact ? 0.0 : 0.25 * (closed.from - opened);
  const double late = closed.opens ? 0.25 * (next - closed.until) : 0.0;
  lasting_.push_back({closed.contact, closed.from - early, closed.until + late});
}

bool ImpactMatcher::lasts(int contact, double t) const {
  return std::ranges::any_of(lasting_, [&](const Lasting& each) {
    return each.contact == contact && t >= each.from && t <= each.until;
  });
}

bool ImpactMatcher::accumulates(int contact, double t) const {
  return t >= expected_until_ || std::ranges::any_of(accumulations_, [&](const Accumulation& each) {
           return each.contact == contact && t >= each.from && t <= each.until;
         });
}

// Counts the true impact of a track with what was found for it.
void ImpactMatcher::settle(int contact, const Track& track) {
  const auto& [target, nearest, last_report] = track;
  if (!nearest && (target->t <= start_ || accumulates(contact, target->t))) return;
  ++sum_.expected;
  if (!nearest) {
    ++sum_.missed;
    return;
  }
  ++sum_.matched;
  sum_.worst_time_error = std::max(sum_.worst_time_error, std::abs(nearest->t - target->t));
  sum_.rounding_floor = std::max(sum_.rounding_floor, target->uncertainty);
  if (keeps_pairs_) pairs_.push_back({target->index, nearest->number});
}

// Moves on to the next true impact of a contact. Those before the last one up to t are out of reach
// from t on and missed; with one contact they need not be asked for one by one.
void ImpactMatcher::advance(int contact, double t) {
  auto& track = tracks_[std::size_t(contact)];
  settle(contact, track);
  const auto settled = std::exchange(track.nearest, {});
  const auto from = *track.target;
  auto next = from.index + 1;
  if (tracks_.size() == 1 && accumulations_.empty() && t < expected_until_) {
    const auto skipped = reference_.impact_count(std::clamp(t, 0.0, reference_.end())) - next;
    if (skipped > 0) {
      sum_.expected += skipped;
      sum_.missed += skipped;
      next += skipped;
    }
  }
  track.target = target(contact, next);
  // Late by half of what the next one, of a shorter flight, allows: the one after it may be anywhere.
  if (!settled || !track.target || !(track.target->reach < from.reach)) return;
  if (std::abs(settled->t - from.t) < 0.5 * track.target->reach) return;
  const auto next_one = std::ranges::find_if(accumulations_, [&](const Accumulation& each) {
    return each.contact == contact && each.until > from.t;
  });
  if (next_one != accumulations_.end())
    next_one->from = std::min(next_one->from, 0.5 * (from.t + track.target->t));
}

void ImpactMatcher::take(double t, bool resting, int contact) {
  const auto number = reports_++;
  auto& [target, nearest, last_report] = tracks_.at(std::size_t(contact));
  const bool same = last_report && t - *last_report < one_impact * step_;
  last_report = t;
  if (same) return;
  while (target && t > target->t + target->reach) advance(contact, t);
  const bool near = target && t >= target->t - target->reach;
  const bool is_nearest =
      near && (!nearest || std::abs(t - target->t) < std::abs(nearest->t - target->t));
  if (accumulates(contact, t) && !(near && !nearest)) return;
  if (!is_nearest && (resting || lasts(contact, t))) return;
  ++sum_.found;
  if (!near || nearest) ++sum_.extra;
  if (is_nearest) nearest = Report{t, number};
}

// The matcher after the last report it will get.
ImpactMatcher ImpactMatcher::ended(double end) const {
  ImpactMatcher rest = *this;
  // What was found although it truly happens in the last two steps or just behind them counts.
  const double seen = end - 2.0 * step_;
  for (std::size_t i = 0; i < rest.tracks_.size(); ++i) {
    const auto& track = rest.tracks_[i];
    while (track.target && (track.nearest || track.target->t <= seen)) rest.advance(int(i), seen);
  }
  return rest;
}

ImpactScore ImpactMatcher::score(double end, double rounding) const {
  auto score = ended(end).sum_;
  // A displacement error d of a mass that passes with amplitude times frequency moves its passage
  // by d / (A pi / T), T the time between impacts.
  const double spacing = end / double(std::max(1LL, score.expected));
  score.rounding_floor = std::max(score.rounding_floor, rounding * spacing / std::numbers::pi);
  return score;
}

std::vector<ImpactPair> ImpactMatcher::pairs(double end) const {
  auto pairs = ended(end).pairs_;
  std::ranges::sort(pairs, {}, &ImpactPair::report);
  return pairs;
}

}  // namespace clackers::measure
