#pragma once

#include <array>

#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::exact {

/// Where the energy of the start has gone, all in J.
struct EnergySplit {
  double kinetic = 0.0;     ///< sum of m v^2 / 2
  double potential = 0.0;   ///< sum of k u^2 / 2, and of constant loads
  double dissipated = 0.0;  ///< by dashpots and friction so far
  double lost = 0.0;        ///< at impacts so far
  double work = 0.0;        ///< of loads that vary and of belts so far
  /// The energy at the start, at every time.
  double total() const { return kinetic + potential + dissipated + lost - work; }
};

/// Energy and momentum of a motion in flights, exact at every time: sums over impacts are
/// geometric, and what a dashpot dissipated in a part of a flight is formed without subtracting energies;
/// docs/manual/explanation/derivations/energy-and-spectrum.md. Relative errors: dissipated and lost at most 64 units of 2^-52;
/// kinetic and potential at most 8 of the largest each reaches around t, since errors of u and v are
/// relative to their envelopes. Below 1e-290 J, where squares leave the normal numbers, no digit is
/// promised.
class EnergyAccount {
 public:
  /// The motion must outlive it.
  explicit EnergyAccount(const ClosedForm& motion);

  /// The split at t; at an impact `side` decides. Throws InputError outside [0, end()].
  EnergySplit at(double t, model::Side side) const;

  /// Sum of m v [kg m/s]. Zero at impacts of a pair and, for equal frequencies, always. Error at
  /// most 4 units of 2^-52 of the sum of m |v|, each |v| its envelope.
  double momentum(double t, model::Side side) const;

  /// The energy at the start [J].
  double initial() const;

 private:
  struct Body {
    double mass, stiffness, frequency, multiple, start;  ///< frequency: damped
  };
  double dissipated_in_first_flight(const Body& body, double t,
                                    const numerics::DoubleDouble& theta_over_pi) const;
  double sum_over_impacts(double count) const;

  const ClosedForm& motion_;
  std::array<Body, 2> bodies_{};
  std::size_t count_ = 0;
  double sigma_ = 0.0;          ///< [1/s]
  double period_ = 0.0;         ///< [s]
  double log_ratio_ = 0.0;      ///< ln(eta^2 exp(-2 sigma T)); of no meaning for eta = 0
  double at_first_hit_ = 0.0;   ///< energy just before the first impact [J]
  double in_first_half_ = 0.0;  ///< dissipated before it [J]
};

}  // namespace clackers::exact
