#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/methods/integrator.hpp"
#include "clackers/methods/stepping/step_plan.hpp"

namespace clackers::methods {

/// Which impacts a run cannot tell apart. Contacts that share a mass and close at one instant are one
/// impact; the errors of a run close them one after the other, and impacts one by one have another
/// outcome. Contact i closes together with contact j, which closes now, if it closes within
///
///     10 max(e_i / |U_i|, e_j / |U_j|),   e_i = n sum_k |b_ik| (d_k + T_k w_k)
///
/// and within a step, U the gap rate; so does one that is coupled with it in turn. e estimates the error
/// of a gap: n steps so far with the errors d_k and w_k of one step in u_k and v_k; T_k is the time in
/// which the one becomes the other, |u_k| over |v_k| or the length of the flight. The errors of a step
/// are the differences from two half steps, over eight steps, the largest from three states of the last
/// flight: at a single phase the leading error may vanish. Of an adaptive integrator they are its
/// tolerance.
///
/// The time tends to 0 with the errors of the integrator: impacts that are apart stay so for small steps.
template <int Dof>
class ImpactResolution {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  /// The spread of simultaneous impacts was at most 2.2 times the estimate, with every integrator.
  static constexpr double safety = 10.0;

  /// The contacts must outlive it.
  ImpactResolution(ContactSet<Dof>& contacts, const StepPlan& plan, const State& start);

  /// A run begins.
  void begin(const State& from) {
    steps_ = 0;
    begin_flight(from);
  }
  /// What was kept of the flight before no longer holds.
  void begin_flight(const State& from) {
    if (!is_needed_) return;
    kept_.fill(from);
    flight_ = 0;
  }
  /// `count` steps, from the states before(0), before(1), ...
  void pass(std::size_t count, auto&& before) {
    if (!is_needed_) return;
    steps_ += static_cast<long long>(count);
    for (auto next = std::bit_ceil(flight_ + 1); next <= flight_ + count; next *= 2) {
      kept_[1] = kept_[2];
      kept_[2] = before(next - flight_ - 1);
    }
    flight_ += count;
  }

  /// Adds to `closed`, ascending, the contacts that close together with `first`, which is one of
  /// them. Contacts whose rows depend linearly on those are left out. Restarts the stepper elsewhere.
  void add_to(std::vector<std::size_t>& closed, std::size_t first, const State& now,
              AnyStepper<Dof>& stepper);

 private:
  bool closes(std::size_t i, const std::vector<std::size_t>& closed, const State& now,
              double within) const;
  void estimate(const State& now, AnyStepper<Dof>& stepper);
  void step_errors(const State& from, AnyStepper<Dof>& stepper);
  double time_error(std::size_t i, const State& now) const;

  static constexpr int most_steps = 8;

  ContactSet<Dof>& contacts_;
  StepPlan plan_;
  bool is_needed_ = false;     // some contacts are coupled
  std::array<State, 3> kept_;  // start of the flight, and its states after 2^k steps
  std::array<State, most_steps + 1> states_;
  State halves_;
  Vector d_, w_, e_;  // errors of a step, and of the run
  long long steps_ = 0;
  std::size_t flight_ = 0;
};

extern template class ImpactResolution<1>;
extern template class ImpactResolution<2>;
extern template class ImpactResolution<model::any_dof>;

}  // namespace clackers::methods
