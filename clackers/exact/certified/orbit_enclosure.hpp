#pragma once

#include <variant>

#include "clackers/exact/certified/enclosure.hpp"
#include "clackers/exact/elliptic/elliptic_formulas.hpp"
#include "clackers/exact/friction/disk_formulas.hpp"
#include "clackers/exact/friction/friction_formulas.hpp"
#include "clackers/exact/orbit/circle_formulas.hpp"
#include "clackers/exact/orbit/flights.hpp"

namespace clackers::certified {

/// Of motions whose formulas are written for numbers of any kind: these formulas in balls. Throws InputError
/// (no-enclosure) where impacts accumulate.
class OrbitEnclosure : public Enclosure {
 public:
  explicit OrbitEnclosure(const exact::Flights& motion) : Enclosure({}), motion_(motion) {}

  /// At impacts of the forced pair velocities, energies and the impulse are fractions; those of the circle, the ball and the disk
  /// have one square root, and denominators that grow from flight to flight.
  double fraction_bits(long long flights) const override {
    return 16384.0 + 4400.0 * double(flights);
  }
  bool is_undamped() const override { return true; }

 protected:
  const Ball& omega() override { return none_; }
  const Ball& sigma() override { return none_; }
  long long flight(double t, model::Side side) override { return motion_.flight_at(t, side); }
  KinematicBalls at_now(long long k, double t) override;
  ImpactBalls impact_now(long long k) override;

 private:
  void require_resolved(double t) const;
  KinematicBalls kinematics(const exact::StatesOf<Ball>& states) const;
  using Formulas = std::variant<
      exact::CradleFormulas<Ball>, exact::OrbitFormulas<Ball>, exact::CircleFormulas<Ball>,
      exact::BallFormulas<Ball>, exact::DiskFormulas<Ball>, exact::SliderFormulas<Ball>,
      exact::BeltFormulas<Ball>, exact::ForcedSliderFormulas<Ball>, exact::PendulumFormulas<Ball>,
      exact::DuffingFormulas<Ball>, exact::TwoPendulaFormulas<Ball>>;
  const Formulas& formulas();

  const exact::Flights& motion_;
  const Ball none_;  // there is no Omega
  long bits_ = 0;
  Formulas formulas_;
};

}  // namespace clackers::certified
