#include "clackers/measure/errors/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/constants.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/errors/meter.hpp"
#include "clackers/measure/impacts/gap_history.hpp"
#include "clackers/measure/impacts/impact_finder.hpp"
#include "clackers/measure/impacts/impact_matcher.hpp"
#include "clackers/numerics/time_steps.hpp"

namespace clackers::measure {
namespace {

constexpr std::size_t block_size = 4096;  // rows of reference that fit a cache

// Vectors with an entry that is not finite count as not known.
void forget_what_is_not_finite(model::Impact& impact) {
  for (auto* vector : {&impact.u, &impact.v_before, &impact.v_after})
    if (!std::ranges::all_of(*vector, [](double x) { return std::isfinite(x); })) vector->clear();
  if (!std::isfinite(impact.impulse)) impact.impulse = unknown;
}

}  // namespace

Comparison::Comparison(const model::Trajectory& history, const model::Motion& reference,
                       const model::ImpactProblem<>& problem, RunFacts facts)
    : given_(history), reference_(reference), problem_(problem), facts_(std::move(facts)) {
  require_comparable(history, reference, problem);
  step_ = numerics::time_steps(history.t).median;
  widened_ = with_jump_limits(history);
  const auto scale = reference.peak();
  u_envelope_ = entries(scale.u);
  v_envelope_ = entries(scale.v);
  a_envelope_ = entries(scale.a);
  // The search for impacts needs memory for a while; the reference comes after it.
  collect_impacts();
  sample_reference();
}

// Each row once, in blocks of one side.
void Comparison::sample_reference() {
  const auto& t = history().t;
  const auto size = t.size() * dof();
  reference_u_.resize(size);
  reference_v_.resize(size);
  if (has_accelerations()) reference_a_.resize(size);
  std::vector<double> times;
  for (std::size_t from = 0; from < t.size(); from += times.size()) {
    const bool left = is_left_limit(from);
    times.clear();
    for (auto row = from; row < t.size() && times.size() < block_size; ++row) {
      if (is_left_limit(row) != left) break;
      times.push_back(std::min(t[row], reference_.end()));
    }
    const auto part = [&](std::vector<double>& all) {
      return all.empty() ? std::span<double>()
                         : std::span(all).subspan(from * dof(), times.size() * dof());
    };
    reference_.sample(times, left ? model::Side::left : model::Side::right,
                      {part(reference_u_), part(reference_v_), part(reference_a_)});
  }
}

Meter Comparison::fill_meter(const Comparison& comparison) {
  const auto& given = comparison.given_;
  const auto& reference_rows = comparison.history().t;
  const auto dof = comparison.dof(), count = given.t.size();
  const bool has_v = comparison.has_velocities();
  std::vector<const model::Impact*> impacts;
  for (const auto& impact : comparison.reports_)
    if (has_v && impact.v_before.size() == dof && impact.v_after.size() == dof &&
        impact.t >= given.t.front())
      impacts.push_back(&impact);
  auto next = impacts.begin();
  Meter meter(comparison.reference_, comparison.problem_,
              scales_of(comparison.reference_, comparison.problem_));
  std::size_t reference_row = 0;
  const auto part = [dof](std::span<const double> all, std::size_t row, std::size_t rows = 1) {
    return all.empty() ? all : all.subspan(row * dof, rows * dof);
  };
  // States that follow each other are taken together.
  std::size_t waiting = 0, first = 0, first_reference = 0;
  const auto take_waiting = [&] {
    meter.take({&given.t[first], waiting},
               {part(given.u, first, waiting), part(given.v, first, waiting)},
               {part(comparison.reference_u_, first_reference, waiting),
                part(comparison.reference_v_, first_reference, waiting)});
    waiting = 0;
  };
  const auto take_state = [&](std::size_t row, std::size_t reference) {
    if (reference != first_reference + waiting) take_waiting();  // behind limits that were added
    if (waiting++ > 0) return;
    first = row;
    first_reference = reference;
  };
  const auto take_limit = [&](std::size_t row, std::size_t reference) {
    take_waiting();
    meter.take_displacements(&given.u[row * dof], &comparison.reference_u_[reference * dof]);
  };
  // As a run does: an impact comes after the state at its time.
  const auto take_impacts = [&](double before) {
    if (next != impacts.end() && (*next)->t < before) take_waiting();
    for (; next != impacts.end() && (*next)->t < before; ++next)
      meter.take(model::ReportedImpact{(*next)->t, (*next)->contact, (*next)->u, (*next)->v_before,
                                       (*next)->v_after, (*next)->impulse});
  };
  for (std::size_t row = 0; row < count; ++row) {
    const double t = given.t[row];
    // The last row of this time: where limits of an impact were added, the right one.
    while (reference_row + 1 < reference_rows.size() && reference_rows[reference_row + 1] <= t)
      ++reference_row;
    const bool is_jump = row + 1 < count && given.t[row + 1] == t;
    take_impacts(t);
    if (!is_jump) {
      take_state(row, reference_row);
      continue;
    }
    while (next != impacts.end() && (*next)->t == t) ++next;  // the rows stand for them
    if (row == 0)
      take_state(row, reference_row - 1);
    else
      take_limit(row, reference_row - 1);
    take_waiting();
    if (has_v)
      meter.take(
          model::ReportedImpact{t, 0, {}, part(given.v, row), part(given.v, row + 1), unknown});
    ++row;
    if (row + 1 == count)
      take_state(row, reference_row);
    else
      take_limit(row, reference_row);
  }
  take_waiting();
  take_impacts(std::nextafter(given.t.back(), infinity));
  return meter;
}

const Meter& Comparison::meter() const { return shared(fill_meter); }

RunScore Comparison::score(double step) const {
  auto score = meter().score();
  score.step = step;
  score.finished = true;
  score.impacts = score_;
  return score;
}

double Comparison::impact_period() const {
  if (impact_period_ != 0.0) return impact_period_;
  impact_period_ = reference_.end();
  const auto count = reference_.impact_count(reference_.end());
  for (long long k = 2; k <= count; ++k)
    if (const double period = reference_.impact(k).t - reference_.impact(1).t; period > 0.0) {
      impact_period_ = period;
      break;
    }
  return impact_period_;
}

std::string Comparison::objection_to_sparse_rows() const {
  const auto& t = history().t;
  const auto expected = reference_.impact_count(std::min(t.back(), reference_.end())) -
                        reference_.impact_count(t.front());
  if (double(expected) <= 10.0 * double(rows()) + 1000.0) return {};
  return fmt::format("The history has {} rows for {} true impacts.", rows(), expected);
}

void Comparison::collect_impacts() {
  if (problem_.has_unstated_impacts()) return;
  // Two true impacts of a contact must never count as one: the two steps within which reports are
  // joined are at most an eighth of the mean time between them, half of what a match may be off.
  const auto contacts = std::max<std::size_t>(problem_.contacts.size(), 1);
  const auto spacing = reference_.end() * double(contacts) /
                       double(std::max(1LL, reference_.impact_count(reference_.end())));
  const double step = std::min(step_, spacing / 16.0);
  if (!given_.impacts) {
    source_ = ImpactSource::found_in_history;
    for (auto& found : find_impacts(given_, problem_)) {
      impacts_.push_back(std::move(found.impact));
      impact_ends_.push_back(found.end);
    }
    match_impacts(step);
    return;
  }
  reports_ = *given_.impacts;
  std::ranges::stable_sort(reports_, {}, &model::Impact::t);
  std::vector<std::optional<std::size_t>> last(contacts);  // impact of each contact
  for (auto& report : reports_) {
    forget_what_is_not_finite(report);
    auto& same = last[std::size_t(report.contact)];
    if (same && report.t - impact_ends_[*same] < one_impact * step) {
      impacts_[*same].v_after = report.v_after;
      impacts_[*same].impulse += report.impulse;
      impact_ends_[*same] = report.t;
    } else {
      same = impacts_.size();
      impact_ends_.push_back(report.t);
      impacts_.push_back(report);
    }
  }
  match_impacts(step);
}

// The time behind which no true impact is fast enough to be told from rest in a history [s].
double Comparison::last_seen_impact() const {
  // A change of the rate must exceed its noise by half of the closing rate.
  constexpr double slowest = 4.0 * resting_rate;
  const Eigen::Map<const Eigen::VectorXd> peak(v_envelope_.data(), given_.dof);
  const auto last = reference_.impact_count(std::min(given_.t.back(), reference_.end()));
  for (auto index = last; index >= 1 && last - index < std::ssize(given_.t); --index) {
    const auto impact = reference_.impact(index);
    const auto& contact = problem_.contacts[std::size_t(impact.contact)];
    if (-contact.gap_rate(impact.before.v) < slowest * contact.direction.cwiseAbs().dot(peak))
      continue;
    return index == last ? std::numeric_limits<double>::infinity()
                         : 0.5 * (impact.t + reference_.impact(index + 1).t);
  }
  return std::numeric_limits<double>::infinity();
}

void Comparison::match_impacts(double step) {
  const auto& t = given_.t;
  ImpactMatcher matcher(reference_, step, t.front(), int(problem_.contacts.size()),
                        facts_.contact_time);
  matcher.keep_pairs();
  if (source_ == ImpactSource::found_in_history && has_velocities())
    matcher.expect_until(last_seen_impact());
  for (const auto& impact : impacts_)
    matcher.take(impact.t,
                 rests_in_contact(reference_, problem_.contacts, impact.contact, impact.t),
                 impact.contact);
  score_ = matcher.score(
      t.back(), rounding_floor(reference_, reference_.peak(), std::ssize(t), t.front(), t.back()));
  for (const auto& pair : matcher.pairs(t.back()))
    matches_.push_back({pair.report, reference_.impact(pair.reference)});
}

}  // namespace clackers::measure
