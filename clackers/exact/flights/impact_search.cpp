#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/flights/first_crossing.hpp"
#include "clackers/exact/flights/piecewise_builder.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int most_search_steps = 1000000;
/// Without bounds impacts less than this share of the fastest radian apart are of one instant.
constexpr double nearly_together = 1e-10;

}  // namespace

double PiecewiseMotion::Builder::error_of(std::size_t i, double s) const {
  const auto& seen = watched(i);
  const double rounding = modes().rounding(seen, modes().sizes(flight().free, s), flight().t + s);
  if (!m_.has_bounds_) return rounding;
  const VectorXd row = seen.by_state.col(0);
  return flight().errors.bounds(modes(), row.transpose(), s)[0] +
         row.cwiseAbs().dot(m_.local_errors(flight(), s)) + rounding;
}

auto PiecewiseMotion::Builder::next_contacts() -> std::vector<Closing> {
  const double span = m_.end_ - flight().t;
  if (is_over_ || !(span > 0.0)) return {};
  const double fastest =
      std::max({modes().system().fastest(), highest_force(), stiffest_, 1e-3 / span});
  std::vector<double> from(springs());
  double first = std::min(span, 16.0 / fastest);
  for (std::size_t i = 0; i < springs(); ++i)
    if (const auto gap = watch(i, 0.0); !is_held(i) && gap.second < 0.0 && gap.slope > 0.0)
      first = std::min(first, -8.0 * gap.slope / gap.second);
  for (double to = first, begin = 0.0;; begin = to, to = std::min(span, 2.0 * to)) {
    const auto level = levels(to);
    if (begin == 0.0)
      for (std::size_t i = 0; i < springs(); ++i) {
        const auto opens = opening(i, level[i]);
        if (begins_[i] == Begin::by_speed && come_to_rest(i, level[i], opens.has_value()))
          return next_contacts();
        // Where it opens by less than its error, and then closes.
        if (!opens && begins_[i] == Begin::by_acceleration && watch(i, 0.0).third < 0.0 &&
            problem_.contacts[i].restitution == 0.0) {
          opens_ = begins_;
          return {{i, 0.0, level[i] / certain_gap, 0.0, true}};
        }
        if (!opens) refuse_closed(i, watch(i, 0.0), level[i]);
        from[i] = *opens;
      }
    switching_ = next_switching(begin, to, fastest);
    auto closings = search(level, from, switching_ ? switching_->second : to);
    if (switching_ && closings.empty()) return {};
    switching_.reset();
    if (!closings.empty() || to >= span) return closings;
    for (auto& s : from) s = std::max(s, to);
  }
}

std::optional<std::pair<std::size_t, double>> PiecewiseMotion::Builder::next_switching(
    double from, double until, double fastest) const {
  std::optional<std::pair<std::size_t, double>> first;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!is_spring(i) && !passed_[i]) continue;
    const auto root =
        numerics::first_root(ahead_[i], from, until, 1e-7 / fastest, most_search_steps);
    if (root.status == numerics::FirstRoot::Status::undecided) refuse_length();
    if (root.status != numerics::FirstRoot::Status::found) continue;
    first = {i, root.s};
    until = root.s;
  }
  return first;
}

void PiecewiseMotion::Builder::refuse_length() const {
  throw InputError(fmt::format("{}: the flight from t = {:.6g} s is too long to be searched for "
                               "impacts: more than 1e6 steps. End the run earlier.",
                               m_.who_, flight().t),
                   "out-of-range");
}

double PiecewiseMotion::Builder::unresolved(std::size_t i) const {
  const auto& all = m_.unresolved_;
  const auto last = std::find_if(all.rbegin(), all.rend(),
                                 [&](const Unresolved& skipped) { return skipped.contact == i; });
  return last == all.rend() ? 0.0 : std::max(0.0, last->until - flight().t);
}

std::vector<double> PiecewiseMotion::Builder::levels(double s) const {
  if (springs() == 0) return {};
  const auto size = modes().sizes(flight().free, s);
  std::vector<double> level;
  for (std::size_t i = 0; i < springs(); ++i)
    level.push_back(certain_gap * modes().rounding(watched(i), size, flight().t + s));
  if (!m_.has_bounds_ || modes().dof() == 0) return level;
  MatrixXd rows(springs(), 2 * modes().dof());
  for (std::size_t i = 0; i < springs(); ++i)
    rows.row(Index(i)) = watched(i).by_state.col(0).transpose();
  const VectorXd errors = flight().errors.bounds_until(modes(), rows, s) +
                          rows.cwiseAbs() * m_.local_errors(flight(), s);
  for (std::size_t i = 0; i < springs(); ++i) level[i] += certain_gap * errors[Index(i)];
  return level;
}

std::optional<double> PiecewiseMotion::Builder::opening(std::size_t i, double level) const {
  const double from = unresolved(i);
  if (passed_[i] || begins_[i] == Begin::idle || (is_held(i) && watched(i).vanishes()))
    return m_.end_ + 1.0;
  auto gap = watch(i, from);
  const auto begin = begins_[i];
  if (begin == Begin::open) {
    if (gap.value > level || gap.slope < 0.0) return from;
  } else {
    gap.value = 0.0;
    if (begin >= Begin::by_acceleration) gap.slope = 0.0;
  }
  if (begin == Begin::by_jerk) {
    // Half of what the third derivative gives; the other half is for the fourth.
    const double s = std::cbrt(12.0 * level / gap.third);
    const double fourth = modes().fourth_bound(watched(i), flight().free, m_.end_);
    if (0.25 * fourth * s <= 0.5 * gap.third) return s;
    return climb(i, 3, 4.0 * gap.third / fourth, level);
  }
  if (const auto s = departure(gap, level)) return from + *s;
  if (begin != Begin::by_acceleration || from > 0.0) return std::nullopt;
  return climb(i, 2, 3.0 * gap.second / gap.third_bound, level);
}

// That derivative of the start is certain to 1 % (resting()), a later one to what the error of the next adds: the true
// gap is positive as long as the computed one is above a twentieth of what that derivative alone would make.
std::optional<double> PiecewiseMotion::Builder::climb(std::size_t i, int order, double first,
                                                      double level) const {
  constexpr int most_steps = 1000;
  const auto begin = watch(i, 0.0);
  const double doubt = 0.05 * (order == 2 ? begin.second : begin.third);
  double s = 0.45 * first;
  for (int step = 0; doubt > 0.0 && step < most_steps; ++step) {
    auto gap = watch(i, s);
    if (gap.value > level) {
      const double next_error = deviation(here(), row(i).seen.by_state.col(order + 1));
      return next_error * s <= 0.8 * doubt ? std::optional(s) : std::nullopt;
    }
    const double second = doubt * (order == 2 ? 1.0 : s), slope = second * s / (order - 1);
    gap.value -= slope * s / order;
    gap.slope -= slope;
    gap.second -= second;
    gap.curvature += 2.0 * second;
    if (order == 3) gap.third_bound += doubt;
    const double far = std::min(s, 0.5 * numerics::next_zero(gap).lo);
    if (!(gap.value > 0.0 && far > epsilon * s)) return std::nullopt;
    s += far;
  }
  return std::nullopt;
}

auto PiecewiseMotion::Builder::search(const std::vector<double>& level,
                                      const std::vector<double>& from, double to) const
    -> std::vector<Closing> {
  std::vector<Closing> closings;
  double until = to;
  for (std::size_t i = 0; i < springs(); ++i) {
    const auto error = [&](double s) { return error_of(i, s); };
    const auto found =
        first_crossing(ahead_[i], error, level[i], from[i], until, most_search_steps);
    const double t = flight().t + found.s;
    switch (found.status) {
      case Crossing::Status::none:
        break;
      case Crossing::Status::undecided:
        refuse_length();
      case Crossing::Status::uncertain:
        if (is_held(i) || problem_.contacts[i].restitution > 0.0)
          refuse_graze(i, t, found.gap, found.error);
        closings.push_back(soft_landing(i, found));
        until = std::min(until, found.s);
        break;
      case Crossing::Status::certain: {
        double time_error = found.error / std::abs(watch(i, found.s).slope) + 4.0 * epsilon * t;
        if (!m_.has_bounds_) time_error += nearly_together / modes().system().fastest();
        closings.push_back({i, found.s, found.error, time_error});
        until = std::min(until, closings.back().last());
      }
    }
  }
  // Those up to `to` at most; the window that follows has the others.
  std::erase_if(closings, [&](const Closing& c) { return c.s > to; });
  std::ranges::stable_sort(closings, {}, &Closing::s);
  if (closings.size() > 1 && m_.has_bounds_)
    for (Closing& closing : closings) {
      if (closing.is_soft) continue;
      const double before = closing.gap_error;
      closing.gap_error = error_of(closing.contact, closing.s);
      closing.time_error *= closing.gap_error / before;
      closing.time_error += 4.0 * epsilon * (flight().t + closing.s);
    }
  return closings;
}

// From where the gap is below four times its error; until then it is open for certain.
auto PiecewiseMotion::Builder::soft_landing(std::size_t i, const Crossing& found) const -> Closing {
  double open = found.near, near = found.s;
  const double level = 2.0 * certain_gap * found.error;
  if (watch(i, open).value <= level) near = open;
  for (int halving = 0; halving < 60 && near > open; ++halving) {
    const double middle = 0.5 * (open + near);
    (watch(i, middle).value > level ? open : near) = middle;
  }
  return {i, near, found.error, found.s - near, true};
}

double PiecewiseMotion::Builder::highest_force() const {
  double most = 0.0;
  for (const auto& force : modes().forces()) most = std::max(most, force.frequency);
  return most;
}

void PiecewiseMotion::Builder::refuse_graze(std::size_t i, double t, double gap,
                                            double error) const {
  if (is_held(i))
    throw InputError(
        fmt::format("{}: the force of contact {}, which is closed, comes within {:.3g} N of 0 near "
                    "t = {:.9g} s, and the error there is {:.3g} N; allowed: motions in which it "
                    "is certain whether a contact opens. Change a number of the problem, or end "
                    "the run earlier.",
                    m_.who_, i + 1, std::abs(gap), t, error),
        "not-admissible");
  throw InputError(
      fmt::format(
          "{}: contact {} comes within {:.3g} m near t = {:.9g} s without a certain impact, "
          "and the error there is {:.3g} m; allowed: motions whose impacts are certain. "
          "Change a number of the problem, or end the run earlier.",
          m_.who_, i + 1, std::abs(gap), t, error),
      "not-admissible");
}

void PiecewiseMotion::Builder::refuse_closed(std::size_t i, const numerics::LocalBound& gap,
                                             double level) const {
  const double t = flight().t, eta = problem_.contacts[i].restitution;
  const bool rebounds = !is_held(i) && begins_[i] == Begin::by_speed && gap.slope > 0.0 &&
                        gap.second < -touching_share * gap.curvature;
  if (rebounds && eta < 1.0)
    throw InputError(
        fmt::format("{}: impacts of contact {} accumulate near t = {:.9g} s, and that it rests "
                    "then is not certain: {}; allowed: a rest that is certain. End the run "
                    "earlier.",
                    m_.who_, i + 1, t + 2.0 * gap.slope / (-gap.second * (1.0 - eta)), no_rest_),
        "not-admissible");
  refuse_graze(i, t, rebounds ? -0.5 * gap.slope * gap.slope / gap.second : gap.value, level);
}

}  // namespace clackers::exact
