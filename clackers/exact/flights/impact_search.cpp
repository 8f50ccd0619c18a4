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

}  // namespace

numerics::LocalBound PiecewiseMotion::Builder::gap_ahead(std::size_t i, double s) const {
  const auto now = modes().advanced(flight().free, s);
  const auto size = modes().sizes(now, m_.end_);
  const Eigen::Vector4d of_modes = row(i).by_state.transpose() * now;
  const Eigen::Vector3d pushed = row(i).by_state.leftCols(3).transpose() * modes().push();
  numerics::LocalBound bound;
  bound.value = of_modes[0] - contacts_[i].gap;
  bound.slope = of_modes[1] + pushed[0];
  bound.second = of_modes[2] + pushed[1];
  bound.third = of_modes[3] + pushed[2];
  bound.curvature = modes().bound(row(i).by_state.col(2), size) + std::abs(pushed[1]);
  bound.third_bound = modes().bound(row(i).by_state.col(3), size) + std::abs(pushed[2]);
  for (const auto& force : modes().forces()) {
    const std::complex<double> y = row(i).gap().cast<std::complex<double>>().dot(force.steady);
    const auto turned = y * std::polar(1.0, force.frequency * (flight().t + s));
    const double square = force.frequency * force.frequency;
    bound.value += turned.real();
    bound.slope -= force.frequency * turned.imag();
    bound.second -= square * turned.real();
    bound.curvature += square * std::abs(y);
    bound.third += square * force.frequency * turned.imag();
    bound.third_bound += square * force.frequency * std::abs(y);
  }
  bound.reach = m_.end_ + 1.0;  // a gap that rests has no other
  return bound;
}

double PiecewiseMotion::Builder::gap_error(std::size_t i, const MatrixXd& covariance,
                                           double s) const {
  const auto size = modes().sizes(flight().free, s);
  return factor() * std::sqrt(row(i).gap().dot(covariance * row(i).gap())) + gap_rounding(i, size);
}

double PiecewiseMotion::Builder::gap_rounding(std::size_t i, const ForcedModes::Sizes& size) const {
  return epsilon * double(m_.dof() + 4) *
         (std::abs(contacts_[i].gap) + modes().bound(row(i).gap(), size));
}

auto PiecewiseMotion::Builder::next_contacts() -> std::vector<Closing> {
  const double span = m_.end_ - flight().t;
  if (rests_ || !(span > 0.0)) return {};
  const double fastest =
      std::max({modes().system().fastest(), highest_force(), stiffest_, 1e-3 / span});
  std::vector<double> from(springs());
  for (double to = std::min(span, 16.0 / fastest), begin = 0.0;;
       begin = to, to = std::min(span, 2.0 * to)) {
    const auto level = levels(to);
    if (begin == 0.0) {
      for (std::size_t i = 0; i < springs(); ++i) from[i] = opening(i, level[i]);
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
  for (std::size_t i = springs(); i < contacts_.size(); ++i) {
    const double sign = closed_springs_[flight().regime][i - springs()] ? -1.0 : 1.0;
    const auto signed_gap = [&](double s) {
      auto gap = gap_ahead(i, s);
      for (double* x : {&gap.value, &gap.slope, &gap.second, &gap.third}) *x *= sign;
      return gap;
    };
    const auto root =
        numerics::first_root(signed_gap, from, until, 1e-7 / fastest, most_search_steps);
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

std::vector<double> PiecewiseMotion::Builder::levels(double s) const {
  if (springs() == 0) return {};
  const VectorXd deviation = flight().covariance.diagonal().cwiseSqrt();
  const auto carried = modes().sizes(deviation, s, 0.0), size = modes().sizes(flight().free, s);
  const VectorXd local = modes().local_errors(flight().free, flight().t, s);
  std::vector<double> level;
  for (std::size_t i = 0; i < springs(); ++i) {
    const double error =
        modes().bound(row(i).gap(), carried) + row(i).gap().cwiseProduct(local).norm();
    level.push_back(certain_gap * (factor() * error + gap_rounding(i, size)));
  }
  return level;
}

double PiecewiseMotion::Builder::opening(std::size_t i, double level) const {
  auto gap = gap_ahead(i, 0.0);
  if (is_closed_[i]) {
    gap.value = 0.0;
  } else if (gap.value > level || gap.slope < 0.0) {
    return 0.0;
  }
  if (const auto s = departure(gap, level)) return *s;
  refuse_closed(i, gap, level);
}

auto PiecewiseMotion::Builder::search(const std::vector<double>& level,
                                      const std::vector<double>& from, double to) const
    -> std::vector<Closing> {
  std::vector<Closing> closings;
  double until = to;
  for (std::size_t i = 0; i < springs(); ++i) {
    const auto gap = [&](double s) { return gap_ahead(i, s); };
    const auto error = [&](double s) { return gap_error(i, m_.covariance_after(flight(), s), s); };
    const auto found = first_crossing(gap, error, level[i], from[i], until, most_search_steps);
    const double t = flight().t + found.s;
    switch (found.status) {
      case Crossing::Status::none:
        break;
      case Crossing::Status::undecided:
        refuse_length();
      case Crossing::Status::uncertain:
        refuse_graze(i, t, found.gap, found.error);
      case Crossing::Status::certain: {
        const double rate = std::abs(gap(found.s).slope);
        closings.push_back({i, found.s, found.error, found.error / rate + 4.0 * epsilon * t});
        until = std::min(until, closings.back().last());
      }
    }
  }
  // Those up to `to` at most; the window that follows has the others.
  std::erase_if(closings, [&](const Closing& c) { return c.s > to; });
  std::ranges::stable_sort(closings, {}, &Closing::s);
  if (closings.size() > 1)
    for (Closing& closing : closings) {
      const double before = closing.gap_error;
      closing.gap_error =
          gap_error(closing.contact, m_.covariance_after(flight(), closing.s), closing.s);
      closing.time_error *= closing.gap_error / before;
      closing.time_error += 4.0 * epsilon * (flight().t + closing.s);
    }
  return closings;
}

double PiecewiseMotion::Builder::highest_force() const {
  double most = 0.0;
  for (const auto& force : modes().forces()) most = std::max(most, force.frequency);
  return most;
}

void PiecewiseMotion::Builder::refuse_graze(std::size_t i, double t, double gap,
                                            double error) const {
  throw InputError(
      fmt::format(
          "{}: contact {} comes within {:.3g} m near t = {:.9g} s without a certain impact, "
          "and the error there is {:.3g} m; allowed: motions whose impacts are certain. "
          "Change the gap by more, or end the run earlier.",
          m_.who_, i + 1, std::abs(gap), t, error),
      "not-admissible");
}

void PiecewiseMotion::Builder::refuse_closed(std::size_t i, const numerics::LocalBound& gap,
                                             double level) const {
  const double t = flight().t, eta = problem_.contacts[i].restitution;
  const double speed_size = modes().bound(row(i).rate(), modes().sizes(flight().free, 0.0));
  const bool is_pressed = gap.second < -touching_share * gap.curvature;
  if (!(gap.slope > touching_share * speed_size))
    throw InputError(
        fmt::format("{}: contact {} {} from t = {:.9g} s on; allowed: contacts that open again at "
                    "once, since sliding and resting contact are not supported. {}.",
                    m_.who_, i + 1, is_pressed ? "stays closed" : "touches at rest", t,
                    t == 0.0 ? "Start with the contact open"
                             : "Give restitutions above 0, or end the run earlier"),
        "not-admissible");
  if (is_pressed && eta < 1.0)
    throw InputError(
        fmt::format("{}: impacts of contact {} accumulate at t = {:.9g} s, where it comes to rest; "
                    "allowed: impacts that rounding can separate. End the run earlier.",
                    m_.who_, i + 1, t + 2.0 * gap.slope / (-gap.second * (1.0 - eta))),
        "not-admissible");
  refuse_graze(i, t, is_pressed ? -0.5 * gap.slope * gap.slope / gap.second : gap.value, level);
}

}  // namespace clackers::exact
