// Linear functions of a flight: what they are, where they go, and what bounds them.
#include <cmath>
#include <complex>

#include "clackers/base/constants.hpp"
#include "clackers/exact/flights/forced_modes.hpp"

namespace clackers::exact {

using Eigen::Index;
using Vector = ForcedModes::Vector;
using Complex = std::complex<double>;

auto ForcedModes::observe(const Vector& on_u, const Vector& on_v, const Vector& on_a,
                          const Vector& on_load, double constant) const -> Observable {
  Observable seen;
  Vector row = this->row(0, on_u) + this->row(1, on_v) + this->row(2, on_a);
  seen.size = row_of_sizes(0, on_u) + row_of_sizes(1, on_v) + row_of_sizes(2, on_a);
  seen.by_state.resize(row.size(), 5);
  for (int order = 0; order < 5; ++order, row = derived(row)) seen.by_state.col(order) = row;
  seen.constant = constant + on_u.dot(offset_);
  seen.constant_size = std::abs(constant) + on_u.cwiseAbs().dot(offset_.cwiseAbs());
  seen.form = {system_, seen.by_state.col(0), seen.constant};
  for (const auto& force : forces_) {
    seen.response.push_back(seen.by_state.col(0).cast<Complex>().dot(force.steady) +
                            on_a.cast<Complex>().dot(force.acceleration) +
                            on_load.cast<Complex>().dot(force.applied));
    seen.direct_size.push_back(on_a.cwiseAbs().dot(force.acceleration.cwiseAbs()) +
                               on_load.cwiseAbs().dot(force.applied.cwiseAbs()));
  }
  if (is_precise()) observe_precisely(on_u, on_a, on_load, constant, seen);
  return seen;
}

std::vector<numerics::ModalState> ForcedModes::states(const Vector& free) {
  const Index n = free.size() / 2;
  std::vector<numerics::ModalState> states;
  for (Index j = 0; j < n; ++j) states.push_back({free[j], free[n + j]});
  return states;
}

void ForcedModes::look_ahead(numerics::FormAhead& to, const Observable& seen,
                             std::span<const numerics::ModalState> free, double t,
                             double sign) const {
  to.begin(system_, seen.form, free, sign, push_);
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    to.add(seen.response[i] * std::polar(1.0, forces_[i].frequency * t), forces_[i].frequency);
    for (const auto& [j, beat, y, rate] : forces_[i].resonances) {
      const double on_y = seen.by_state(j, 0), on_rate = seen.by_state(dof() + j, 0);
      to.add(beat, {on_y * y.e + on_rate * rate.e, on_y * y.r + on_rate * rate.r}, t);
    }
  }
}

numerics::LocalBound ForcedModes::now(const Observable& seen, const Vector& free, double t) const {
  numerics::FormAhead ahead;
  look_ahead(ahead, seen, states(free), t);
  return ahead.whole(0.0);
}

double ForcedModes::fourth_bound(const Observable& seen, const Vector& free, double horizon) const {
  double most = bound(seen.by_state.col(4), sizes(free, horizon));
  for (std::size_t j = 0; j < push_.size(); ++j)
    most += std::abs(seen.by_state(Index(j), 3) * push_[j].y) +
            std::abs(seen.by_state(dof() + Index(j), 3) * push_[j].rate);
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    most += std::pow(forces_[i].frequency, 4) * std::abs(seen.response[i]);
    for (const auto& [j, beat, y, rate] : forces_[i].resonances) {
      auto there = y, moves = rate;
      for (int order = 0; order < 4; ++order)
        there = there.derivative(beat), moves = moves.derivative(beat);
      most += std::abs(seen.by_state(j, 0)) * there.bound(beat.most(horizon)) +
              std::abs(seen.by_state(dof() + j, 0)) * moves.bound(beat.most(horizon));
    }
  }
  return most;
}

double ForcedModes::rounding(const Observable& seen, const Sizes& size, double t) const {
  double whole = seen.constant_size + bound(seen.size, size);
  for (std::size_t i = 0; i < forces_.size(); ++i)
    whole += (1.0 + forces_[i].frequency * t) *
             (seen.direct_size[i] + seen.size.dot(forces_[i].sizes(t)));
  return epsilon * double(mass_.rows() + 4) * whole;
}

}  // namespace clackers::exact
