#pragma once

#include <string_view>

#include "clackers/exact/elliptic/elliptic_formulas.hpp"
#include "clackers/exact/orbit/flights.hpp"

namespace clackers::exact {

/// A nonlinear oscillator without damping above a stop at its equilibrium, from rest: flights between impacts are
/// halves of a free period, of speeds V eta^j. docs/manual/explanation/derivations/elliptic.md.
template <template <class> class FormulasOf>
class StoppedOscillator : public FlightsBy<Flights, FormulasOf> {
 public:
  using Bounded = numerics::Bounded;
  model::Kinematics envelope(double t) const override;
  /// At the stop, before the first impact.
  Bounded speed() const { return formulas_.flights[0].speed; }
  /// Half a period of flight 0, and the instant of the first impact.
  Bounded half_period() const { return formulas_.flights[0].duration(); }
  Bounded first() const { return formulas_.flights[1].start; }

 protected:
  using FlightsBy<Flights, FormulasOf>::formulas_, Flights::problem_;
  /// What moves is the derived class's. Throws InputError for more than 1e5 flights.
  template <class Parameters>
  StoppedOscillator(const Parameters& parameters, std::string_view who);

 private:
  long long near_flight(double t) const override;
};

/// u'' = -g sin(u/l), u the arc from the lowest point, where the stop is.
class Pendulum final : public StoppedOscillator<PendulumFormulas> {
 public:
  Pendulum(const PendulumParameters& parameters, std::string_view who);
};

/// m u'' = -k u - b u^3.
class Duffing final : public StoppedOscillator<DuffingFormulas> {
 public:
  /// Throws InputError unless |b| u0^2 < k where b < 0.
  Duffing(const DuffingParameters& parameters, std::string_view who);
};

}  // namespace clackers::exact
