#include "clackers/methods/contact/impact_resolution.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::methods {

template <int Dof>
ImpactResolution<Dof>::ImpactResolution(ContactSet<Dof>& contacts, const StepPlan& plan,
                                        const State& start)
    : contacts_(contacts), plan_(plan), halves_(start), d_(start.u), w_(d_), e_(d_) {
  kept_.fill(start);
  states_.fill(start);
  for (std::size_t i = 0; i < contacts.size() && !is_needed_; ++i)
    for (std::size_t j = 0; j < i && !is_needed_; ++j) is_needed_ = contacts.are_coupled(i, j);
}

template <int Dof>
void ImpactResolution<Dof>::add_to(std::vector<std::size_t>& closed, std::size_t first,
                                   const State& now, AnyStepper<Dof>& stepper) {
  if (!is_needed_) return;
  // An adaptive step may be as long as the flight.
  const double step = plan_.is_adaptive() ? (now.t - kept_[0].t) / double(flight_ + 1) : plan_.h;
  std::size_t near = 0;
  while (near < contacts_.size() && !closes(near, closed, now, step)) ++near;
  if (near == contacts_.size()) return;
  estimate(now, stepper);
  const double of_first = time_error(first, now);
  const auto is_together = [&](std::size_t i) {
    const double error = std::max(of_first, time_error(i, now));
    return closes(i, closed, now, std::min(step, safety * error));
  };
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (!is_together(i)) continue;
      const auto place = closed.insert(std::ranges::lower_bound(closed, i), i);
      // Impulses of dependent rows are not unique: then one by one.
      if (contacts_.redundancy(closed))
        closed.erase(place);
      else
        is_changed = true;
    }
  }
}

// Whether contact i, still open, is coupled with one of `closed` and closes `within` [s].
template <int Dof>
bool ImpactResolution<Dof>::closes(std::size_t i, const std::vector<std::size_t>& closed,
                                   const State& now, double within) const {
  const double rate = contacts_.gap_rate(i, now.v);
  if (!(rate < -contacts_.rate_rounding(i, now.v)) || contacts_.gap(i, now.u) > -rate * within ||
      std::ranges::binary_search(closed, i))
    return false;
  return std::ranges::any_of(closed, [&](std::size_t j) { return contacts_.are_coupled(i, j); });
}

template <int Dof>
void ImpactResolution<Dof>::estimate(const State& now, AnyStepper<Dof>& stepper) {
  d_.setZero();
  w_.setZero();
  if (!plan_.is_adaptive())
    for (const auto& state : kept_) step_errors(state, stepper);
  Vector &u = halves_.u, &v = halves_.v;  // amplitudes
  u = now.u.cwiseAbs();
  v = now.v.cwiseAbs();
  for (const auto& state : kept_) {
    u = u.cwiseMax(state.u.cwiseAbs());
    v = v.cwiseMax(state.v.cwiseAbs());
  }
  if (plan_.is_adaptive()) {
    d_.array() += plan_.tolerance * u.maxCoeff();
    w_.array() += plan_.tolerance * v.maxCoeff();
  }
  const double flight = now.t - kept_[0].t;
  for (Eigen::Index k = 0; k < e_.size(); ++k) {
    const double turn = u[k] < flight * v[k] ? u[k] / v[k] : flight;
    e_[k] = double(steps_ + 1) * (d_[k] + turn * w_[k]);
  }
}

// The largest so far. Multistep methods start with another one, and make these steps only with it.
template <int Dof>
void ImpactResolution<Dof>::step_errors(const State& from, AnyStepper<Dof>& stepper) {
  const auto k = std::llround((from.t - plan_.start) / plan_.h);
  double h = std::min(plan_.h, plan_.end - from.t);
  int count = 1;
  stepper.restart(from);
  if (plan_.time(k) == from.t && k + most_steps <= plan_.whole) {
    count = most_steps;
    states_[0] = from;
    stepper.advance(k, states_);
  } else if (h > 0.0) {
    states_[most_steps] = stepper.partial(from, h);
  } else {
    return;
  }
  halves_ = from;
  for (int i = 0; i < 2 * count; ++i) {
    stepper.restart(halves_);
    halves_ = stepper.partial(halves_, 0.5 * h);
  }
  const auto& whole = states_[most_steps];
  d_ = d_.cwiseMax((whole.u - halves_.u).cwiseAbs() / count);
  w_ = w_.cwiseMax((whole.v - halves_.v).cwiseAbs() / count);
}

template <int Dof>
double ImpactResolution<Dof>::time_error(std::size_t i, const State& now) const {
  return contacts_.row(i).cwiseAbs().dot(e_) / -contacts_.gap_rate(i, now.v);
}

template class ImpactResolution<1>;
template class ImpactResolution<2>;
template class ImpactResolution<model::any_dof>;

}  // namespace clackers::methods
