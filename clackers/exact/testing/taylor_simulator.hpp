#pragma once

#include <optional>
#include <vector>

#include "clackers/exact/testing/mass_simulator.hpp"
#include "clackers/model/harmonic_load.hpp"

// For tests: any linear structure that collides, by Taylor series with 90 digits. It knows M, C, K,
// the forces and the contacts, and nothing of modes.
namespace clackers::exact::testing_oracle {

class TaylorSimulator {
 public:
  struct Impact {
    Real t, impulse;
    int contact = 0;
  };
  struct State {
    RealVector u, v, a;
  };

  explicit TaylorSimulator(const model::ImpactProblem<>& problem)
      : problem_(problem),
        damping_(problem.system.damping.cast<Real>()),
        stiffness_(problem.system.stiffness.cast<Real>()),
        inverse_mass_(RealMatrix(problem.system.mass.cast<Real>()).inverse()) {
    if (const auto* load = problem.system.add_load.target<model::HarmonicLoad>())
      forces_ = load->forces();
    expand(0, problem.start.u.cast<Real>(), problem.start.v.cast<Real>());
  }

  /// Within the present series.
  State at(const Real& t) const {
    const Real s = t - start_;
    State x{series_.back(), RealVector::Zero(dof()), RealVector::Zero(dof())};
    for (auto k = series_.size() - 1; k-- > 0;) {
      x.a = x.a * s + 2 * x.v;
      x.v = x.v * s + x.u;
      x.u = x.u * s + series_[k];
    }
    return x;
  }

  /// Goes to `until`, or through the next impact if that comes earlier.
  std::optional<Impact> next(const Real& until) {
    for (;;) {
      const Real end = std::min(Real(start_ + step_), until);
      std::optional<Real> first;
      int contact_index = 0;
      for (std::size_t i = 0; i < problem_.contacts.size(); ++i)
        if (const auto t = first_zero(i, first ? *first : end)) {
          first = t;
          contact_index = int(i);
        }
      if (first) return impact(*first, contact_index);
      const auto x = at(end);
      expand(end, x.u, x.v);
      if (end == until) return std::nullopt;
    }
  }

 private:
  Eigen::Index dof() const { return stiffness_.rows(); }
  RealVector row(std::size_t i) const { return problem_.contacts[i].direction.cast<Real>(); }

  // (k + 1)(k + 2) M u_(k+2) = f_k - (k + 1) C u_(k+1) - K u_k.
  void expand(const Real& t, const RealVector& u, const RealVector& v) {
    start_ = t;
    series_ = {u, v};
    std::vector<Real> forces(forces_.size());
    for (int k = 0; k + 2 < terms; ++k) {
      RealVector f = -(stiffness_ * series_[std::size_t(k)] +
                       Real(k + 1) * (damping_ * series_[std::size_t(k) + 1]));
      for (std::size_t i = 0; i < forces_.size(); ++i) {
        // The k-th derivative turns the phase by k quarters.
        const auto& force = forces_[i];
        const Real phase = Real(force.frequency) * t + Real(force.phase);
        const Real quarter = k % 2 == 0 ? cos(phase) : sin(phase);
        const int sign = (k + 1) / 2 % 2 == 0 ? 1 : -1;
        forces[i] = k == 0 ? Real(1) : Real(forces[i] * Real(force.frequency) / k);
        f[force.dof] += Real(force.amplitude) * forces[i] * sign * quarter;
      }
      series_.push_back(inverse_mass_ * f / Real((k + 1) * (k + 2)));
    }
  }

  // By the sign at sixteen places of a step and at the turning points between them, then by halving
  // and Newton's method.
  std::optional<Real> first_zero(std::size_t i, const Real& end) const {
    std::vector<Real> gaps;
    const auto b = row(i);
    for (const auto& coefficient : series_) gaps.push_back(b.dot(coefficient));
    gaps[0] -= Real(problem_.contacts[i].gap);
    Real slope;
    const auto gap = [&](const Real& s) {
      Real value = gaps.back();
      slope = 0;
      for (auto k = gaps.size() - 1; k-- > 0;) {
        slope = slope * s + value;
        value = value * s + gaps[k];
      }
      return value;
    };
    constexpr int places = 16;
    Real low = 0;
    gap(low);
    bool falls = slope < 0;
    for (int n = 1; n <= places; ++n) {
      Real high = (end - start_) * n / places;
      if (gap(high) >= 0) {
        const bool fell = falls;
        falls = slope < 0;
        const Real place = high;
        if (fell && !falls) {
          Real before = low;
          for (int halving = 0; halving < 80; ++halving) {
            const Real middle = (before + high) / 2, value = gap(middle);
            // Convex near its least value, which is above 0 then.
            if (value > abs(slope) * (high - before)) break;
            (slope < 0 ? before : high) = middle;
          }
        }
        if (gap(high) >= 0) {
          low = place;
          continue;
        }
      }
      for (int halving = 0; halving < 60; ++halving) {
        const Real middle = (low + high) / 2;
        (gap(middle) >= 0 ? low : high) = middle;
      }
      for (int improved = 0; improved < 8; ++improved) {
        const Real value = gap(low);
        low -= value / slope;
      }
      return start_ + low;
    }
    return std::nullopt;
  }

  Impact impact(const Real& t, int contact) {
    auto x = at(t);
    const auto& law = problem_.contacts[std::size_t(contact)];
    const RealVector b = row(std::size_t(contact)), response = inverse_mass_ * b;
    const Real impulse = -(1 + Real(law.restitution)) * b.dot(x.v) / b.dot(response);
    expand(t, x.u, x.v + impulse * response);
    return {t, impulse, contact};
  }

  static constexpr int terms = 60;
  const Real step_ = Real(1) / 4;
  const model::ImpactProblem<>& problem_;
  RealMatrix damping_, stiffness_, inverse_mass_;
  std::vector<model::HarmonicForce> forces_;
  Real start_;
  std::vector<RealVector> series_;
};

}  // namespace clackers::exact::testing_oracle
