#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/numerics/modal_flight.hpp"

namespace clackers::exact {

/// How impacts depart from Newton's law at the instant of contact. The default is the law itself.
struct ImpactLaw {
  /// The impulse is multiplied by these, one factor a mass; empty for 1. A factor that differs from
  /// mass to mass does not conserve momentum.
  std::vector<double> impulse_factor{};
  /// Contact that has no effect, and the one whose impulse acts twice; from 1, 0 for none. After
  /// a missed one masses pass through each other and come back without an impact.
  int missed = 0, doubled = 0;
  /// Impacts act at the first time start + n grid [s] that is not before the contact, with the
  /// velocities of that time; 0 for the instant of contact.
  double grid = 0.0;
  /// Damping is multiplied by this after the first impact.
  double damping_after_impact = 1.0;
};

/// An impact that a simulation went through.
struct SimulatedImpact {
  double t = 0.0;  ///< [s]; when the impulse acts
  int contact = 0;
  double impulse = 0.0;  ///< along the contact's direction [N s], of the mass with factor 1
};

/// The exact motion of an impact problem whose flights are sums of modes, simulated from one impact
/// to the next in double precision: any masses, springs and dashpots, so also the systems that
/// differ from a synchronized pair. Errors: a few 2^-52 of the phases of each flight, carried on by
/// the motion itself.
class EventDrivenMotion {
 public:
  /// Nothing where the motion is not available: a load, a nonlinear force, a free motion
  /// that is no sum of modes, a contact violated at the start, more than `most_impacts` flights, contacts that close
  /// without speed (grazing, resting contact), or a flight with more than 1e5 root steps.
  static std::optional<EventDrivenMotion> make(const model::ImpactProblem<>& problem,
                                               const ImpactLaw& law, double until,
                                               int most_impacts = 10000);

  int dof() const { return dof_; }
  double start() const { return flights_.front().t; }
  double end() const { return until_; }
  /// Displacements and velocities at `times` (ascending is fastest, each within [start(), end()]),
  /// row-major (time, mass); the right limit at an impact. `v` may be empty. Throws InputError for
  /// times outside.
  void sample(std::span<const double> times, std::span<double> u, std::span<double> v) const;
  const std::vector<SimulatedImpact>& impacts() const { return impacts_; }

 private:
  struct Flight {
    double t = 0.0;
    bool after_impact = false;  // which of the systems
  };
  class Builder;

  int dof_ = 0;
  double until_ = 0.0;
  std::vector<numerics::ModalSystem> systems_;  // before the first impact, after it
  std::vector<Flight> flights_;
  std::vector<numerics::ModalState> states_;  // flights x modes
  std::vector<SimulatedImpact> impacts_;
};

}  // namespace clackers::exact
