#pragma once

#include <string_view>
#include <vector>

#include "clackers/exact/elliptic/swing.hpp"
#include "clackers/exact/orbit/flights.hpp"

namespace clackers::exact {

/// A nonlinear oscillator without damping above a stop at its equilibrium, from rest: flights between impacts are
/// halves of a free period, of speeds V eta^j. docs/manual/explanation/derivations/elliptic.md.
class StoppedOscillator : public Flights {
 public:
  model::Kinematics envelope(double t) const override;
  /// At the stop, before the first impact.
  Bounded speed() const { return flights_[0].speed; }
  /// Half a period of flight 0, and the instant of the first impact.
  Bounded half_period() const { return Bounded(2.0) * first_; }
  Bounded first() const { return first_; }

 protected:
  struct Flight {
    Bounded start, speed;  ///< at the beginning, which of flight 0 lies before t = 0
    Modulus modulus;
    Bounded frequency, size;  ///< of the argument of the elliptic functions; amplitude
  };

  /// The mass, its restitution and the end of the run; the rest is the derived class's.
  StoppedOscillator(double m, double eta, double end);
  /// All flights up to the end, with `make` of the speed at the stop. Throws InputError for more than 1e5.
  template <class Make>
  void follow(std::string_view who, const Flight& first, const Make& make);

  Bounded instant(long long k) const override;
  long long near_flight(double t) const override;
  Limits limits(long long k) const override;
  /// Acceleration at u.
  virtual Bounded acceleration(const Bounded& u) const = 0;

  std::vector<Flight> flights_;  // and the one after the last
  double eta_;
  Bounded first_;
};

/// u'' = -g sin(u/l), u the arc from the lowest point, where the stop is.
struct PendulumParameters {
  double l = 1.0, g = 9.81, theta0 = 1.0, eta = 0.8, end = 10.0;
};
class Pendulum final : public StoppedOscillator {
 public:
  Pendulum(const PendulumParameters& parameters, std::string_view who);
  model::Kinematics envelope(double t) const override;

 private:
  States state(long long k, const Bounded& s) const override;
  Bounded acceleration(const Bounded& u) const override;
  Flight flight_of(const Swing& swing) const;

  Bounded l_, g_, w_;
};

/// m u'' = -k u - b u^3.
struct DuffingParameters {
  double m = 1.0, k = 1.0, b = 1.0, u0 = 1.0, eta = 0.8, end = 20.0;
};
class Duffing final : public StoppedOscillator {
 public:
  /// Throws InputError unless |b| u0^2 < k where b < 0.
  Duffing(const DuffingParameters& parameters, std::string_view who);

 private:
  States state(long long k, const Bounded& s) const override;
  Bounded acceleration(const Bounded& u) const override;
  Flight flight(const Bounded& speed) const;
  Flight flight_of(const Bounded& amplitude, const Bounded& speed) const;

  Bounded square_, cubic_;  // k/m, b/m
};

}  // namespace clackers::exact
