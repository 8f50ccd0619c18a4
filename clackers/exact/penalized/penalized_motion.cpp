#include "clackers/exact/penalized/penalized_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/numerics/linear_algebra.hpp"
#include "clackers/numerics/modal_flight.hpp"
#include "clackers/numerics/roots.hpp"

namespace clackers::exact {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr const char* penalized_name = "penalized motion";
constexpr std::size_t most_contacts = 1000000;

void require_kind(const model::ImpactProblem<>& problem) {
  validate(problem);
  if (problem.system.add_load || problem.system.nonlinear)
    refuse(penalized_name, "system", "with a load or a nonlinear force", "linear, without a load",
           {}, "linear-only");
  if (problem.start.t != 0.0) refuse(penalized_name, "start", problem.start.t, "0 s");
  if (problem.contacts.size() != 1)
    refuse(penalized_name, "contacts", double(problem.contacts.size()), "one");
  if (problem.contacts[0].restitution != 1.0)
    refuse(penalized_name, "restitution", problem.contacts[0].restitution,
           "1, since a linear spring is elastic", {}, "penalty-needs-elastic");
}

}  // namespace

PenalizedMotion::PenalizedMotion(const model::ImpactProblem<>& problem, double stiffness)
    : system_(problem.system),
      start_(problem.start),
      end_(problem.end),
      stiffness_(require_positive(penalized_name, "stiffness", stiffness)) {
  require_kind(problem);
  contact_ = problem.contacts[0];
  sigma_ = 0.5 * system_.damping(0, 0) / system_.mass(0, 0);
  const MatrixXd other = system_.damping - 2.0 * sigma_ * system_.mass;
  // c and m are each rounded once where the caller means the same sigma.
  if (!(other.cwiseAbs().maxCoeff() <= 8.0 * epsilon * system_.damping.cwiseAbs().maxCoeff()))
    refuse(penalized_name, "damping", "not proportional to the mass", "C = 2 sigma M");
  regimes_[0] = regime(false);
  regimes_[1] = regime(true);
  shortest_step_ = 1e-6 / std::max(regimes_[0].omega.maxCoeff(), regimes_[1].omega.maxCoeff());

  phases_.push_back(begin(start_.t, false, start_.u, start_.v));
  phases_[0].error_covariance = MatrixXd::Zero(2 * dof(), 2 * dof());
  VectorXd y, rate;
  while (const auto s = phase_end(phases_.back())) {
    const Phase& now = phases_.back();
    const double t = now.t + *s;
    if (t > end_) break;
    if (phases_.size() > 2 * most_contacts)
      refuse(penalized_name, "end", end_, "as many seconds as 1e6 contacts take");
    modes(now, t - now.t, y, rate);
    const auto& regime = of(now);
    auto next =
        begin(t, !now.closed, regime.static_displacement + regime.shapes * y, regime.shapes * rate);
    next.error_covariance = error_after(now, t - now.t);
    if (next.closed) contacts_.push_back(phases_.size());
    phases_.push_back(std::move(next));
  }
}

PenalizedMotion::Regime PenalizedMotion::regime(bool closed) const {
  Regime made;
  made.stiffness = system_.stiffness;
  made.static_displacement = VectorXd::Zero(dof());
  const auto& b = contact_.direction;
  if (closed) {
    made.stiffness += stiffness_ * b * b.transpose();
    made.static_displacement = numerics::solved(made.stiffness, stiffness_ * contact_.gap * b);
  }
  const auto modes = numerics::normal_modes(made.stiffness, system_.mass).value();
  made.shapes = modes.shapes;
  const auto& squares = modes.squares;
  const double slowest = squares.minCoeff() - sigma_ * sigma_;
  if (!(slowest > 0.0))
    refuse(penalized_name, "square of the slowest damped frequency", slowest, "more than 0",
           "Every mode must be underdamped.");
  made.omega = squares.cwiseSqrt();
  made.w = (squares.array() - sigma_ * sigma_).sqrt();
  made.gap_shape = made.shapes.transpose() * b;
  // Eigenvalues of a full matrix have the absolute error of the largest, of which omega has half the
  // relative one.
  const bool uncoupled =
      numerics::is_diagonal(made.stiffness) && numerics::is_diagonal(system_.mass);
  made.omega_error = VectorXd::Constant(dof(), 4.0 * epsilon);
  if (!uncoupled)
    made.omega_error = made.omega_error.array() * squares.maxCoeff() / squares.array();
  return made;
}

PenalizedMotion::Phase PenalizedMotion::begin(double t, bool closed, const VectorXd& u,
                                              const VectorXd& v) const {
  Phase made;
  made.t = t;
  made.closed = closed;
  const auto& regime = of(made);
  made.p = regime.shapes.transpose() * (system_.mass * (u - regime.static_displacement));
  const VectorXd rate = regime.shapes.transpose() * (system_.mass * v);
  made.q = (rate + sigma_ * made.p).cwiseQuotient(regime.w);
  return made;
}

void PenalizedMotion::modes(const Phase& phase, double s, VectorXd& y, VectorXd& rate) const {
  const auto& regime = of(phase);
  const double decay = std::exp(-sigma_ * s);
  y.resize(dof());
  rate.resize(dof());
  for (Eigen::Index j = 0; j < dof(); ++j) {
    const double cosine = std::cos(regime.w[j] * s), sine = std::sin(regime.w[j] * s);
    y[j] = decay * (phase.p[j] * cosine + phase.q[j] * sine);
    rate[j] = decay * regime.w[j] * (phase.q[j] * cosine - phase.p[j] * sine) - sigma_ * y[j];
  }
}

std::pair<double, double> PenalizedMotion::signed_gap(const Phase& phase, double s) const {
  VectorXd y, rate;
  modes(phase, s, y, rate);
  const auto& regime = of(phase);
  const double sign = phase.closed ? -1.0 : 1.0;
  return {sign * (contact_.gap_at(regime.static_displacement) + regime.gap_shape.dot(y)),
          sign * regime.gap_shape.dot(rate)};
}

std::optional<double> PenalizedMotion::phase_end(const Phase& phase) const {
  const auto& regime = of(phase);
  double bound = 0.0;
  for (Eigen::Index j = 0; j < dof(); ++j)
    bound += std::abs(regime.gap_shape[j]) * std::hypot(phase.p[j], phase.q[j]) * regime.omega[j] *
             regime.omega[j];
  if (!(bound > 0.0)) return std::nullopt;  // rests for ever
  double s = 0.0;
  auto [value, slope] = signed_gap(phase, 0.0);
  value = std::max(value, 0.0);  // a phase starts at 0, give or take a rounding
  while (phase.t + s <= end_) {
    const double root = std::sqrt(slope * slope + 2.0 * bound * value);
    // Both forms of the parabola's zero; neither subtracts.
    const double safe = slope > 0.0 ? (slope + root) / bound : 2.0 * value / (root - slope);
    const double next = s + (safe > shortest_step_ ? safe : shortest_step_);
    const auto [new_value, new_slope] = signed_gap(phase, next);
    if (new_value < 0.0) {
      const auto sign = [&](double x) { return signed_gap(phase, x).first; };
      return numerics::shrink(sign, {s, value, next, new_value}, epsilon * (phase.t + next)).b;
    }
    s = next;
    value = new_value;
    slope = new_slope;
  }
  return std::nullopt;
}

std::size_t PenalizedMotion::phase_at(double t) const {
  model::require_inside(penalized_name, t, end_);
  const auto after = std::ranges::upper_bound(phases_, t, {}, &Phase::t);
  return after == phases_.begin() ? 0 : static_cast<std::size_t>(after - phases_.begin()) - 1;
}

void PenalizedMotion::sample(std::span<const double> times, model::Side,
                             model::SampleBuffers out) const {
  const auto n = static_cast<std::size_t>(dof());
  model::require_buffers(penalized_name, out, times.size(), n);
  VectorXd y, rate;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Phase& phase = phases_[phase_at(times[i])];
    const auto& regime = of(phase);
    modes(phase, times[i] - phase.t, y, rate);
    Eigen::Map<VectorXd> u(out.u.data() + i * n, dof()), v(out.v.data() + i * n, dof());
    u = regime.static_displacement;
    u.noalias() += regime.shapes * y;
    v.noalias() = regime.shapes * rate;
    if (out.a.empty()) continue;
    Eigen::Map<VectorXd> a(out.a.data() + i * n, dof());
    a = -2.0 * sigma_ * v;
    a.noalias() -= regime.shapes * (regime.omega.cwiseAbs2().cwiseProduct(y));
  }
}

}  // namespace clackers::exact
