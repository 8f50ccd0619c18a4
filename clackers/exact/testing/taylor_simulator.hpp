#pragma once

#include <optional>
#include <vector>

#include "clackers/exact/testing/mass_simulator.hpp"
#include "clackers/model/harmonic_load.hpp"

// For tests: any linear structure that collides, by Taylor series with 90 digits. It knows M, C, K,
// the forces and the contacts, and nothing of modes. Of contacts that touch without speed those stay closed
// whose set it finds by trial: the first terms of their forces, and of the gaps of the others, are
// positive. Rebounds slower than 1e-15 of the speeds are rest.
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

  explicit TaylorSimulator(const model::ImpactProblem<>& problem);
  /// Contacts that are closed now.
  const std::vector<std::size_t>& held() const { return held_; }
  /// The force of each of them.
  RealVector forces_at(const Real& t) const;

  /// Within the present series.
  State at(const Real& t) const;

  /// Goes to `until`, or through the next impact if that comes earlier.
  std::optional<Impact> next(const Real& until);

 private:
  Eigen::Index dof() const { return stiffness_.rows(); }
  RealVector row(std::size_t i) const { return problem_.contacts[i].direction.cast<Real>(); }

  static bool is_zero(const Real& x) { return abs(x) < Real(1e-60); }

  // (k + 1)(k + 2) M u_(k+2) = f_k + B' p_k - (k + 1) C u_(k+1) - K u_k, with B u_(k+2) = 0 for the
  // held contacts.
  void expand(const Real& t, const RealVector& u, const RealVector& v);

  static bool begins_positive(const std::vector<Real>& series, std::size_t from);

  // Of these contacts, which touch without speed, some stay closed.
  void rest(const Real& t, const RealVector& u, const RealVector& v,
            const std::vector<std::size_t>& touching);

  // No more than 8 radians of any mode, so that the terms fall to 1e-28 and below.
  static Real longest_step(const RealMatrix& squares);
  std::vector<Real> gap_terms(std::size_t i) const;
  std::vector<Real> force_terms(Eigen::Index i) const;

  // By the sign at sixteen places of a step and at the turning points between them, then by halving
  // and Newton's method.
  std::optional<Real> first_zero(const std::vector<Real>& gaps, const Real& end) const;

  RealVector stopped(const RealVector& v, const std::vector<std::size_t>& contacts) const;

  // Impulses of this contact and those that are closed, by trial of all sets.
  Impact impact(const Real& t, int contact);

  static constexpr int terms = 60;
  const model::ImpactProblem<>& problem_;
  RealMatrix damping_, stiffness_, inverse_mass_;
  Real step_;
  std::vector<model::HarmonicForce> forces_;
  Real start_;
  std::vector<RealVector> series_, multipliers_;
  std::vector<std::size_t> held_;
};

}  // namespace clackers::exact::testing_oracle
