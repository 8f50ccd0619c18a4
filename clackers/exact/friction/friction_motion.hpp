#pragma once

#include <array>
#include <string_view>
#include <utility>

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
  FrictionMotion(const FlightsParameters& parameters, double m, double k,
                 const model::Friction<>& friction, double end);

  std::array<double, 3> size_{};  ///< of u, v and a
};

/// By its formulas.
template <template <class> class FormulasOf>
class FrictionMotionBy : public FrictionMotion {
 protected:
  template <class Parameters>
  FrictionMotionBy(const Parameters& p, FormulasOf<Bounded> formulas,
                   const model::Friction<>& friction)
      : FrictionMotion(p, p.m, p.k, friction, p.end), formulas_(std::move(formulas)) {}

  Bounded instant(long long k) const override { return formulas_.instant(k); }
  States state(long long k, const Bounded& s) const override { return formulas_.state(k, s); }
  Limits limits(long long k) const override { return formulas_.limits(k); }

  FormulasOf<Bounded> formulas_;
};

/// Of a slider that moves, by products that are exact in 256 bits.
long long half_swings(const SliderParameters& parameters);

/// From rest at x0 > F/k. C. A. Coulomb (1785).
class Slider final : public FrictionMotionBy<SliderFormulas> {
 public:
  /// Throws InputError unless k x0 > F, and for more than 1e9 half swings.
  Slider(const SliderParameters& p, std::string_view who);
  double half_swings() const { return double(formulas_.n); }
  Bounded end_of_slip() const { return instant(formulas_.n); }
  Bounded rest() const { return formulas_.rest(); }

 private:
  long long near_flight(double t) const override;
};

/// On a belt of velocity V, from the beginning of sticking.
class Belt final : public FrictionMotionBy<BeltFormulas> {
 public:
  /// Throws InputError unless limit > kinetic.
  Belt(const BeltParameters& p, std::string_view who);
  Bounded stick() const { return formulas_.stick; }
  Bounded slip() const { return formulas_.T - formulas_.stick; }

 private:
  long long near_flight(double t) const override;
};

/// Under P cos(W t + phi) the periodic motion without stops, from a turning point. J. P. den Hartog (1931).
class ForcedSlider final : public FrictionMotionBy<ForcedSliderFormulas> {
 public:
  /// Throws InputError where there is no such motion.
  ForcedSlider(const ForcedSliderParameters& p, std::string_view who);
  double amplitude() const { return formulas_.x0.nearest(); }
  double phase() const { return phi_; }

 private:
  long long near_flight(double t) const override;
  void require_sliding(std::string_view who) const;

  double phi_ = 0.0;
};

}  // namespace clackers::exact
