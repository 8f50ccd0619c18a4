// Envelopes, error bounds and contacts of a penalized motion.
#include <fmt/format.h>

#include <cmath>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/penalized/penalized_motion.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Side;

model::Kinematics PenalizedMotion::envelope(double t) const {
  const Phase& phase = phases_[phase_at(t)];
  const auto& regime = of(phase);
  const double decay = std::exp(-sigma_ * (t - phase.t));
  const VectorXd amplitude = decay * (phase.p.cwiseAbs2() + phase.q.cwiseAbs2()).cwiseSqrt();
  const MatrixXd size = regime.shapes.cwiseAbs();
  return {regime.static_displacement.cwiseAbs() + size * amplitude,
          size * amplitude.cwiseProduct(regime.omega),
          size * amplitude.cwiseProduct(regime.omega.cwiseAbs2())};
}

// The linear map of (u - static displacement, v) over s seconds of a phase.
MatrixXd PenalizedMotion::flow(const Phase& phase, double s) const {
  const auto& regime = of(phase);
  const auto n = dof();
  MatrixXd map(2 * n, 2 * n);
  Phase unit = phase;
  VectorXd y, rate;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const VectorXd z = VectorXd::Unit(2 * n, i);
    unit = begin(phase.t, phase.closed, regime.static_displacement + z.head(n), z.tail(n));
    modes(unit, s, y, rate);
    map.col(i) << regime.shapes * y, regime.shapes * rate;
  }
  return map;
}

// Errors d of one phase have |d| <= D, entry by entry, with D from what is rounded: omega and the
// product omega s turn a mode by omega s (omega_error + epsilon); the exponential has sigma s epsilon; the
// change to modes and back, sine, cosine and sums have 4 (n + 2) epsilon of the amplitudes, of which
// a displacement sees the sum over modes and a velocity the sum with omega.
MatrixXd PenalizedMotion::error_after(const Phase& phase, double s) const {
  const auto& regime = of(phase);
  const auto n = dof();
  const MatrixXd map = flow(phase, s);
  const VectorXd amplitude = (phase.p.cwiseAbs2() + phase.q.cwiseAbs2()).cwiseSqrt();
  const VectorXd phase_error =
      s * regime.omega.cwiseProduct(regime.omega_error +
                                    VectorXd::Constant(n, (1.0 + sigma_ * s) * epsilon));
  const VectorXd part =
      amplitude.cwiseProduct(phase_error + VectorXd::Constant(n, 4.0 * double(n + 2) * epsilon));
  const MatrixXd size = regime.shapes.cwiseAbs();
  VectorXd d(2 * n);
  d << size * part + epsilon * regime.static_displacement.cwiseAbs(),
      size * part.cwiseProduct(regime.omega);
  return map * phase.error_covariance * map.transpose() + MatrixXd(d.cwiseAbs2().asDiagonal());
}

// With K phases of errors d_k, each carried on by a map F_k, Cauchy and Schwarz give
// |sum F_k d_k|_i <= sqrt(2 n K) sqrt(sum (F_k D_k D_k' F_k')_ii).
model::Kinematics PenalizedMotion::error_bound(double t) const {
  const auto at = phase_at(t);
  const Phase& phase = phases_[at];
  const auto n = dof();
  const MatrixXd error_covariance = error_after(phase, t - phase.t);
  const VectorXd bound =
      (2.0 * double(n) * double(at + 1) * error_covariance.diagonal()).cwiseSqrt();
  model::Kinematics result;
  result.u = bound.head(n);
  result.v = bound.tail(n);
  const MatrixXd stiffness_over_mass =
      (numerics::inverse(system_.mass) * of(phase).stiffness).cwiseAbs();
  result.a =
      2.0 * sigma_ * result.v + stiffness_over_mass * result.u + 8.0 * epsilon * envelope(t).a;
  return result;
}

long long PenalizedMotion::impact_count(double t) const {
  const auto phase = phase_at(t);
  // Phases alternate and the first is open.
  return static_cast<long long>((phase + 1) / 2);
}

void PenalizedMotion::require_index(long long index) const {
  const auto count = static_cast<long long>(contacts_.size());
  if (index < 1 || index > count)
    throw InputError(
        fmt::format("penalized motion: contact {} was asked for; allowed: {}.", index,
                    count == 0 ? std::string("none, since nothing touches up to the end")
                               : fmt::format("1 to {}", count)),
        "beyond-last-impact");
}

model::MotionImpact PenalizedMotion::impact(long long index) const {
  require_index(index);
  const double t = phases_[contacts_[static_cast<std::size_t>(index - 1)]].t;
  model::MotionImpact hit;
  hit.index = index;
  hit.t = t;
  hit.before = hit.after = at(t, Side::right);
  const auto bound = error_bound(t);
  const double time_error =
      contact_.direction.cwiseAbs().dot(bound.u) / std::abs(contact_.gap_rate(hit.before.v)) +
      2.0 * epsilon * t;
  hit.when = {t - time_error, t + time_error};
  hit.energy_before = hit.energy_after = 0.5 * (hit.before.v.dot(system_.mass * hit.before.v) +
                                                hit.before.u.dot(system_.stiffness * hit.before.u));
  return hit;
}

}  // namespace clackers::exact
