#include "clackers/tables/times/energy_balance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/model/harmonic_load.hpp"

namespace clackers::tables {

using Eigen::VectorXd;
using model::Side;

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
  integrate(test_case, until);
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

void EnergyBalance::integrate(const cases::Case& test_case, double until) {
  const auto& system = problem_.system;
  if (system.damping.isZero(0.0) && problem_.frictions.empty() && !has_work()) return;
  const auto peak = motion_.peak();
  const double largest = 0.5 * (peak.v.dot(system.mass.cwiseAbs() * peak.v) +
                                peak.u.dot(system.stiffness.cwiseAbs() * peak.u)) +
                         constant_.cwiseAbs().dot(peak.u);
  std::vector<double> breaks;
  for (const auto& loss : losses_) breaks.push_back(loss.t);
  flow_.emplace(
      test_case, [this](double t, Side side) { return VectorXd(rate(t, side)); }, breaks, until,
      Flow::Constant(largest));
}

auto EnergyBalance::rate(double t, Side side) const -> Flow {
  const auto& system = problem_.system;
  const auto now = motion_.at(t, side);
  Flow flow = Flow::Zero();
  VectorXd force = constant_;
  if (varying_) varying_(t, {force.data(), std::size_t(force.size())});
  flow[work] = (force - constant_).dot(now.v);
  flow[dissipated] = now.v.dot(system.damping * now.v);
  if (!problem_.frictions.empty()) {
    const auto forces = motion_.contact_forces(t, side);
    for (std::size_t j = 0; j < problem_.frictions.size(); ++j) {
      const auto& row = problem_.frictions[j];
      const double normal = row.contact ? forces[Eigen::Index(*row.contact)] : 1.0;
      flow[dissipated] += row.kinetic * normal * std::abs(row.sliding_speed(now.v));
      flow[work] += forces[Eigen::Index(problem_.contacts.size() + j)] * row.velocity;
    }
  }
  return flow;
}

exact::EnergySplit EnergyBalance::at(double t, Side side) const {
  const auto now = motion_.at(t, side);
  const Flow flow = flow_ ? Flow(flow_->at(t)) : Flow::Zero();
  const auto next = side == Side::left ? std::ranges::lower_bound(losses_, t, {}, &Loss::t)
                                       : std::ranges::upper_bound(losses_, t, {}, &Loss::t);
  exact::EnergySplit split;
  split.kinetic = energy_.kinetic(now.v.data());
  split.potential = energy_.potential(now.u.data()) - constant_.dot(now.u);
  split.dissipated = flow[dissipated];
  split.lost = next == losses_.begin() ? 0.0 : (next - 1)->sum;
  split.work = flow[work];
  return split;
}

double EnergyBalance::momentum(double t, Side side) const {
  return problem_.system.mass.colwise().sum().dot(motion_.at(t, side).v);
}

}  // namespace clackers::tables
