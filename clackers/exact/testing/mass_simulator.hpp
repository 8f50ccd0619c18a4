#pragma once

#include <vector>

#include "clackers/exact/testing/impact_simulator.hpp"

// For tests: any number of coupled masses that collide, simulated from one impact to the next with 90
// digits. It knows M, K, the common rate of decay and the contacts, and nothing of synchrony,
// admissibility or any closed form.
namespace clackers::exact::testing_oracle {

/// M a + 2 sigma M v + K u = 0 while all gaps rows * u are positive; Newton's law at impacts.
struct RawSystem {
  RealMatrix mass, stiffness;  ///< K - sigma^2 M positive definite
  Real sigma = 0;
  RealMatrix contacts;  ///< one row each
  Real eta = 1;
  RealVector u, v;  ///< at t = 0
};

struct RawImpact {
  Real t;
  std::vector<int> contacts;  ///< that close together, ascending
  RealVector before, after;   ///< velocities
  RealVector impulses;        ///< of those contacts
};

class MassSimulator {
 public:
  explicit MassSimulator(RawSystem system);

  /// Displacements, velocities and accelerations at t, within the present flight.
  struct State {
    RealVector u, v, a;
  };
  State at(const Real& t) const;

  /// Goes through the next impact if it is not later than `until`; throws std::domain_error for a
  /// graze, where a gap comes within 1e-70 of the amplitudes and nothing proves a crossing.
  std::optional<RawImpact> next(const Real& until);

 private:
  struct Modal {
    RealVector u, v, a;
  };
  Modal modal(const Real& t) const;
  void fly_from(const Real& t, const RealVector& u, const RealVector& v);
  Real tiny(Eigen::Index j) const;

  // As ImpactSimulator::first_contact(), whose comments give the proof.
  std::optional<Real> first_contact(Eigen::Index j, const Real& until) const;

  RawSystem s_;
  RealMatrix shapes_, to_modes_, rows_, delassus_;
  std::vector<FreeMass90> modes_;
  Real start_ = 0;
  RealVector bounds_, sizes_;
};

}  // namespace clackers::exact::testing_oracle
