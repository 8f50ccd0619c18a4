#pragma once

#include <variant>

#include "clackers/exact/certified/enclosure.hpp"
#include "clackers/exact/orbit/flights.hpp"

namespace clackers::certified {

/// Of a cradle, a forced pair or a pair under base excitation: their formulas in balls.
class OrbitEnclosure : public Enclosure {
 public:
  explicit OrbitEnclosure(const exact::Flights& motion) : Enclosure({}), motion_(motion) {}

  /// At impacts of the forced pair velocities, energies and the impulse are fractions.
  double fraction_bits(long long) const override { return 16384.0; }
  bool is_undamped() const override { return true; }

 protected:
  const Ball& omega() override { return none_; }
  const Ball& sigma() override { return none_; }
  long long flight(double t, model::Side side) override { return motion_.flight_at(t, side); }
  KinematicBalls at_now(long long k, double t) override;
  ImpactBalls impact_now(long long k) override;

 private:
  using Formulas = std::variant<exact::CradleFormulas<Ball>, exact::OrbitFormulas<Ball>>;
  const Formulas& formulas();

  const exact::Flights& motion_;
  const Ball none_;  // there is no Omega
  long bits_ = 0;
  Formulas formulas_;
};

}  // namespace clackers::certified
