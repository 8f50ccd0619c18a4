#pragma once

#include <array>
#include <string_view>

#include "clackers/exact/elliptic/swing.hpp"
#include "clackers/exact/orbit/flights.hpp"

namespace clackers::exact {

/// Two pendula whose bobs touch at their lowest points and collide elastically there, of any amplitude. Their arcs
/// are u1 >= 0 >= u2. docs/manual/explanation/derivations/elliptic.md.
class TwoPendula final : public Flights {
 public:
  struct Parameters {
    double m1 = 1.0, m2 = 1.0;
    double l1 = 1.0;      ///< [m]
    double g = 9.81;      ///< [m/s^2]
    double theta1 = 1.0;  ///< [rad], where pendulum 1 starts at rest
    double end = 10.0;    ///< [s]
  };
  /// Both start at rest and arrive together with opposite momenta; length and start of pendulum 2 follow, with less
  /// than 113.7 degrees. Throws InputError where there is no such pendulum.
  static TwoPendula synchronized(const Parameters& parameters, std::string_view who);
  /// Equal masses, one of which rests while the other swings; pendulum 2 rests first. Throws InputError where
  /// pendulum 2 would go over the top.
  static TwoPendula alternating(const Parameters& parameters, double l2, std::string_view who);

  model::Kinematics envelope(double t) const override;
  const Swing& swing(int i) const { return swings_[std::size_t(i)]; }

 private:
  TwoPendula(const Parameters& parameters, const Swing& first, const Swing& second, bool together,
             std::string_view who);
  Bounded instant(long long k) const override;
  States state(long long k, const Bounded& s) const override;
  long long near_flight(double t) const override;
  Limits limits(long long k) const override;

  bool together_;
  std::array<Swing, 2> swings_;
  Bounded T1_, T2_;  // of pendulum 2 while pendulum 1 rests: 0 together
};

}  // namespace clackers::exact
