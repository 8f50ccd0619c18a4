#pragma once

#include <string_view>

#include "clackers/exact/orbit/circle_formulas.hpp"
#include "clackers/exact/orbit/wide_flights.hpp"

namespace clackers::exact {

/// A point in a circle: CircleFormulas. Powers are taken in 256 bits, so that no angle is reduced.
class CircleBilliard final : public WideFlights<CircleFormulas> {
 public:
  /// Throws InputError unless the point starts within the circle and moves, and for more than 1e9 impacts.
  CircleBilliard(const CircleBilliardParameters& parameters, std::string_view who);

  model::Kinematics envelope(double t) const override;
  double distance() const;  ///< of the chords from the center [m]
  double chord() const;     ///< their length [m]

 private:
  long long near_flight(double t) const override;

  double R_;
};

}  // namespace clackers::exact
