#include "clackers/measure/errors/mechanics.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/measure/errors/state_errors.hpp"

namespace clackers::measure {
namespace {

std::vector<double> copy(std::span<const double> from) { return {from.begin(), from.end()}; }

std::vector<double> distance(std::span<const double> first, std::span<const double> other) {
  std::vector<double> errors(first.size());
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = std::abs(first[i] - other[i]);
  return errors;
}

}  // namespace

VelocityError::VelocityError(const model::Motion& reference, JumpingQuantity quantity)
    : reference_(reference),
      quantity_(quantity),
      dof_(std::size_t(reference.dof())),
      known_(reference.impact_count(reference.end())),
      from_error_(dof_),
      to_error_(dof_),
      sum_(dof_),
      squares_(dof_) {}

std::span<const double> VelocityError::part(const model::Kinematics& now) const {
  const auto& part = quantity_ == JumpingQuantity::velocity ? now.v : now.a;
  return {part.data(), std::size_t(part.size())};
}

void VelocityError::take(double t, std::span<const double> v, std::span<const double> v_reference) {
  go_on(t);
  for (std::size_t i = 0; i < dof_; ++i) to_error_[i] = std::abs(v[i] - v_reference[i]);
}

void VelocityError::take(std::span<const double> t, StateErrors& errors) {
  // The interval in front of them, and that between the first two, may hold an impact.
  const auto slow = std::min<std::size_t>(2, t.size());
  for (std::size_t i = 0; i < slow; ++i) {
    go_on(t[i]);
    for (std::size_t j = 0; j < dof_; ++j) to_error_[j] = errors.v(j)[i];
  }
  if (t.size() <= slow) return;
  const auto intervals = t.size() - slow;
  double half[StateErrors::most + 8];
  for (std::size_t i = 0; i < intervals; ++i) half[i] = 0.5 * (t[i + 1] - t[i]);
  std::fill_n(half + intervals, 8, 0.0);
  for (std::size_t j = 0; j < dof_; ++j) {
    double* e = errors.v(j);
    e[0] = from_error_[j];  // behind an impact at that time
    double sums[2] = {sum_[j], squares_[j]};
    add_trapezoids(intervals, half, e, sums);
    sum_[j] = sums[0];
    squares_[j] = sums[1];
    from_error_[j] = e[t.size() - 2];
    to_error_[j] = e[t.size() - 1];
  }
  from_ = t[t.size() - 2];
  to_ = t.back();
}

// Makes t the end of the interval that is open.
void VelocityError::go_on(double t) {
  if (taken_ > 0) {
    close();
    from_ = to_;
    std::swap(jumps_, later_);
    later_.clear();
  }
  taken_ = std::min(taken_ + 1, 2);
  to_ = t;
}

void VelocityError::take(const model::ReportedImpact& impact) {
  auto& list = taken_ > 0 && impact.t <= to_ ? jumps_ : later_;
  list.push_back({impact.t, copy(impact.v_before), copy(impact.v_after)});
}

double VelocityError::integral(int mass) const {
  VelocityError whole = *this;
  whole.close();
  return whole.sum_[std::size_t(mass)];
}

double VelocityError::integral_of_square(int mass) const {
  VelocityError whole = *this;
  whole.close();
  return whole.squares_[std::size_t(mass)];
}

void VelocityError::add(double length, const Errors& left, const Errors& right) {
  for (std::size_t i = 0; i < dof_; ++i) {
    sum_[i] += 0.5 * length * (left[i] + right[i]);
    squares_[i] += 0.5 * length * (left[i] * left[i] + right[i] * right[i]);
  }
}

// Integrates over the open interval and leaves the error after its end in from_error_.
void VelocityError::close() {
  if (taken_ < 2) from_ = to_;
  if (jumps_.empty()) {
    add(to_ - from_, from_error_, to_error_);
    std::swap(from_error_, to_error_);
    return;
  }
  double from = from_;
  for (const auto& jump : jumps_) pass(jump, from, from_error_);
  // A jump at the output time itself has the limits of both sides.
  if (from >= to_) return;
  add(to_ - from, from_error_, to_error_);
  std::swap(from_error_, to_error_);
}

// Integrates from `from` over one reported jump; `from` and `error` come back as what follows it.
void VelocityError::pass(const Jump& jump, double& from, Errors& error) {
  if (const auto* impact = join(from)) {
    const auto before = part(impact->before), after = part(impact->after);
    const double first = std::max(from, std::min(jump.t, impact->t));
    const double second = std::max(first, std::max(jump.t, impact->t));
    add(first - from, error, distance(jump.before, before));
    const auto between =
        jump.t < impact->t ? distance(jump.after, before) : distance(jump.before, after);
    add(second - first, between, between);
    from = second;
    error = distance(jump.after, after);
    return;
  }
  const double at = std::max(from, jump.t);
  const auto now = reference_.at(std::clamp(at, 0.0, reference_.end()), model::Side::right);
  add(at - from, error, distance(jump.before, part(now)));
  from = at;
  error = distance(jump.after, part(now));
}

// The first true impact in [from, to_] that has not been joined yet, or nothing.
const model::MotionImpact* VelocityError::join(double from) {
  next_true_ =
      std::max(next_true_, reference_.impact_count(std::clamp(from, 0.0, reference_.end())));
  for (; next_true_ <= known_; ++next_true_) {
    if (true_impact_.index != next_true_) true_impact_ = reference_.impact(next_true_);
    if (true_impact_.t > to_) return nullptr;
    if (true_impact_.t >= from) {
      ++next_true_;
      return &true_impact_;
    }
  }
  return nullptr;
}

}  // namespace clackers::measure
