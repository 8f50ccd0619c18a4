#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "clackers/exact/certified/ball_flights.hpp"
#include "clackers/exact/certified/inputs.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::certified {

/// One impact.
struct ImpactBalls {
  Ball t;                        ///< [s]
  KinematicBalls before, after;  ///< limits
  Ball impulse;                  ///< [N s]
  Ball energy_before, energy_after;
};

/// sin(odd pi / 2) of an odd number.
inline double quarter_sine(double odd) { return std::fmod(odd, 4.0) == 1.0 ? 1.0 : -1.0; }

/// One motion of the module exact, as balls that certainly hold it for the binary64 values of its
/// free parameters. Between instants t_k, pi/Omega apart, it flies freely; at each the velocities that
/// close a contact are multiplied by -eta. Not to be shared by threads.
class Enclosure {
 public:
  virtual ~Enclosure() = default;

  /// At the double t >= 0. `side` decides where t is the double nearest to an impact, as in
  /// model::Motion::sample(). Each value is exactly 0 or certain to `bits` >= 1 bits of itself.
  KinematicBalls at(double t, model::Side side, long bits);

  /// The instant t_k, k >= 1.
  Ball instant(long long k, long bits);
  /// Impact k >= 1; with eta = 0 there are only those of the first instant.
  ImpactBalls impact(long long k, long bits);

  /// Impacts up to t.
  long long impact_count(double t);

  /// At t = 0, and at impacts where is_undamped(), each value is the root of a fraction whose
  /// denominator is below 2^this.
  virtual double fraction_bits(long long flights) const = 0;
  virtual bool is_undamped() const = 0;

 protected:
  struct Timing {
    bool collides = true;
    double eta = 1.0;
    double first_impact = 0.5;  ///< t_1 Omega / pi: 1/2 or 1
    long long at_once = 1;      ///< contacts that close at each instant
  };
  explicit Enclosure(const Timing& timing) : timing_(timing) {}

  /// Omega [rad/s] and the rate of decay [1/s] with the working bits of now.
  virtual const Ball& omega() = 0;
  virtual const Ball& sigma() = 0;
  /// At t after k flights.
  virtual KinematicBalls at_now(long long k, double t) = 0;
  virtual ImpactBalls impact_now(long long k) = 0;
  /// The flight that holds t.
  virtual long long flight(double t, model::Side side);

  Ball instant_now(long long k);
  /// eta^k exp(-sigma t)
  Ball decay_now(long long k, const Ball& t);

  const Timing timing_;

 private:
  long long natural_flight(double t);
  double nearest_double_to_instant(long long k);
};

/// Of one mass or two: the second way to the same motion. Eq. (22) as the paper writes it, sign
/// function, large phases and all, where ClosedForm reduces phases.
class PairEnclosure : public Enclosure {
 public:
  explicit PairEnclosure(const Inputs& inputs);

  double fraction_bits(long long flights) const override;
  bool is_undamped() const override { return in_.damping == 0.0; }

 protected:
  const Ball& omega() override { return constants().omega; }
  const Ball& sigma() override { return constants().sigma; }
  KinematicBalls at_now(long long k, double t) override;
  ImpactBalls impact_now(long long k) override;

 private:
  struct Constants {
    long bits = 0;
    std::array<Ball, 2> mass, start, frequency;  // damped
    Ball sigma, omega;
  };
  const Constants& constants();

  Inputs in_;
  Constants c_;
};

/// Of a motion of the module exact; throws InputError (no-enclosure) for those that have none.
std::unique_ptr<Enclosure> enclosure_of(const model::Motion& motion);

}  // namespace clackers::certified
