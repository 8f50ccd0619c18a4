#include "clackers/methods/stepping/adaptive_stepper.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace clackers::methods {
namespace {

constexpr double safety = 0.9, most_growth = 10.0, most_shrinking = 0.2;

double largest(const auto& x) { return x.cwiseAbs().maxCoeff(); }

// 0 where there is nothing to divide by.
double over(double x, double scale) { return scale > 0.0 ? x / scale : 0.0; }

}  // namespace

template <int Dof>
AdaptiveStepper<Dof>::AdaptiveStepper(const EmbeddedPair& pair,
                                      const model::SmoothSystem<Dof>& system, const StepPlan& plan)
    : pair_(pair),
      plan_(plan),
      equation_(system),
      u_(Vector::Zero(system.dof())),
      v_(u_),
      sum_(u_) {
  rate_u_.fill(u_);
  rate_v_.fill(u_);
  dense_u_.fill(u_);
  dense_v_.fill(u_);
  part_.u = part_.v = u_;
}

template <int Dof>
void AdaptiveStepper<Dof>::reset() {
  equation_.set_tally({});
  control_ = {};
  failed_ = false;
}

template <int Dof>
void AdaptiveStepper<Dof>::evaluate(std::size_t i, double t, const Vector& u, const Vector& v) {
  rate_u_[i] = v;
  equation_.accelerate(t, u, v, rate_v_[i]);
}

template <int Dof>
void AdaptiveStepper<Dof>::restart(const State& from) {
  evaluate(0, from.t, from.u, from.v);
  is_at_end_ = has_dense_ = false;
  control_.error = 1e-4;
  if (control_.h == 0.0) control_.h = first_step(from);
}

template <int Dof>
double AdaptiveStepper<Dof>::first_step(const State& from) {
  const double u = largest(from.u), v = largest(from.v), a = largest(rate_v_[0]);
  const double rate = std::max(over(v, u), over(a, v));
  const double length = plan_.end - from.t;
  // The rates of a state that is rounding say nothing.
  const double least = 1e-6 * length, guess = std::clamp(over(0.01, rate), least, length);
  u_ = from.u + guess * rate_u_[0];
  v_ = from.v + guess * rate_v_[0];
  const double u_scale = std::max(u, largest(u_)), v_scale = std::max(v, largest(v_));
  evaluate(1, from.t + guess, u_, v_);
  const double bend =
      std::max(over(a, u_scale), over(largest((rate_v_[1] - rate_v_[0]).eval()) / guess, v_scale));
  const double second = std::max({over(v, u_scale), over(a, v_scale), std::sqrt(bend)});
  if (!(second > 0.0)) return guess;
  const double h = std::pow(0.01 * plan_.tolerance, 1.0 / pair_.error_order) / second;
  return std::min({100.0 * guess, std::max(h, least), length});
}

// The error of a step over the tolerance; `scales` are raised by its end.
template <int Dof>
double AdaptiveStepper<Dof>::attempt(const State& x, double t1, State& y, Control& scales) {
  const double h = t1 - x.t;
  const auto last = std::size_t(pair_.stages);
  for (std::size_t i = 1; i <= last; ++i) {
    u_ = x.u;
    v_ = x.v;
    for (std::size_t j = 0; j < i; ++j)
      if (const double weight = h * pair_.a[i][j]; weight != 0.0) {
        u_ += weight * rate_u_[j];
        v_ += weight * rate_v_[j];
      }
    evaluate(i, i == last ? t1 : x.t + pair_.c(i) * h, u_, v_);
  }
  y.t = t1;
  y.u = u_;
  y.v = v_;
  scales.u_scale = std::max(scales.u_scale, largest(y.u));
  scales.v_scale = std::max(scales.v_scale, largest(y.v));
  // The mean square of an estimate over tolerance and scale.
  const auto square = [&](const EmbeddedPair::Row& weights) {
    double total = 0.0;
    const auto add = [&](const auto& rates, double scale) {
      sum_.setZero();
      for (std::size_t j = 0; j <= last; ++j)
        if (weights[j] != 0.0) sum_ += weights[j] * rates[j];
      const double size = sum_.norm();
      if (size != 0.0) total += std::pow(h * size / (plan_.tolerance * scale), 2);
    };
    add(rate_u_, scales.u_scale);
    add(rate_v_, scales.v_scale);
    return total / (2.0 * double(sum_.size()));
  };
  const double error = square(pair_.error);
  if (pair_.error_3[0] == 0.0) return std::sqrt(error);
  return error > 0.0 ? error / std::sqrt(error + 0.01 * square(pair_.error_3)) : error;
}

template <int Dof>
bool AdaptiveStepper<Dof>::step(const State& x, State& y) {
  if (is_at_end_) {
    rate_u_[0].swap(rate_u_[std::size_t(pair_.stages)]);
    rate_v_[0].swap(rate_v_[std::size_t(pair_.stages)]);
  }
  is_at_end_ = has_dense_ = false;
  const double power = 0.85 / pair_.error_order, memory = 0.2 / pair_.error_order;
  for (double growth = most_growth;; growth = 1.0) {
    const bool is_last = x.t + 1.01 * control_.h >= plan_.end;
    const double t1 = is_last ? plan_.end : x.t + control_.h;
    const double latest = std::max(std::abs(x.t), std::abs(t1));
    if (!is_last && !(control_.h > 4.0 * std::numeric_limits<double>::epsilon() * latest)) {
      y = x;
      failed_ = true;
      return false;
    }
    Control next = control_;
    const double error = attempt(x, t1, y, next);
    const double h = t1 - x.t;
    if (!(error <= 1.0)) {
      const double factor = safety * std::pow(error, -1.0 / pair_.error_order);
      control_.h = h * (factor > most_shrinking ? factor : most_shrinking);
      continue;
    }
    const double factor = error > 0.0
                              ? safety * std::pow(error, -power) * std::pow(control_.error, memory)
                              : most_growth;
    next.h = h * std::clamp(factor, most_shrinking, growth);
    next.error = std::max(error, 1e-4);
    control_ = next;
    length_ = h;
    is_at_end_ = true;
    return true;
  }
}

template <int Dof>
std::size_t AdaptiveStepper<Dof>::advance(long long, std::span<State> states) {
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (states[i - 1].t == plan_.end) return i - 1;
    marks_[i - 1] = {control_, equation_.tally()};
    if (!step(states[i - 1], states[i])) return i;
  }
  return states.size() - 1;
}

template <int Dof>
void AdaptiveStepper<Dof>::rewind(long long, std::span<const State> states, std::size_t steps) {
  const State& from = states[steps];
  equation_.set_tally({});
  evaluate(0, from.t, from.u, from.v);
  equation_.set_tally(marks_[steps].tally);
  control_ = marks_[steps].control;
  failed_ = is_at_end_ = false;
  if (from.t != plan_.end) step(from, part_);
  is_at_end_ = false;
  control_ = marks_[steps].control;
}

template <int Dof>
void AdaptiveStepper<Dof>::prepare_dense(const State& x) {
  const double h = length_;
  const auto last = std::size_t(pair_.stages);
  for (std::size_t i = last + 1; i <= last + std::size_t(pair_.dense_stages); ++i) {
    u_ = x.u;
    v_ = x.v;
    for (std::size_t j = 0; j < i; ++j) {
      u_ += h * pair_.a[i][j] * rate_u_[j];
      v_ += h * pair_.a[i][j] * rate_v_[j];
    }
    evaluate(i, x.t + pair_.c(i) * h, u_, v_);
  }
  const auto fill = [&](const auto& rates, auto& dense) {
    dense[0].setZero();
    for (std::size_t j = 0; j < last; ++j) dense[0] += h * pair_.a[last][j] * rates[j];
    dense[1] = h * rates[0] - dense[0];
    dense[2] = 2.0 * dense[0] - h * (rates[0] + rates[last]);
    for (std::size_t m = 0; m < std::size_t(pair_.dense_rows); ++m) {
      dense[3 + m].setZero();
      for (std::size_t j = 0; j <= last + std::size_t(pair_.dense_stages); ++j)
        dense[3 + m] += h * pair_.dense[m][j] * rates[j];
    }
  };
  fill(rate_u_, dense_u_);
  fill(rate_v_, dense_v_);
  has_dense_ = true;
}

template <int Dof>
const model::State<Dof>& AdaptiveStepper<Dof>::partial(const State& from, double s) {
  assert(!is_at_end_ && length_ > 0.0);
  if (!has_dense_) prepare_dense(from);
  const double r = s / length_;
  const auto value = [&](const auto& dense, Vector& x) {
    x.setZero();
    for (int m = 2 + pair_.dense_rows; m >= 0; --m)
      x = (m % 2 == 0 ? r : 1.0 - r) * (dense[std::size_t(m)] + x);
  };
  part_.t = from.t + s;
  value(dense_u_, part_.u);
  value(dense_v_, part_.v);
  part_.u += from.u;
  part_.v += from.v;
  return part_;
}

template class AdaptiveStepper<1>;
template class AdaptiveStepper<2>;
template class AdaptiveStepper<model::any_dof>;

}  // namespace clackers::methods
