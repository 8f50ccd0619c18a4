#pragma once

#include <array>
#include <string_view>

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
  FrictionMotion(double m, double k, const model::Friction<>& friction, double end);
  Limits limits(long long k) const override;  // there are no impacts

  Bounded k_, omega_;
  std::array<double, 3> size_{};  ///< of u, v and a
};

/// From rest at x0 > F/k: n half swings, each less wide by 2 F/k, then rest. C. A. Coulomb (1785).
struct SliderParameters {
  double m = 1.0, k = 1.0, F = 0.1, x0 = 1.0, end = 20.0;
};
class Slider final : public FrictionMotion {
 public:
  /// Throws InputError unless k x0 > F, and for more than 1e9 half swings.
  Slider(const SliderParameters& parameters, std::string_view who);
  double half_swings() const { return double(n_); }
  Bounded end_of_slip() const { return instant(n_); }
  Bounded rest() const;

 private:
  Bounded instant(long long k) const override;
  States state(long long k, const Bounded& s) const override;
  long long near_flight(double t) const override;

  Bounded x0_, d_, T_;
  long long n_ = 0;
};

/// On a belt of velocity V, stick and slip in turn, from the beginning of sticking.
struct BeltParameters {
  double m = 1.0, k = 1.0, limit = 1.0, kinetic = 0.5, V = 0.2, end = 40.0;
};
class Belt final : public FrictionMotion {
 public:
  /// Throws InputError unless limit > kinetic.
  Belt(const BeltParameters& parameters, std::string_view who);
  Bounded stick() const { return stick_; }
  Bounded slip() const { return T_ - stick_; }

 private:
  Bounded instant(long long k) const override;
  States state(long long k, const Bounded& s) const override;
  long long near_flight(double t) const override;

  Bounded V_, D_, d_, stick_, T_;
};

/// Under P cos(W t + phi) the periodic motion without stops, from a turning point. J. P. den Hartog (1931).
struct ForcedSliderParameters {
  double m = 1.0, k = 1.0, F = 0.4, P = 1.0, W = 0.8, end = 40.0;
};
class ForcedSlider final : public FrictionMotion {
 public:
  /// Throws InputError where there is no such motion.
  ForcedSlider(const ForcedSliderParameters& parameters, std::string_view who);
  double amplitude() const { return x0_.nearest(); }
  double phase() const { return phi_; }

 private:
  Bounded instant(long long k) const override;
  States state(long long k, const Bounded& s) const override;
  long long near_flight(double t) const override;
  void require_sliding(std::string_view who, double F) const;

  Bounded F_, P_, W_, Vd_, tan_, x0_, cos_phi_, sin_phi_, T_;
  double phi_ = 0.0;
};

}  // namespace clackers::exact
