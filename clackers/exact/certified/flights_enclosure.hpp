#pragma once

#include <optional>
#include <utility>

#include "clackers/exact/certified/ball_flights.hpp"
#include "clackers/exact/certified/enclosure.hpp"

namespace clackers::certified {

/// Of a motion flight by flight, which has proven what ends each: BallFlights
/// with more and more bits. Throws InputError (no-enclosure) from where
/// impacts accumulate, but for a mass that rests to the end.
class FlightsEnclosure : public Enclosure {
 public:
  explicit FlightsEnclosure(const exact::PiecewiseMotion& motion)
      : Enclosure({}), motion_(motion) {}

  /// u and v of the masses at t in flight 0, 1, ..., each the nearest double give or take a unit. Nothing where
  /// the flight has no enclosure, or would take more than 512 bits.
  std::optional<std::pair<Eigen::VectorXd, Eigen::VectorXd>> doubles(std::size_t flight, double t);

  double fraction_bits(long long flights) const override;
  /// A mass that constant forces alone act on: squares of its speeds at contacts are fractions.
  bool is_undamped() const override;

 protected:
  const Ball& omega() override { return none_; }
  const Ball& sigma() override { return none_; }
  /// Where t is the motion's own instant of an event, `side` decides; next to it the true one.
  long long flight(double t, model::Side side) override;
  KinematicBalls at_now(long long k, double t) override;
  ImpactBalls impact_now(long long k) override;

 private:
  const model::Contact<>* holding(double t) const;
  /// The sign of t less the instant that ends this flight, where that is a question of digits, and otherwise 0.
  int order(double t, std::size_t flight);
  /// Null where it takes more bits.
  const BallFlights* begun(std::size_t flight);

  const exact::PiecewiseMotion& motion_;
  const Ball none_;  // there is no Omega
  long bits_ = 0;
  bool is_stuck_ = false;  // with these bits an impact is not certain
  std::vector<BallFlights> begun_;
};

}  // namespace clackers::certified
