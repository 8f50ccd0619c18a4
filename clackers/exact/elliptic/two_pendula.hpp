#pragma once

#include <string_view>

#include "clackers/exact/elliptic/elliptic_formulas.hpp"
#include "clackers/exact/orbit/flights.hpp"

namespace clackers::exact {

/// About the modulus k of pendulum 2 with k/K(k) = (m1/m2) k1/K(k1), the smaller of two.
double second_modulus(const TwoPendulaParameters& parameters);

/// Two pendula whose bobs touch at their lowest points and collide elastically there, of any amplitude. Their arcs
/// are u1 >= 0 >= u2. docs/manual/explanation/derivations/elliptic.md.
class TwoPendula final : public FlightsBy<Flights, TwoPendulaFormulas> {
 public:
  /// Both start at rest and arrive together with opposite momenta; length and start of pendulum 2 follow, with less
  /// than 113.7 degrees. Throws InputError where there is no such pendulum.
  TwoPendula(const TwoPendulaParameters& parameters, std::string_view who);
  /// Equal masses, one of which rests while the other swings; pendulum 2 rests first. Throws InputError where
  /// pendulum 2 would go over the top.
  TwoPendula(const PendulumCradleParameters& parameters, std::string_view who);

  model::Kinematics envelope(double t) const override;
  const Swing<Bounded>& swing(int i) const { return formulas_.swings[std::size_t(i)]; }

 private:
  void state_problem(const Eigen::Vector2d& masses, double g, double end, std::string_view who);
  long long near_flight(double t) const override;
};

}  // namespace clackers::exact
