#pragma once

#include <array>
#include <vector>

#include "clackers/certified/ball.hpp"
#include "clackers/certified/inputs.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::certified {

/// Displacement [m], velocity [m/s] and acceleration [m/s^2] of each mass.
struct KinematicBalls {
  std::vector<Ball> u, v, a;
};

/// One collision.
struct ImpactBalls {
  Ball t;                        ///< [s]
  KinematicBalls before, after;  ///< limits
  Ball impulse;                  ///< [N s]
  Ball energy_before, energy_after;
};

/// One motion of the module exact, as balls that certainly hold it for the binary64 values of its
/// free parameters. It is the second way to the same motion: Eq. (22) as the paper writes it, sign
/// function, large phases and all, where ClosedForm reduces phases. Not to be shared by threads.
class Enclosure {
 public:
  explicit Enclosure(const Inputs& inputs);

  int dof() const { return in_.dof; }

  /// At the double t >= 0. `side` decides where t is the double nearest to a collision, as in
  /// model::Motion::sample(). Each value is exactly 0 or certain to `bits` >= 1 bits of itself.
  KinematicBalls at(double t, model::Side side, long bits);

  /// The instant t_k = (k - 1/2) pi / Omega, k >= 1.
  Ball instant(long long k, long bits);
  /// Collision k >= 1; with eta = 0 there is only the first.
  ImpactBalls impact(long long k, long bits);

  /// The k with t_k <= t.
  long long impact_count(double t);

 private:
  struct Constants {
    long bits = 0;
    std::array<Ball, 2> mass, start, frequency;  // damped
    Ball sigma, omega;
  };
  const Constants& constants();
  long long natural_flight(double t);
  long long flight(double t, model::Side side);
  double nearest_double_to_instant(long long k);
  Ball instant_now(long long k);
  Ball decay_now(long long k, const Ball& t);
  KinematicBalls at_now(long long k, double t);
  ImpactBalls impact_now(long long k);

  Inputs in_;
  Constants c_;
};

}  // namespace clackers::certified
