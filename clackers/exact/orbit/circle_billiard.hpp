#pragma once

#include <string_view>

#include "clackers/exact/orbit/flights.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

/// A point of unit mass within a circle of radius R around the origin.
struct CircleBilliardParameters {
  double R = 1.0;                                 ///< [m]
  double x0 = 0.0, y0 = 0.0, vx = 1.0, vy = 0.0;  ///< at t = 0 [m, m/s]
  double end = 20.0;                              ///< [s]
};

/// Straight chords of one length 2 l, all at the distance d from the center, each turned against the one before by
/// 2 acos(d/R): with the direction z = e of the first chord as a complex number and w = (d + i l)^2/R^2,
///
///     chord k has the direction e w^k,  position (sigma - i d) e w^k,  -l <= sigma <= l
///
/// docs/manual/explanation/derivations/resting.md. Powers are taken in 256 bits, so that no angle is reduced.
class CircleBilliard final : public Flights {
 public:
  /// Throws InputError unless the point starts within the circle and moves, and for more than 1e9 impacts.
  CircleBilliard(const CircleBilliardParameters& parameters, std::string_view who);

  model::Kinematics envelope(double t) const override;
  double distance() const { return numerics::narrowed(d_).nearest(); }
  double chord() const { return 2.0 * numerics::narrowed(l_).nearest(); }

 private:
  using Wide = numerics::Wide;
  Bounded instant(long long k) const override;
  States state(long long k, const Bounded& s) const override;
  long long near_flight(double t) const override;
  Limits limits(long long k) const override;

  States on_chord(long long k, const Bounded& sigma) const;

  CircleBilliardParameters p_;
  Wide v_, b_, d_, l_;  // speed; the start on its chord; distance; half a chord
};

}  // namespace clackers::exact
