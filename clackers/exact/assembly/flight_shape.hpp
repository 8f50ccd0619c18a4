#pragma once

#include <cstddef>
#include <span>

#include "clackers/model/motion.hpp"
#include "clackers/numerics/exp2.hpp"

namespace clackers::exact {

/// One instant of a flight.
struct FlightInstant {
  numerics::DoubleDouble theta_over_pi;  ///< from -1/2, just after an impact, to 1/2, just before
  bool is_odd = false;                   ///< of the number of impacts so far
  numerics::Scaled decay;                ///< E = eta^k exp(-sigma t)
};

/// How all masses move between two impacts: displacements are E p(theta), where p solves the undamped
/// equation of motion. Because damping is C = 2 sigma M and sigma^2 M is part of K, the velocities
/// are E (p' - sigma p) and the accelerations E (p'' - 2 sigma p' + sigma^2 p).
class FlightShape {
 public:
  virtual ~FlightShape() = default;
  virtual std::size_t dof() const = 0;
  /// Writes row-major (instant, mass); `out.a` may be empty.
  virtual void sample(std::span<const FlightInstant> instants, model::SampleBuffers out) const = 0;
  /// Largest |u|, |v|, |a| of each mass over a flight with E = 1 without decay, or a little more.
  virtual model::Kinematics amplitude() const = 0;
  /// Bound on the errors of sample() over E, as long as E is normal.
  virtual model::Kinematics error() const = 0;
};

}  // namespace clackers::exact
