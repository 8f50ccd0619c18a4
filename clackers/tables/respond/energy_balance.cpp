#include "clackers/tables/respond/energy_balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "clackers/base/constants.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::tables {

using Eigen::VectorXd;
using model::Side;

namespace {

// Lobatto's rule of ten points on [-1, 1], exact up to degree 17; a bend beside an end is seen from the end.
constexpr std::array<double, 10> nodes{-1.0,
                                       -0.9195339081664589,
                                       -0.7387738651055050,
                                       -0.4779249498104445,
                                       -0.1652789576663870,
                                       0.1652789576663870,
                                       0.4779249498104445,
                                       0.7387738651055050,
                                       0.9195339081664589,
                                       1.0};
constexpr std::array<double, 5> weights{1.0 / 45.0, 0.1333059908510701, 0.2248893420631264,
                                        0.2920426836796838, 0.3275397611838976};

// No more are halved: where states are less smooth than rounding explains, the total shows what is left out.
constexpr std::size_t most_intervals = 1'000'000;

}  // namespace

EnergyBalance::EnergyBalance(const cases::Case& test_case, double until)
    : problem_(test_case.problem),
      motion_(*test_case.motion),
      energy_(problem_.system),
      constant_(VectorXd::Zero(motion_.dof())),
      varying_(problem_.system.add_load) {
  if (const auto* load = varying_.target<model::HarmonicLoad>()) {
    std::vector<model::HarmonicForce> others;
    for (const auto& f : load->forces()) {
      if (f.frequency == 0.0)
        constant_[f.dof] += f.amplitude * std::cos(f.phase);
      else
        others.push_back(f);
      fastest_ = std::max(fastest_, f.frequency);
    }
    if (others.empty())
      varying_ = {};
    else
      varying_ = model::HarmonicLoad(std::move(others));
  }
  work_of_loads_ = bool(varying_);
  work_of_belts_ =
      std::ranges::any_of(problem_.frictions, [](const auto& row) { return row.velocity != 0.0; });
  add_losses();
  integrate(until);
}

// Impacts of one instant have the energies before and after all of them. Those that accumulate and are not resolved
// are one loss, where the motion takes the contact for closed.
void EnergyBalance::add_losses() {
  const auto count = motion_.impact_count(motion_.end());
  for (long long k = 1; k <= count; ++k) {
    const auto impact = motion_.impact(k);
    if (losses_.empty() || impact.t != losses_.back().t)
      losses_.push_back({impact.t, impact.energy_before - impact.energy_after});
  }
  for (const auto& closed : motion_.closed_contacts()) {
    const auto place = std::ranges::lower_bound(losses_, closed.resolved, {}, &Loss::t);
    if (!closed.accumulates || (place != losses_.end() && place->t == closed.resolved)) continue;
    const auto total = [&](Side side) {
      const auto now = motion_.at(closed.resolved, side);
      return energy_.total(now.u.data(), now.v.data()) - constant_.dot(now.u);
    };
    losses_.insert(place, {closed.resolved, total(Side::left) - total(Side::right)});
  }
  double sum = 0.0;
  for (auto& loss : losses_) loss.sum = sum += loss.sum;
}

void EnergyBalance::integrate(double until) {
  const auto& system = problem_.system;
  intervals_.push_back({});
  if (system.damping.isZero(0.0) && problem_.frictions.empty() && problem_.unstated.empty() &&
      !has_work())
    return;
  fastest_ = std::max(
      {fastest_, std::sqrt(std::max(0.0, numerics::highest_square(system.stiffness, system.mass))),
       numerics::highest_square(system.damping, system.mass)});
  const auto peak = motion_.peak();
  largest_ = 0.5 * (peak.v.dot(system.mass.cwiseAbs() * peak.v) +
                    peak.u.dot(system.stiffness.cwiseAbs() * peak.u)) +
             constant_.cwiseAbs().dot(peak.u);
  intervals_.clear();
  std::vector<double> list{0.0};
  for (const auto& loss : losses_)
    if (loss.t > 0.0 && loss.t < until) list.push_back(loss.t);
  list.push_back(until);
  for (std::size_t k = 0; k + 1 < list.size(); ++k) {
    const double parts = std::max(1.0, std::ceil((list[k + 1] - list[k]) * fastest_));
    double from = list[k];
    for (double part = 1.0; part <= parts; part += 1.0) {
      const double to =
          part == parts ? list[k + 1] : list[k] + (list[k + 1] - list[k]) * (part / parts);
      add(from, to, integral(from, to));
      from = to;
    }
  }
  intervals_.push_back({until, sum_});
}

// Rounding of the sum over the masses, and of the phases, which are off by epsilon times themselves.
double EnergyBalance::tolerance(double t) const {
  return epsilon * (double(motion_.dof()) + 4.0 + fastest_ * t) * largest_;
}

void EnergyBalance::add(double from, double to, const Flow& whole) {
  const double middle = from + 0.5 * (to - from), enough = tolerance(to);
  const auto left = integral(from, middle), right = integral(middle, to);
  const auto agree = [&](double Flow::*part) {
    return std::abs(left.*part + right.*part - whole.*part) <= enough;
  };
  if (intervals_.size() < most_intervals && to - from > 64.0 * epsilon * to &&
      !(agree(&Flow::dissipated) && agree(&Flow::work))) {
    add(from, middle, left);
    add(middle, to, right);
    return;
  }
  for (const auto& [start, flow] : {std::pair(from, left), std::pair(middle, right)}) {
    intervals_.push_back({start, sum_});
    sum_.dissipated += flow.dissipated;
    sum_.work += flow.work;
  }
}

auto EnergyBalance::rate(double t, Side side) const -> Flow {
  const auto& system = problem_.system;
  const auto now = motion_.at(t, side);
  Flow flow;
  VectorXd force = constant_;
  if (varying_) varying_(t, {force.data(), std::size_t(force.size())});
  flow.work = (force - constant_).dot(now.v);
  flow.dissipated = now.v.dot(system.damping * now.v);
  for (const auto& row : problem_.frictions)
    flow.dissipated += row.kinetic * std::abs(row.sliding_speed(now.v));
  if (work_of_belts_) {
    const auto forces = motion_.contact_forces(t, side);
    for (std::size_t j = 0; j < problem_.frictions.size(); ++j)
      flow.work +=
          forces[Eigen::Index(problem_.contacts.size() + j)] * problem_.frictions[j].velocity;
  }
  // What no row states is what the equation of motion leaves; contacts that stay closed do no work.
  if (!problem_.unstated.empty())
    flow.dissipated -=
        now.v.dot(system.mass * now.a + system.damping * now.v + system.stiffness * now.u - force);
  return flow;
}

auto EnergyBalance::integral(double from, double to) const -> Flow {
  const double half = 0.5 * (to - from);
  Flow sum;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double t = nodes[i] < 0.0 ? from + half * (1.0 + nodes[i]) : to - half * (1.0 - nodes[i]),
                 weight = half * weights[std::min(i, nodes.size() - 1 - i)];
    const auto now = rate(t, nodes[i] < 1.0 ? Side::right : Side::left);
    sum.dissipated += weight * now.dissipated;
    sum.work += weight * now.work;
  }
  return sum;
}

exact::EnergySplit EnergyBalance::at(double t, Side side) const {
  const auto now = motion_.at(t, side);
  auto interval = *(std::ranges::upper_bound(intervals_, t, {}, &Interval::from) - 1);
  if (intervals_.size() > 1 && interval.from < t) {
    const auto flow = integral(interval.from, t);
    interval.before.dissipated += flow.dissipated;
    interval.before.work += flow.work;
  }
  const auto next = side == Side::left ? std::ranges::lower_bound(losses_, t, {}, &Loss::t)
                                       : std::ranges::upper_bound(losses_, t, {}, &Loss::t);
  exact::EnergySplit split;
  split.kinetic = energy_.kinetic(now.v.data());
  split.potential = energy_.potential(now.u.data()) - constant_.dot(now.u);
  split.dissipated = interval.before.dissipated;
  split.lost = next == losses_.begin() ? 0.0 : (next - 1)->sum;
  split.work = interval.before.work;
  return split;
}

double EnergyBalance::momentum(double t, Side side) const {
  return problem_.system.mass.colwise().sum().dot(motion_.at(t, side).v);
}

}  // namespace clackers::tables
