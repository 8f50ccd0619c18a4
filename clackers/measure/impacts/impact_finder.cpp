#include "clackers/measure/impacts/impact_finder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/base/constants.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/impacts/gap_history.hpp"

namespace clackers::measure {
namespace {

using Eigen::VectorXd;

// The impacts of one contact.
class ContactScan {
 public:
  ContactScan(const model::Trajectory& history, const model::Contact<>& contact, int number,
              const FreeMotion& motion)
      : history_(history),
        contact_(contact),
        number_(number),
        motion_(motion),
        has_velocities_(!history.v.empty()),
        gaps_(!has_velocities_ ? gap_history_from_displacements(history, motion, contact)
                               : gap_history_from_velocities(history, motion, contact)) {}

  void run(std::vector<FoundImpact>& found) const {
    // No impact before this row is open any more. Without velocities row 0 has no rate.
    std::size_t free = has_velocities_ ? 0 : 1;
    for (std::size_t i = 0; i + 1 < gaps_.size(); ++i) {
      if (!strikes(i)) continue;
      const auto span = whole(has_velocities_ ? i : steepest(i), free);
      if (auto impact = impact_in(span)) {
        found.push_back(std::move(*impact));
        free = span.last;
        i = has_velocities_ ? span.last - 1 : span.last;
      }
    }
  }

 private:
  // Rows before and after an impact.
  struct Span {
    std::size_t first, last;
    bool penetrates;  // over more than one step
  };

  // Whether the contact strikes between rows i and i + 1.
  bool strikes(std::size_t i) const {
    const double closing = -gaps_[i].before;
    if (!(closing > 0.0)) return false;  // also where it is not known
    if (!(gaps_.contact_change(i) > 0.5 * closing + gaps_.uncertainty(i))) return false;
    // Near: closed within two steps at the speed of either side.
    double step = gaps_.length(i);
    if (i > 0) step = std::max(step, gaps_.length(i - 1));
    if (i + 2 < gaps_.size()) step = std::max(step, gaps_.length(i + 1));
    const double speed = std::max(closing, std::abs(gaps_[i + 1].after));
    return std::min(gaps_[i].g, gaps_[i + 1].g) <= 2.0 * step * speed;
  }

  // A slope over a jump belongs to neither side, so that without velocities a jump changes the rate
  // in the steps beside its own, too, though less.
  std::size_t steepest(std::size_t i) const {
    while (i + 2 < gaps_.size() && gaps_.contact_change(i + 1) > gaps_.contact_change(i)) ++i;
    return i;
  }

  // All rows of the impact that strikes in step i: back to the last open row, forward until the
  // contact is open, or closes on without a force. A contact at rest still has a force.
  Span whole(std::size_t i, std::size_t free) const {
    if (gaps_.length(i) == 0.0) return {i, i + 1, false};
    Span span{i, i + 1, false};
    while (span.first > free && gaps_[span.first].g < 0.0) --span.first;
    const double closing = std::abs(gaps_[span.first].before);
    const auto rests = [&](std::size_t row) {
      return std::abs(gaps_[row].after) <= gaps_[row].noise + 1e-9 * closing;
    };
    while (span.last + 1 < gaps_.size()) {
      const double change = gaps_.contact_change(span.last),
                   uncertainty = gaps_.uncertainty(span.last);
      const bool rests_on = rests(span.last) && rests(span.last + 1);
      const bool opens = gaps_[span.last].after > 0.0;
      const bool closed = gaps_[span.last].g < 0.0 && !rests_on && (opens || change > uncertainty);
      const bool goes_on = has_velocities_ && change > 0.1 * closing + uncertainty;
      if (!closed && !goes_on) break;
      ++span.last;
    }
    span.penetrates = span.last > span.first + 1;
    return span;
  }

  std::optional<FoundImpact> impact_in(const Span& span) const {
    const auto before = struck(span);
    const double closing = -contact_.gap_rate(before.v);
    double change = 0.0, uncertainty = 0.0;
    for (auto i = span.first; i < span.last; ++i) {
      const bool is_first = i == span.first, is_last = i + 1 == span.last;
      // Rates inside the impact cancel in the sum over its steps.
      change += (is_last ? gaps_[i + 1].after : 0.0) - (is_first ? gaps_[i].before : 0.0) -
                0.5 * gaps_.length(i) * (gaps_[i].acceleration + gaps_[i + 1].acceleration);
      uncertainty += gaps_.uncertainty(i);
    }
    if (!(change > 0.5 * closing + uncertainty)) return {};
    FoundImpact found;
    found.impact.t = found.end = before.t;
    found.impact.contact = number_;
    found.impact.u = entries(before.u);
    found.impact.v_before = entries(before.v);
    found.impact.impulse = unknown;
    const bool is_open = gaps_[span.last].g >= 0.0;
    if (span.penetrates && !is_open && span.last + 1 == gaps_.size()) {
      found.end = gaps_[span.last].t;
      return found;
    }
    const auto after = released(span, before.t);
    found.end = after.t;
    found.impact.v_after = entries(after.v);
    const double gained =
        span.penetrates ? change : contact_.gap_rate(after.v) - contact_.gap_rate(before.v);
    found.impact.impulse = gained / contact_.direction.dot(motion_.response(contact_.direction));
    return found;
  }

  // Where free motion from the last row before the impact closes the contact.
  FreeState struck(const Span& span) const {
    const auto from = state(span.first, Side::before);
    return motion_.moved(from, root(from, gaps_.length(span.first)));
  }

  // Where it was over.
  FreeState released(const Span& span, double t) const {
    const auto from = state(span.last, Side::after);
    if (!span.penetrates) return motion_.moved(from, t - from.t);
    const double back = gaps_.length(span.last - 1);
    if (gaps_[span.last].g < 0.0 || gaps_[span.last - 1].g >= 0.0) return from;
    return motion_.moved(from, root(from, -back));
  }

  // The s between 0 and `reach`, which may be negative, at which the gap of free motion closes; the
  // nearer end where there is none.
  double root(const FreeState& from, double reach) const {
    if (contact_.gap_at(motion_.moved(from, reach).u) > 0.0) return reach;
    double s = 0.0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const auto now = motion_.moved(from, s);
      const double rate = contact_.gap_rate(now.v);
      if (rate == 0.0) break;
      const double next =
          std::clamp(s - contact_.gap_at(now.u) / rate, std::min(0.0, reach), std::max(0.0, reach));
      const double change = std::abs(next - s);
      s = next;
      // Below the spacing of doubles at that time nothing changes any more.
      if (change <= 0x1p-52 * std::abs(from.t)) break;
    }
    return s;
  }

  enum class Side { before, after };

  FreeState state(std::size_t i, Side side) const {
    const auto u = displacement(i);
    if (has_velocities_)
      return {gaps_[i].t, u,
              Eigen::Map<const VectorXd>(
                  history_.v.data() + gaps_[i].row * std::size_t(history_.dof), history_.dof)};
    // As in GapHistory, for each mass: the velocity that free motion has at this end of the step.
    const auto other = side == Side::before ? i - 1 : i + 1;
    const VectorXd there = displacement(other);
    const double h = gaps_[i].t - gaps_[other].t;
    const VectorXd slope = (u - there) / h;
    VectorXd v = slope;
    for (int pass = 0; pass < 3; ++pass)
      v = slope + h * (motion_.acceleration(gaps_[i].t, u, v) / 3.0 +
                       motion_.acceleration(gaps_[other].t, there, 2.0 * slope - v) / 6.0);
    return {gaps_[i].t, u, v};
  }

  VectorXd displacement(std::size_t i) const {
    return Eigen::Map<const VectorXd>(history_.u.data() + gaps_[i].row * std::size_t(history_.dof),
                                      history_.dof);
  }

  const model::Trajectory& history_;
  const model::Contact<>& contact_;
  int number_;
  const FreeMotion& motion_;
  bool has_velocities_;
  GapHistory gaps_;
};

}  // namespace

std::vector<FoundImpact> find_impacts(const model::Trajectory& history,
                                      const model::ImpactProblem<>& problem) {
  const FreeMotion motion(problem.system);
  std::vector<FoundImpact> found;
  for (std::size_t k = 0; k < problem.contacts.size(); ++k)
    ContactScan(history, problem.contacts[k], int(k), motion).run(found);
  std::ranges::stable_sort(found, {},
                           [](const FoundImpact& candidate) { return candidate.impact.t; });
  return found;
}

}  // namespace clackers::measure
