#include "clackers/diagnose/ladder/impact_location.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "clackers/diagnose/ladder/locator.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

using measure::FreeState;

constexpr std::size_t most_located_impacts = 60, most_flights = 40;
// Rows beside an impact that may still be closed, as after an impact noticed late.
constexpr std::size_t most_closed_rows = 8;

// Rows around an impact: the last open and closing one, the first open and opening one.
struct Rows {
  std::size_t before, after;
};

bool is_open(const FreeState& state, const model::Contact<>& contact, double sign) {
  return contact.gap_at(state.u) >= 0.0 && sign * contact.gap_rate(state.v) > 0.0;
}

std::optional<std::size_t> row_before(const model::Trajectory& rows, double t,
                                      const model::Contact<>& contact) {
  const auto near = std::size_t(std::ranges::upper_bound(rows.t, t) - rows.t.begin());
  for (auto row = near; row > 0 && near - row <= most_closed_rows;)
    if (is_open(measure::row_state(rows, --row), contact, -1.0)) return row;
  return {};
}

std::optional<Rows> rows_around(const model::Trajectory& rows, std::size_t before,
                                const model::Contact<>& contact) {
  for (auto after = before + 1; after < rows.t.size() && after - before <= 2 * most_closed_rows;
       ++after)
    if (is_open(measure::row_state(rows, after), contact, 1.0)) return Rows{before, after};
  return {};
}

// Whether masses that close the gap after this row stay together: two rows in a row, of the next few,
// have next to none of its speed.
bool stay_together(const model::Trajectory& rows, std::size_t before,
                   const model::Contact<>& contact) {
  constexpr std::size_t most_rows = 5;
  constexpr double small_part = 0.03;
  const double closing = -contact.gap_rate(measure::row_state(rows, before).v);
  int slow = 0;
  for (auto row = before + 1; row < rows.t.size() && row <= before + most_rows; ++row) {
    const double rate = contact.gap_rate(measure::row_state(rows, row).v);
    slow = std::abs(rate) < small_part * closing ? slow + 1 : 0;
    if (slow == 2) return true;
  }
  return false;
}

// LocatedImpact::closed_speed of the rows between these two: 1 where one step makes most of the change,
// as no spring does.
double closed_speed(const model::Trajectory& rows, const Rows& around,
                    const model::Contact<>& contact) {
  const double closing = -contact.gap_rate(measure::row_state(rows, around.before).v);
  const double opening = contact.gap_rate(measure::row_state(rows, around.after).v);
  constexpr double most_of_it = 0.6;
  double sum = 0.0, last = -closing;
  int closed = 0;
  for (auto i = around.before + 1; i < around.after; ++i) {
    const auto state = measure::row_state(rows, i);
    const double rate = contact.gap_rate(state.v);
    if (rate - std::exchange(last, rate) > most_of_it * (closing + opening)) return 1.0;
    if (contact.gap_at(state.u) >= 0.0) continue;
    sum += rate < 0.0 ? -rate / closing : rate / opening;
    ++closed;
  }
  return sum / closed;
}

// Whether rows are no states of the solver: others than every nth step, or between those that a
// tolerance leads to.
bool are_between_steps(const FileFacts& facts, bool by_tolerance) {
  constexpr double same = 1e-3;
  const double steps = facts.step > 0.0 ? facts.spacing / facts.step : 1.0;
  return by_tolerance || std::abs(steps - std::max(1.0, std::round(steps))) > same * steps;
}

double rms(const std::vector<LocatedImpact>& impacts, double LocatedImpact::*member) {
  double sum = 0.0;
  for (const auto& impact : impacts) sum += impact.*member * impact.*member;
  return impacts.empty() ? 0.0 : std::sqrt(sum / double(impacts.size()));
}

}  // namespace

double LocatedImpacts::rms_delay() const { return rms(impacts, &LocatedImpact::delay); }
double LocatedImpacts::rms_defect() const { return rms(impacts, &LocatedImpact::defect); }

bool LocatedImpacts::is_rigid() const {
  // Between a spring's 2/pi and the 1 of an impact that comes late.
  constexpr double least_closed_speed = 0.85;
  double sum = 0.0, count = 0.0;
  for (const auto& impact : impacts)
    if (std::isfinite(impact.closed_speed)) sum += impact.closed_speed, ++count;
  return sum > least_closed_speed * count;
}

std::optional<CommonGap> common_gap(std::span<const LocatedImpacts> files) {
  constexpr double same_gap = 0.1, part_of_delays = 0.2, least_range = 1e-3;
  constexpr std::size_t least_impacts = 3;
  std::vector<double> gaps, delays;
  for (const auto& file : files)
    for (const auto& impact : file.impacts) {
      gaps.push_back(impact.gap);
      delays.push_back(impact.delay);
    }
  if (gaps.empty()) return {};
  const auto relative_range = [](const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax(values);
    return (most - least) / std::abs(measure::median(values));
  };
  const double range = relative_range(gaps);
  if (!(range < same_gap)) return {};
  CommonGap found{.value = measure::median(gaps)};
  found.spread = range * std::abs(found.value);
  const double of_delays = relative_range(delays);
  found.is_told =
      gaps.size() >= least_impacts && of_delays > least_range && range < part_of_delays * of_delays;
  if (files.size() == 1 && !found.is_told) return {};
  return found;
}

LocatedImpacts locate_impacts(const Observation& seen, const model::ImpactProblem<>& problem,
                              bool by_tolerance) {
  LocatedImpacts found;
  found.step = seen.facts.step;
  const auto& sample = seen.sample;
  if (sample.v.empty() || !sample.impacts || problem.contacts.empty()) return found;
  const Locator locator(problem);
  std::vector<double> times, lengths;
  for (const auto& impact : *sample.impacts) times.push_back(impact.t);
  const auto alone = [&](double from, double to) {
    return std::ranges::upper_bound(times, to) - std::ranges::lower_bound(times, from);
  };
  // `own` and the contacts of other impacts between two times; empty where one of them comes twice.
  const auto contacts_between = [&](double from, double to, int own) {
    std::vector<int> numbers{own};
    bool has_own = false;
    for (auto k = std::size_t(std::ranges::lower_bound(times, from) - times.begin());
         k < times.size() && times[k] <= to; ++k) {
      const int contact = (*sample.impacts)[k].contact;
      const bool is_own = contact == own && !std::exchange(has_own, true);
      if (is_own) continue;
      if (contact < 0 || std::size_t(contact) >= problem.contacts.size() ||
          std::ranges::find(numbers, contact) != numbers.end())
        return std::vector<int>();
      numbers.push_back(contact);
    }
    return numbers;
  };
  for (std::size_t k = 0; k < times.size() && found.impacts.size() < most_located_impacts; ++k) {
    const auto& impact = (*sample.impacts)[k];
    const auto& rows =
        !seen.opening.v.empty() && seen.opening.t.back() > impact.t + 20.0 * seen.facts.spacing
            ? seen.opening
            : sample;
    if (impact.contact < 0 || std::size_t(impact.contact) >= problem.contacts.size()) continue;
    const auto& contact = problem.contacts[std::size_t(impact.contact)];
    const auto before = row_before(rows, impact.t, contact);
    if (!before) continue;
    if (stay_together(rows, *before, contact)) {
      const double closing = -contact.gap_rate(measure::row_state(rows, *before).v);
      found.sticking.push_back(
          {.t = rows.t[*before], .contact = impact.contact, .closing = closing});
    }
    const auto around = rows_around(rows, *before, contact);
    if (!around) continue;
    // Between rows of a thinned sample masses may swing to and fro.
    const bool is_thinned = &rows == &sample && std::ssize(sample.t) < seen.rows;
    if (is_thinned && locator.frequency() * (rows.t[around->after] - rows.t[around->before]) > 1.0)
      continue;
    const auto together =
        contacts_between(rows.t[around->before], rows.t[around->after], impact.contact);
    if (together.empty()) continue;
    auto one = locator.located(measure::row_state(rows, around->before),
                               measure::row_state(rows, around->after), contact, problem.contacts,
                               together);
    if (!one) continue;
    one->contact = impact.contact;
    one->delay_steps = one->delay / (seen.facts.step > 0.0 && !by_tolerance ? seen.facts.step
                                                                            : seen.facts.spacing);
    if (are_between_steps(seen.facts, by_tolerance))
      for (const auto to : {around->before, around->after + 1}) {
        if (to == 0 || to >= rows.t.size()) continue;
        const double from_t = rows.t[to - 1], to_t = rows.t[to];
        const bool has_own = from_t <= impact.t && impact.t <= to_t;
        if (alone(from_t, to_t) > has_own) continue;
        one->restitution_error +=
            locator.lack(measure::row_state(rows, to - 1), measure::row_state(rows, to), contact) /
            one->closing;
      }
    // The flights on both sides; what they lose is known below.
    lengths.push_back(rows.t[around->after] - rows.t[around->before]);
    one->closed_speed = closed_speed(rows, *around, contact);
    found.impacts.push_back(*one);
  }
  if (found.impacts.empty()) return found;
  std::vector<double> speeds, gaps, defects;
  for (const auto& impact : found.impacts) speeds.push_back(impact.closing);
  const double speed = measure::median(speeds);
  const auto& rows = sample;
  const auto stride = std::max<std::size_t>(1, rows.t.size() / most_flights);
  for (std::size_t i = 0; i + 1 < rows.t.size(); i += stride) {
    const double s = rows.t[i + 1] - rows.t[i];
    if (!(s > 0.0) || alone(rows.t[i] - s, rows.t[i + 1] + s) > 0) continue;
    const auto from = measure::row_state(rows, i), to = measure::row_state(rows, i + 1);
    const auto now = locator.moved(from, s);
    gaps.push_back(std::abs(problem.contacts.front().direction.dot(now.u - to.u)) / speed);
    defects.push_back(locator.difference(now.u - to.u, now.v - to.v) / speed / s);
  }
  if (gaps.empty()) {
    found.impacts.clear();
    return found;
  }
  found.uncertainty = measure::median(gaps);
  found.flight_defect = measure::median(defects);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    auto& impact = found.impacts[i];
    impact.restitution_error +=
        lengths[i] * (1.0 + impact.restitution) * found.flight_defect * speed / impact.closing;
  }
  return found;
}

}  // namespace clackers::diagnose
