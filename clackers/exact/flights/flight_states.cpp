// States where flights begin and end, and what impacts make of them; in double-double where the modes are.
#include <cmath>

#include "clackers/base/constants.hpp"
#include "clackers/exact/flights/piecewise_builder.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using numerics::DoubleDouble;

namespace {

VectorXd rounded(const ForcedModes::Numbers& precise) {
  VectorXd z(std::ssize(precise));
  for (std::size_t j = 0; j < precise.size(); ++j) z[Index(j)] = precise[j].hi;
  return z;
}

}  // namespace

auto PiecewiseMotion::Builder::here() const -> State {
  return {flight().regime, flight().t, m_.total(flight(), flight().t),
          flight().errors, 0.0,        precise_};
}

auto PiecewiseMotion::Builder::arrived(double s) const -> State {
  const auto t = numerics::two_sum(flight().t, s);
  State now{flight().regime, t.hi, {}, m_.errors_after(flight(), s)};
  if (precise_.empty()) {
    now.z = m_.total(flight(), t.hi);
    return now;
  }
  now.late = t.lo;
  now.precise = modes().precise_advanced(precise_, {s, 0.0});
  now.z = rounded(now.precise);
  return now;
}

// By Newton's method, from an instant that is right to about the rounding of doubles.
auto PiecewiseMotion::Builder::arrived(std::vector<Closing>& closings) const -> State {
  auto& first = closings.front();
  State now = arrived(first.s);
  if (precise_.empty() || first.is_soft) return now;
  const auto& seen = watched(first.contact);
  DoubleDouble s{first.s, 0.0};
  for (int step = 0; step < 4; ++step) {
    const double change = -ForcedModes::precise_value(seen, now.precise).hi /
                          ForcedModes::precise_slope(seen, now.precise).hi;
    s = s + DoubleDouble{change, 0.0};
    now.precise = modes().precise_advanced(precise_, s);
    if (std::abs(change) <= 0x1p-70 * s.hi) break;
  }
  now.z = rounded(now.precise);
  const auto t = numerics::two_sum(flight().t, s.hi);
  now.t = t.hi;
  now.late = t.lo + s.lo;
  for (auto& closing : closings) {
    const auto& gap = watched(closing.contact);
    closing.s = s.hi;
    closing.gap_error = now.errors.bounds(modes(), gap.by_state.col(0).transpose())[0] +
                        gap.precise_constant_error +
                        gap.precise_errors.dot(now.z.head(gap.precise_errors.size()).cwiseAbs()) +
                        std::abs(ForcedModes::precise_value(gap, now.precise).hi);
    closing.time_error =
        closing.gap_error / std::abs(ForcedModes::precise_slope(gap, now.precise).hi) +
        4.0 * epsilon * now.t;
  }
  return now;
}

auto PiecewiseMotion::Builder::seen_in(std::size_t regime, const State& state) const -> State {
  if (regime == state.regime) return state;
  const auto &before = m_.regimes_[state.regime], &after = m_.regimes_[regime];
  State seen{regime, state.t, after.state(before.displacement(state.z), before.velocity(state.z)),
             state.errors, state.time_error};
  if (!m_.has_bounds_) return seen;
  if (!state.precise.empty() && after.is_precise()) {
    const auto [u, v] = before.precise_motion(state.precise);
    seen.precise = after.precise_state(u, v);
    seen.late = state.late;
    seen.z = rounded(seen.precise);
    seen.errors.add(before, before.precise_change_errors(state.z));
  } else if (!state.precise.empty()) {
    seen.errors.add(before, before.local_errors(state.z - before.steady(state.t), state.t, 0.0));
  }
  std::vector<VectorXd> opened;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (closed_[state.regime][i] && !closed_[regime][i])
      opened.push_back((is_spring(i) ? rows_[state.regime][i].seen : *m_.forces_[state.regime][i])
                           .by_state.col(0));
  seen.errors.change(before, after, opened);
  if (!seen.precise.empty()) seen.errors.add(after, after.precise_change_errors(seen.z));
  return seen;
}

VectorXd PiecewiseMotion::Builder::strike(State& state, const VectorXd& rates,
                                          VectorXd& impulses) const {
  const auto& rows = rows_[state.regime];
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < springs(); ++i)
    if (impulses[Index(i)] > 0.0) active.push_back(i);
  if (state.precise.empty()) {
    for (const auto i : active) state.z += rows[i].impulse * impulses[Index(i)];
    return {};
  }
  const auto& modes = m_.regimes_[state.regime];
  const auto n = std::size_t(modes.dof()), count = active.size();
  const auto sizes = [&](const VectorXd& z) { return VectorXd(z.tail(Index(n)).cwiseAbs()); };
  const VectorXd speeds = sizes(state.z);
  ForcedModes::Numbers p, law, speed;
  MatrixXd inverse(count, count);
  VectorXd errors = VectorXd::Zero(Index(count)), left(count), lost = VectorXd::Zero(2 * Index(n));
  for (std::size_t c = 0; c < count; ++c) {
    const auto& row = rows[active[c]];
    p.push_back({impulses[Index(active[c])], 0.0});
    // Of those that were held, 0.
    const bool closes = rates[Index(active[c])] != 0.0;
    const double e = problem_.contacts[active[c]].restitution;
    speed.push_back(ForcedModes::precise_slope(row.seen, state.precise) *
                    (closes ? numerics::two_sum(1.0, e) : DoubleDouble{}));
    if (closes) errors[Index(c)] = 2.0 * (1.0 + e) * row.seen.precise_errors.dot(speeds);
    for (std::size_t d = 0; d < count; ++d) {
      const auto& other = rows[active[d]];
      law.push_back(ForcedModes::dot(row.seen.precise, other.seen.precise));
      inverse(Index(c), Index(d)) = law.back().hi;
      errors[Index(c)] += 2.0 * impulses[Index(active[d])] *
                          (row.seen.precise_errors.dot(sizes(other.rate())) +
                           other.seen.precise_errors.dot(sizes(row.rate())));
    }
  }
  inverse = numerics::inverse(inverse);
  for (int step = 0; step < 3; ++step) {
    for (std::size_t c = 0; c < count; ++c) {
      auto sum = speed[c];
      for (std::size_t d = 0; d < count; ++d) sum = sum + law[c * count + d] * p[d];
      left[Index(c)] = sum.hi;
    }
    left = inverse * left;
    for (std::size_t c = 0; c < count; ++c) p[c] = p[c] - DoubleDouble{left[Index(c)], 0.0};
  }
  errors = inverse.cwiseAbs() * errors;
  for (std::size_t c = 0; c < count; ++c) {
    const auto& row = rows[active[c]];
    for (std::size_t j = 0; j < n; ++j)
      state.precise[n + j] = state.precise[n + j] + row.seen.precise[j] * p[c];
    impulses[Index(active[c])] = p[c].hi;
    lost.tail(Index(n)) += errors[Index(c)] * sizes(row.rate()) + p[c].hi * row.seen.precise_errors;
  }
  state.z = rounded(state.precise);
  return lost;
}

}  // namespace clackers::exact
