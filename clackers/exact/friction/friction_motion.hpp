#pragma once

#include <array>
#include <string_view>

#include "clackers/exact/friction/friction_formulas.hpp"
#include "clackers/exact/orbit/flights.hpp"

namespace clackers::exact {

/// A mass on a spring under dry friction that does not depend on its motion, in closed form from one change of
/// stick and slip to the next: docs/manual/explanation/derivations/friction.md. At a change, where only the
/// acceleration jumps, `side` decides.
class FrictionMotion : public Flights {
 public:
  model::Kinematics envelope(double t) const override;
  long long impact_count(double t) const override;
  /// The force of friction: what spring and load leave of m a.
  Eigen::VectorXd contact_forces(double t, model::Side side) const override;

 protected:
  template <class Parameters>
  FrictionMotion(const Parameters& parameters, const model::Friction<>& friction);

  std::array<double, 3> size_{};  ///< of u, v and a
};

/// Of a slider that moves, by products that are exact in 256 bits.
long long half_swings(const SliderParameters& parameters);

/// From rest at x0 > F/k. C. A. Coulomb (1785).
class Slider final : public FlightsBy<FrictionMotion, SliderFormulas> {
 public:
  /// Throws InputError unless k x0 > F, and for more than 1e9 half swings.
  Slider(const SliderParameters& p, std::string_view who);
  double half_swings() const { return double(formulas_.n); }
  Bounded end_of_slip() const { return instant(formulas_.n); }
  Bounded rest() const { return formulas_.rest(); }
  /// Energy [J] that friction takes.
  double lost() const;

 private:
  long long near_flight(double t) const override;
};

/// On a belt of velocity V, from the beginning of sticking.
class Belt final : public FlightsBy<FrictionMotion, BeltFormulas> {
 public:
  /// Throws InputError unless limit > kinetic.
  Belt(const BeltParameters& p, std::string_view who);
  Bounded stick() const { return formulas_.stick; }
  Bounded slip() const { return formulas_.slip; }

 private:
  long long near_flight(double t) const override;
};

/// Under P cos(W t + phi) the periodic motion without stops, from a turning point. J. P. den Hartog (1931).
class ForcedSlider final : public FlightsBy<FrictionMotion, ForcedSliderFormulas> {
 public:
  /// Throws InputError where there is no such motion.
  ForcedSlider(const ForcedSliderParameters& p, std::string_view who);
  double amplitude() const { return problem_.start.u[0]; }
  double phase() const { return phi_; }

 private:
  long long near_flight(double t) const override;
  void require_sliding(std::string_view who) const;

  double phi_ = 0.0;
};

}  // namespace clackers::exact
